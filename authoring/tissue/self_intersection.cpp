#include "authoring/tissue/self_intersection.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <mutex>
#include <numeric>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "authoring/tissue/time_limit.h"

// Of TetGen only Shewchuk's predicates are used here; the mesher itself runs in a process of its
// own.
#define TETLIBRARY
#include <tetgen.h>
double orient2d(double* a, double* b, double* c);  // is in the library but not in its header

namespace arthro::authoring {
namespace {

using Point = glm::dvec3;

int Sign(double value) { return value > 0 ? 1 : value < 0 ? -1 : 0; }

double* Raw(const Point& p) { return const_cast<double*>(&p.x); }

// On which side of the plane through a, b, c lies d?
int Side(const Point& a, const Point& b, const Point& c, const Point& d) {
  return Sign(orient3d(Raw(a), Raw(b), Raw(c), Raw(d)));
}

// Signs in the plane of one triangle, on its projection along the axis that it faces most: exact,
// since projecting drops a coordinate.
struct Plane {
  int u, v;

  Plane(const Point& a, const Point& b, const Point& c) {
    const Point normal = glm::abs(glm::cross(b - a, c - a));
    const int drop = normal.x >= normal.y && normal.x >= normal.z ? 0
                     : normal.y >= normal.z                       ? 1
                                                                  : 2;
    u = (drop + 1) % 3;
    v = (drop + 2) % 3;
  }
  int Turn(const Point& a, const Point& b, const Point& c) const {
    double pa[2] = {a[u], a[v]}, pb[2] = {b[u], b[v]}, pc[2] = {c[u], c[v]};
    return Sign(orient2d(pa, pb, pc));
  }
  // p, q and x are on one line: is x between the two, or one of them?
  bool IsBetween(const Point& p, const Point& q, const Point& x) const {
    return std::min(p[u], q[u]) <= x[u] && x[u] <= std::max(p[u], q[u]) &&
           std::min(p[v], q[v]) <= x[v] && x[v] <= std::max(p[v], q[v]);
  }
  bool SegmentsMeet(const Point& p, const Point& q, const Point& r, const Point& s) const {
    const int r_side = Turn(p, q, r), s_side = Turn(p, q, s);
    const int p_side = Turn(r, s, p), q_side = Turn(r, s, q);
    if (r_side * s_side < 0 && p_side * q_side < 0) return true;
    return (r_side == 0 && IsBetween(p, q, r)) || (s_side == 0 && IsBetween(p, q, s)) ||
           (p_side == 0 && IsBetween(r, s, p)) || (q_side == 0 && IsBetween(r, s, q));
  }
  bool IsInside(const Point& a, const Point& b, const Point& c, const Point& x) const {
    const int ab = Turn(a, b, x), bc = Turn(b, c, x), ca = Turn(c, a, x);
    return (ab >= 0 && bc >= 0 && ca >= 0) || (ab <= 0 && bc <= 0 && ca <= 0);
  }
};

// Closed segment pq against the closed triangle abc.
bool SegmentMeetsTriangle(const Point& p, const Point& q, const Point& a, const Point& b,
                          const Point& c) {
  const int p_side = Side(a, b, c, p), q_side = Side(a, b, c, q);
  if (p_side * q_side > 0) return false;
  if (p_side == 0 && q_side == 0) {
    const Plane plane(a, b, c);
    return plane.IsInside(a, b, c, p) || plane.SegmentsMeet(p, q, a, b) ||
           plane.SegmentsMeet(p, q, b, c) || plane.SegmentsMeet(p, q, c, a);
  }
  const int ab = Side(p, q, a, b), bc = Side(p, q, b, c), ca = Side(p, q, c, a);
  return (ab >= 0 && bc >= 0 && ca >= 0) || (ab <= 0 && bc <= 0 && ca <= 0);
}

// Triangles as corner lists, turned so that shared corners come first.
struct Corners {
  std::array<int, 3> first, second;
  int shared = 0;
};

Corners Match(std::array<int, 3> first, std::array<int, 3> second) {
  Corners corners{first, second, 0};
  for (int i = 0; i < 3; ++i) {
    const auto end = corners.second.end();
    const auto found = std::find(corners.second.begin() + corners.shared, end, corners.first[i]);
    if (found == end) continue;
    std::swap(corners.first[corners.shared], corners.first[i]);
    std::iter_swap(corners.second.begin() + corners.shared, found);
    ++corners.shared;
  }
  return corners;
}

bool Intersect(const SurfaceMesh& surface, int s, int t) {
  const Corners corners = Match(surface.triangles[s], surface.triangles[t]);
  const auto& x = surface.vertices;
  const Point &a = x[corners.first[0]], &b = x[corners.first[1]], &c = x[corners.first[2]];
  const Point &d = x[corners.second[0]], &e = x[corners.second[1]], &f = x[corners.second[2]];
  switch (corners.shared) {
    case 0:
      return SegmentMeetsTriangle(a, b, d, e, f) || SegmentMeetsTriangle(b, c, d, e, f) ||
             SegmentMeetsTriangle(c, a, d, e, f) || SegmentMeetsTriangle(d, e, a, b, c) ||
             SegmentMeetsTriangle(e, f, a, b, c) || SegmentMeetsTriangle(f, d, a, b, c);
    case 1:  // away from the shared corner, the sides opposite to it must stay clear
      return SegmentMeetsTriangle(b, c, d, e, f) || SegmentMeetsTriangle(e, f, a, b, c);
    case 2: {  // hinged at ab: they meet elsewhere only when folded flat onto one another
      if (Side(a, b, c, f) != 0) return false;
      const Plane plane(a, b, c);
      return plane.Turn(a, b, c) == plane.Turn(a, b, f);
    }
    default:
      return false;
  }
}

struct Box {
  Point low{std::numeric_limits<double>::infinity()};
  Point high{-std::numeric_limits<double>::infinity()};

  void Add(const Point& p) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  bool Meets(const Box& other) const {
    for (int axis = 0; axis < 3; ++axis)
      if (low[axis] > other.high[axis] || other.low[axis] > high[axis]) return false;
    return true;
  }
};

// A tree of boxes over triangles, halved at the median of the longest axis.
class BoxTree {
 public:
  BoxTree(const SurfaceMesh& surface, std::vector<int> triangles)
      : triangles_(std::move(triangles)), boxes_(surface.triangles.size()) {
    for (const int t : triangles_)
      for (const int corner : surface.triangles[t]) boxes_[t].Add(surface.vertices[corner]);
    if (!triangles_.empty()) Build(0, static_cast<int>(triangles_.size()));
  }

  // Pairs of leaves whose boxes meet, each once.
  template <class F>
  void ForEachPair(const Progress& progress, F&& visit) const {
    StageSteps steps(progress, "looking for self-intersections", triangles_.size());
    for (const int t : triangles_) {
      steps.Next();
      Query(0, t, visit);
    }
  }

 private:
  static constexpr int kLeafSize = 4;
  struct Node {
    Box box;
    int begin, end, right;  // right: index of the second child; the first follows its parent
  };

  int Build(int begin, int end) {
    const int index = static_cast<int>(nodes_.size());
    nodes_.push_back({{}, begin, end, -1});
    Box box, centres;
    for (int i = begin; i < end; ++i) {
      const Box& own = boxes_[triangles_[i]];
      box.Add(own.low);
      box.Add(own.high);
      centres.Add(own.low + own.high);
    }
    nodes_[index].box = box;
    if (end - begin <= kLeafSize) return index;
    const Point size = centres.high - centres.low;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const auto key = [&](int t) {
      return std::pair(boxes_[t].low[axis] + boxes_[t].high[axis], t);
    };
    const int middle = (begin + end) / 2;
    std::nth_element(triangles_.begin() + begin, triangles_.begin() + middle,
                     triangles_.begin() + end, [&](int s, int t) { return key(s) < key(t); });
    Build(begin, middle);
    nodes_[index].right = Build(middle, end);
    return index;
  }

  template <class F>
  void Query(int index, int t, F&& visit) const {
    const Node& node = nodes_[index];
    if (!node.box.Meets(boxes_[t])) return;
    if (node.right < 0) {
      for (int i = node.begin; i < node.end; ++i)
        if (triangles_[i] > t && boxes_[triangles_[i]].Meets(boxes_[t])) visit(t, triangles_[i]);
      return;
    }
    Query(index + 1, t, visit);
    Query(node.right, t, visit);
  }

  std::vector<int> triangles_;
  std::vector<Box> boxes_;
  std::vector<Node> nodes_;
};

}  // namespace

std::vector<IntersectingPair> FindSelfIntersections(const SurfaceMesh& surface, int most,
                                                    const Progress& progress) {
  // The predicates keep their rounding constants in the library; without its static filter they
  // depend on nothing else.
  static std::once_flag once;
  std::call_once(once, [] { exactinit(0, 0, 1, 1.0, 1.0, 1.0); });

  std::vector<int> with_area;
  for (int t = 0; t < static_cast<int>(surface.triangles.size()); ++t) {
    const auto& [a, b, c] = surface.triangles[t];
    const Point &x = surface.vertices[a], &y = surface.vertices[b], &z = surface.vertices[c];
    if (glm::cross(y - x, z - x) != Point(0.0)) with_area.push_back(t);
  }
  std::vector<IntersectingPair> pairs;
  BoxTree(surface, std::move(with_area)).ForEachPair(progress, [&](int s, int t) {
    if (static_cast<int>(pairs.size()) < most && Intersect(surface, s, t)) pairs.push_back({s, t});
  });
  std::sort(pairs.begin(), pairs.end(), [](const auto& p, const auto& q) {
    return std::pair(p.first, p.second) < std::pair(q.first, q.second);
  });
  return pairs;
}

glm::dvec3 PlaceOf(const SurfaceMesh& surface, const IntersectingPair& pair) {
  // Where a side of one goes through the plane of the other, in plain arithmetic; else between
  // their centres.
  const auto corner = [&](int t, int i) { return surface.vertices[surface.triangles[t][i % 3]]; };
  const std::array<std::array<int, 2>, 2> orders = {
      {{pair.first, pair.second}, {pair.second, pair.first}}};
  for (const auto& [s, t] : orders) {
    const Point origin = corner(t, 0);
    const Point normal = glm::cross(corner(t, 1) - origin, corner(t, 2) - origin);
    for (int side = 0; side < 3; ++side) {
      const Point p = corner(s, side), q = corner(s, side + 1);
      const double from = glm::dot(normal, p - origin), to = glm::dot(normal, q - origin);
      if (from * to >= 0) continue;
      const Point x = p + (q - p) * (from / (from - to));
      bool inside = true;
      for (int i = 0; i < 3; ++i)
        inside &=
            glm::dot(normal, glm::cross(corner(t, i + 1) - corner(t, i), x - corner(t, i))) >= 0;
      if (inside) return x;
    }
  }
  Point sum(0.0);
  for (int i = 0; i < 3; ++i) sum += corner(pair.first, i) + corner(pair.second, i);
  return sum / 6.0;
}

}  // namespace arthro::authoring
