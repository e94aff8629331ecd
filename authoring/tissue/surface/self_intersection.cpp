#include "authoring/tissue/surface/self_intersection.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <mutex>
#include <numeric>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "authoring/tissue/surface/time_limit.h"
#include "simulation/core/geometry/box_tree.h"
#include "simulation/scene/mesh/surface_finder.h"

// TetGen's library provides Shewchuk's predicates here; the mesher itself runs in a process of its
// own.
#define TETLIBRARY
#include <tetgen.h>
double orient2d(double* a, double* b, double* c);  // in the library, but not in its header

namespace arthro::authoring {
namespace {

using Point = glm::dvec3;

int Sign(double value) { return value > 0 ? 1 : value < 0 ? -1 : 0; }

double* Raw(const Point& p) { return const_cast<double*>(&p.x); }

// Returns the side of the plane through a, b, c on which d lies.
int Side(const Point& a, const Point& b, const Point& c, const Point& d) {
  return Sign(orient3d(Raw(a), Raw(b), Raw(c), Raw(d)));
}

// Signs in the plane of one triangle, on its projection along the axis that it faces most. Exact,
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
  // For p, q and x on one line: whether x lies between p and q, or on one of them.
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

// Tests the closed segment pq against the closed triangle abc.
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

// Corners of two triangles, rotated so that shared corners come first.
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
    case 1:  // away from the shared corner, the opposite sides must stay clear
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

}  // namespace

std::vector<IntersectingPair> FindSelfIntersections(const SurfaceMesh& surface, int most,
                                                    const Progress& progress) {
  // The predicates keep their rounding constants in the library; without the static filter they
  // depend on nothing else.
  static std::once_flag once;
  std::call_once(once, [] { exactinit(0, 0, 1, 1.0, 1.0, 1.0); });

  std::vector<int> with_area;
  std::vector<Box3> boxes;
  for (int t = 0; t < static_cast<int>(surface.triangles.size()); ++t) {
    const TriangleCorners corner = CornersOf(surface, static_cast<std::size_t>(t));
    if (glm::cross(corner[1] - corner[0], corner[2] - corner[0]) == Point(0.0)) continue;
    with_area.push_back(t);
    boxes.push_back(BoxOf(corner));
  }
  const BoxTree tree(boxes);
  std::vector<IntersectingPair> pairs;
  StageSteps steps(progress, "looking for self-intersections", with_area.size());
  for (int i = 0; i < static_cast<int>(boxes.size()); ++i) {
    steps.Next();
    double touching2 = 0;
    tree.ForNear(boxes[i], touching2, [&](int j) {
      if (j > i && Distance2(boxes[i], boxes[j]) == 0 && static_cast<int>(pairs.size()) < most &&
          Intersect(surface, with_area[i], with_area[j]))
        pairs.push_back({with_area[i], with_area[j]});
    });
  }
  std::sort(pairs.begin(), pairs.end(), [](const auto& p, const auto& q) {
    return std::pair(p.first, p.second) < std::pair(q.first, q.second);
  });
  return pairs;
}

glm::dvec3 PlaceOf(const SurfaceMesh& surface, const IntersectingPair& pair) {
  // Point where a side of one triangle passes through the plane of the other, in plain arithmetic;
  // else the mean of their corners.
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
