#include "simulation/haptics/surface/surface_bvh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace arthro::simulation {
namespace {

constexpr int kLeafSize = 4;    // triangles; below four, another box costs more than it saves
constexpr int kStackSize = 64;  // levels; a median split of 2^31 triangles has 31

// Cosine below which a motion counts as parallel; it then drifts by 1 pm over 1 mm.
constexpr double kParallel = 1e-9;

float RoundDown(double x) noexcept {
  return std::nextafter(static_cast<float>(x), -std::numeric_limits<float>::infinity());
}
float RoundUp(double x) noexcept {
  return std::nextafter(static_cast<float>(x), std::numeric_limits<float>::infinity());
}

// Solves |offset + t·motion| = radius for a ball and a point, with the offset from the point to the
// centre of the ball. Returns the first t ≥ 0 while approaching, infinity where there is none.
double TimeOfTouch(const glm::dvec3& offset, const glm::dvec3& motion, double radius) noexcept {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  const double a = glm::dot(motion, motion), b = glm::dot(offset, motion);
  const double c = glm::dot(offset, offset) - radius * radius;
  if (!(b < -kParallel * std::sqrt(a * glm::dot(offset, offset)))) return kNever;
  if (c <= 0.0) return 0.0;
  const double d = b * b - a * c;
  return d < 0.0 ? kNever : std::max(0.0, c / (-b + std::sqrt(d)));
}

bool Contains(const TriangleCorners& corner, const glm::dvec3& normal,
              const glm::dvec3& x) noexcept {
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::dvec3 edge = corner[(i + 1) % 3] - corner[i];
    if (glm::dot(glm::cross(edge, x - corner[i]), normal) < 0.0) return false;
  }
  return true;
}

// Separating-axis test for a long way, whose own box is mostly empty: a box is apart from the swept
// ball where their projections on an axis perpendicular to the way and to a side of the box are.
class LongWay {
 public:
  LongWay(const glm::dvec3& from, const glm::dvec3& motion, double radius) noexcept
      : from_(from), motion_(motion), reach_(glm::abs(motion)) {
    constexpr double kRounding = 1e-12;  // m
    for (int i = 0, j = 1, k = 2; i < 3; j = k, k = i, ++i)
      beside_[i] = (radius + kRounding) * std::sqrt(reach_[j] * reach_[j] + reach_[k] * reach_[k]);
  }
  [[gnu::noinline]] bool IsApart(const std::array<float, 3>& low,
                                 const std::array<float, 3>& high) const noexcept {
    glm::dvec3 centre, half;
    for (int i = 0; i < 3; ++i) {
      const auto k = static_cast<std::size_t>(i);
      const double a = static_cast<double>(low[k]), b = static_cast<double>(high[k]);
      centre[i] = 0.5 * (a + b) - from_[i];
      half[i] = 0.5 * (b - a);
    }
    const glm::dvec3 off = glm::abs(glm::cross(centre, motion_));
    for (int i = 0, j = 1, k = 2; i < 3; j = k, k = i, ++i)
      if (off[i] > half[j] * reach_[k] + half[k] * reach_[j] + beside_[i]) return true;
    return false;
  }

 private:
  glm::dvec3 from_, motion_, reach_;
  glm::dvec3 beside_{0.0};  // projected radius of the ball, times the length of the way
};

}  // namespace

SurfaceBvh::SurfaceBvh(const SurfaceMesh& mesh, const Pose& portal_from_mesh) {
  triangles_.reserve(mesh.triangles.size());
  double area_sum = 0.0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const auto corner = [&](int i) {
      return portal_from_mesh * mesh.vertices[static_cast<std::size_t>(i)];
    };
    Triangle triangle{{corner(a), corner(b), corner(c)}, {}};
    const glm::dvec3 across = glm::cross(triangle.corner[1] - triangle.corner[0],
                                         triangle.corner[2] - triangle.corner[0]);
    const double area = glm::length(across);
    if (!(area > 1e-18) || !std::isfinite(area)) continue;  // m², 1 nm square
    triangle.normal = across / area;
    triangles_.push_back(triangle);
    area_sum += 0.5 * area;
  }
  if (triangles_.empty()) return;
  triangle_size_ = std::sqrt(area_sum / static_cast<double>(triangles_.size()));
  nodes_.reserve(triangles_.size());
  Build(0, static_cast<int>(triangles_.size()));
}

void SurfaceBvh::Build(int first, int count) {
  const auto begin = triangles_.begin() + first, end = begin + count;
  glm::dvec3 low = begin->corner[0], high = low, low_centre(1e300), high_centre(-1e300);
  const auto centre = [](const Triangle& t) { return t.corner[0] + t.corner[1] + t.corner[2]; };
  for (auto triangle = begin; triangle != end; ++triangle) {
    for (const glm::dvec3& x : triangle->corner) low = glm::min(low, x), high = glm::max(high, x);
    low_centre = glm::min(low_centre, centre(*triangle));
    high_centre = glm::max(high_centre, centre(*triangle));
  }
  const std::size_t node = nodes_.size();
  nodes_.emplace_back();
  for (int i = 0; i < 3; ++i) {
    nodes_[node].low[static_cast<std::size_t>(i)] = RoundDown(low[i]);
    nodes_[node].high[static_cast<std::size_t>(i)] = RoundUp(high[i]);
  }
  if (count <= kLeafSize) {
    nodes_[node].next = first;
    nodes_[node].count = count;
    return;
  }
  // Splits along the axis of largest extent; ties keep the order of the file.
  const glm::dvec3 spread = high_centre - low_centre;
  const int axis = spread.x >= spread.y && spread.x >= spread.z ? 0 : spread.y >= spread.z ? 1 : 2;
  const int half = count / 2;
  std::nth_element(begin, begin + half, end, [&](const Triangle& a, const Triangle& b) {
    return centre(a)[axis] < centre(b)[axis];
  });
  Build(first, half);
  nodes_[node].next = static_cast<std::int32_t>(nodes_.size());
  Build(first + half, count - half);
}

bool SweepTriangle(const TriangleCorners& corner, const glm::dvec3& normal, const glm::dvec3& from,
                   const glm::dvec3& motion, double radius, SweepHit& hit) noexcept {
  const double towards = -glm::dot(normal, motion);
  const double height = glm::dot(normal, from - corner[0]);
  if (height < 0.0 || towards <= 0.0) return false;  // behind the triangle, or leaving
  if (towards * towards <= kParallel * kParallel * glm::dot(motion, motion)) return false;
  // The ball meets the plane before the triangle.
  const double plane = std::max(0.0, (height - radius) / towards);
  if (plane >= hit.fraction) return false;
  const glm::dvec3 centre = from + plane * motion;
  if (Contains(corner, normal, centre)) {
    hit.fraction = plane;
    hit.normal = normal;
    hit.gap = std::min(0.0, height - radius);
    return true;
  }
  // Outside the face: tests the rounded edges, whose ends are the rounded corners.
  bool found = false;
  const auto keep = [&](double t, const glm::dvec3& offset) {
    const double distance = glm::length(offset);
    if (!(t < hit.fraction) || !(distance > 0.0)) return;
    hit.fraction = t;
    hit.normal = offset / distance;
    hit.gap = std::min(0.0, distance - radius);
    found = true;
  };
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::dvec3 edge = corner[(i + 1) % 3] - corner[i], offset = from - corner[i];
    const double per_length2 = 1.0 / glm::dot(edge, edge);
    const double along_offset = glm::dot(offset, edge) * per_length2;
    const double along_motion = glm::dot(motion, edge) * per_length2;
    const glm::dvec3 across = offset - along_offset * edge;
    const glm::dvec3 motion_across = motion - along_motion * edge;
    const double t = TimeOfTouch(across, motion_across, radius);
    const double where = along_offset + t * along_motion;
    if (t < hit.fraction && where >= 0.0 && where <= 1.0) keep(t, across + t * motion_across);
    const double at_corner = TimeOfTouch(offset, motion, radius);
    if (at_corner < hit.fraction) keep(at_corner, offset + at_corner * motion);
  }
  return found;
}

bool SurfaceBvh::Sweep(const glm::dvec3& from, const glm::dvec3& to, double radius, int first,
                       SweepHit& hit) const noexcept {
  if (nodes_.empty()) return false;
  const glm::dvec3 motion = to - from;
  bool found = false;
  const auto test = [&](int i) {
    const Triangle& triangle = triangles_[static_cast<std::size_t>(i)];
    if (!SweepTriangle(triangle.corner, triangle.normal, from, motion, radius, hit)) return;
    hit.triangle = i;
    found = true;
  };
  if (first >= 0 && first < static_cast<int>(triangles_.size())) test(first);
  glm::dvec3 low, high;
  // A short way, of a few triangles, fills its box.
  std::optional<LongWay> long_way;
  const double few = 4.0 * (radius + triangle_size_);
  if (glm::dot(motion, motion) > few * few) long_way.emplace(from, motion, radius);
  const auto shrink = [&] {  // box of the remaining way
    const glm::dvec3 end = from + hit.fraction * motion;
    low = glm::min(from, end);
    high = glm::max(from, end);
  };
  shrink();
  // Compares distances instead of boxes: the box of a resting ball holds much more of the surface
  // than the ball.
  const auto is_apart = [&](const Node& node) {
    double distance2 = 0.0;
    for (int i = 0; i < 3; ++i) {
      const auto k = static_cast<std::size_t>(i);
      const double gap = std::max({0.0, low[i] - static_cast<double>(node.high[k]),
                                   static_cast<double>(node.low[k]) - high[i]});
      distance2 += gap * gap;
    }
    return distance2 > radius * radius;
  };
  const auto along = [&](const Node& node) {
    double sum = 0.0;
    for (int i = 0; i < 3; ++i) {
      const auto k = static_cast<std::size_t>(i);
      sum += static_cast<double>(node.low[k] + node.high[k]) * motion[i];
    }
    return sum;
  };
  int stack[kStackSize], depth = 0;
  stack[depth++] = 0;
  while (depth > 0 && hit.fraction > 0.0) {
    const int index = stack[--depth];
    const Node& node = nodes_[static_cast<std::size_t>(index)];
    if (is_apart(node) || (long_way && long_way->IsApart(node.low, node.high))) continue;
    if (node.count == 0) {  // visits the nearer child first, since a hit shortens the way
      const int first_child = index + 1;
      const bool is_second_nearer = along(nodes_[static_cast<std::size_t>(node.next)]) <
                                    along(nodes_[static_cast<std::size_t>(first_child)]);
      stack[depth++] = is_second_nearer ? first_child : node.next;
      stack[depth++] = is_second_nearer ? node.next : first_child;
      continue;
    }
    const double before = hit.fraction;
    for (int i = node.next; i < node.next + node.count; ++i) test(i);
    if (hit.fraction < before) shrink();
  }
  return found;
}

}  // namespace arthro::simulation
