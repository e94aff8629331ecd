#include "simulation/training/robot/steps/bite_plan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

#include "simulation/scope/rod_pose.h"

namespace arthro::simulation {
namespace {

constexpr double kGrid = 4e-4;      // m, of the points that stand for the tissue
constexpr double kAround = 2.5e-3;  // m about the regions in which the rest of the tissue counts
constexpr double kBlocked = 0.5;    // cost of a point in the way of a jaw
constexpr double kNeck = 4e-4;      // m about a bite, in which what is left holds nothing
constexpr int kBiteRolls = 24;
constexpr double kMiddles = 7e-4;  // m, between places of a bite
constexpr double kBeyond = 1e-3;   // m, of such a place outside of the regions

// Places where a ray along x through (y, z) enters or leaves a surface.
void Crossings(const SurfaceMesh& skin, double y, double z, std::vector<double>& at) {
  at.clear();
  for (const auto& triangle : skin.triangles) {
    const glm::dvec3& a = skin.vertices[static_cast<std::size_t>(triangle[0])];
    const glm::dvec3& b = skin.vertices[static_cast<std::size_t>(triangle[1])];
    const glm::dvec3& c = skin.vertices[static_cast<std::size_t>(triangle[2])];
    if (std::max({a.y, b.y, c.y}) < y || std::min({a.y, b.y, c.y}) > y ||
        std::max({a.z, b.z, c.z}) < z || std::min({a.z, b.z, c.z}) > z)
      continue;
    const double area = (b.y - a.y) * (c.z - a.z) - (b.z - a.z) * (c.y - a.y);
    if (area == 0) continue;
    const double v = ((y - a.y) * (c.z - a.z) - (z - a.z) * (c.y - a.y)) / area;
    const double w = ((b.y - a.y) * (z - a.z) - (b.z - a.z) * (y - a.y)) / area;
    if (v < 0 || w < 0 || v + w > 1) continue;
    at.push_back(a.x + v * (b.x - a.x) + w * (c.x - a.x));
  }
  std::ranges::sort(at);
}

// Links points that lie beside each other on the grid. `numbers`: of the points, by their cells, −1
// for none; x runs fastest.
void LinkNeighbours(std::vector<TissuePoint>& points, std::span<const int> numbers,
                    const std::array<int, 3>& cells) {
  const std::array<int, 3> stride{1, cells[0], cells[0] * cells[1]};
  for (int cell = 0; cell < static_cast<int>(numbers.size()); ++cell) {
    const int own = numbers[static_cast<std::size_t>(cell)];
    if (own < 0) continue;
    TissuePoint& point = points[static_cast<std::size_t>(own)];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const int at = cell / stride[axis] % cells[axis];
      point.is_held = point.is_held || at == 0 || at == cells[axis] - 1;
      const int before = cell - stride[axis], after = cell + stride[axis];
      if (at > 0) point.beside[2 * axis] = numbers[static_cast<std::size_t>(before)];
      if (at < cells[axis] - 1)
        point.beside[2 * axis + 1] = numbers[static_cast<std::size_t>(after)];
    }
  }
}

// Points that are still held when those with `is_cut` conduct no hold; a cut point may be held, and
// holds none.
std::vector<char> HeldPoints(std::span<const TissuePoint> points, std::span<const char> is_cut) {
  std::vector<char> is_held(points.size(), 0);
  std::vector<int> next;
  next.reserve(points.size());
  const auto reach = [&](int number) {
    const auto i = static_cast<std::size_t>(number);
    if (is_held[i] != 0) return;
    is_held[i] = 1;
    if (is_cut[i] == 0) next.push_back(number);
  };
  for (std::size_t i = 0; i < points.size(); ++i)
    if (points[i].is_held) reach(static_cast<int>(i));
  while (!next.empty()) {
    const int number = next.back();
    next.pop_back();
    for (const int beside : points[static_cast<std::size_t>(number)].beside)
      if (beside >= 0) reach(beside);
  }
  return is_held;
}

bool IsInCapsule(const glm::dvec3& x, const Capsule& capsule) {
  const glm::dvec3 way = capsule.b - capsule.a;
  const double length2 = glm::dot(way, way);
  const double s = length2 > 0 ? std::clamp(glm::dot(x - capsule.a, way) / length2, 0.0, 1.0) : 0;
  const glm::dvec3 off = x - (capsule.a + s * way);
  return glm::dot(off, off) <= capsule.radius * capsule.radius;
}

}  // namespace

std::vector<TissuePoint> PointsOf(const SurfaceMesh& skin, std::span<const Ball> regions,
                                  const Rigid3& portal_from_body) {
  std::vector<TissuePoint> points;
  glm::dvec3 low(1e9), high(-1e9);
  for (const Ball& ball : regions) {
    low = glm::min(low, ball.centre - (ball.radius + kAround));
    high = glm::max(high, ball.centre + (ball.radius + kAround));
  }
  std::array<int, 3> cells{};
  for (int axis = 0; axis < 3; ++axis)
    cells[static_cast<std::size_t>(axis)] =
        std::max(0, static_cast<int>(std::ceil((high[axis] - low[axis]) / kGrid)));
  std::vector<int> numbers;
  std::vector<double> at;
  for (int k = 0; k < cells[2]; ++k)
    for (int j = 0; j < cells[1]; ++j) {
      const double y = low.y + kGrid * j, z = low.z + kGrid * k;
      Crossings(skin, y + 1e-7, z + 1e-7, at);
      for (int i = 0; i < cells[0]; ++i) {
        const glm::dvec3 p(low.x + kGrid * i, y, z);
        const auto before = std::ranges::count_if(at, [&](double each) { return each < p.x; });
        numbers.push_back(before % 2 == 0 ? -1 : static_cast<int>(points.size()));
        if (before % 2 == 0) continue;
        TissuePoint& point = points.emplace_back();
        point.x = portal_from_body * p;
        point.is_wanted = std::ranges::any_of(regions, [&](const Ball& ball) {
          return glm::distance(p, ball.centre) <= ball.radius;
        });
      }
    }
  LinkNeighbours(points, numbers, cells);
  return points;
}

void MoveWithSkin(std::vector<TissuePoint>& points, std::span<const glm::dvec3> rest,
                  std::span<const glm::dvec3> now, const Rigid3& portal_from_body) {
  constexpr double kNear = 1e-8;  // m², so that a point on a vertex moves as that does
  const Rigid3 body_from_portal = Inverse(portal_from_body);
  for (TissuePoint& point : points) {
    const glm::dvec3 x = body_from_portal * point.x;
    // Inverse-distance weights after Shepard (1968), with power 4.
    glm::dvec3 moved(0.0);
    double sum = 0;
    for (std::size_t i = 0; i < std::min(rest.size(), now.size()); ++i) {
      const glm::dvec3 off = x - rest[i];
      const double near = glm::dot(off, off) + kNear;
      const double weight = 1 / (near * near);
      moved += weight * (now[i] - rest[i]);
      sum += weight;
    }
    if (sum > 0) point.x = portal_from_body * (x + moved / sum);
  }
}

std::vector<glm::dvec3> MiddlesOf(std::span<const Ball> regions, const Rigid3& portal_from_body) {
  std::vector<glm::dvec3> middles;
  for (const Ball& ball : regions) {
    const double reach = ball.radius + kBeyond;
    for (double x = -reach; x <= reach; x += kMiddles)
      for (double y = -reach; y <= reach; y += kMiddles)
        for (double z = -reach; z <= reach; z += kMiddles)
          if (glm::length(glm::dvec3(x, y, z)) <= reach)
            middles.push_back(portal_from_body * (ball.centre + glm::dvec3(x, y, z)));
  }
  return middles;
}

double GainAt(std::span<const TissuePoint> points, const glm::dvec3& portal, const glm::dvec3& tip,
              const ToolShape& shape, double rest) {
  // The bite lies on the axis of the tool, so its gain is that of any roll.
  const Rigid3 portal_from_tool = PortalFromTool(portal, tip, 0);
  const Capsule bite{portal_from_tool * shape.bite.a, portal_from_tool * shape.bite.b,
                     shape.bite.radius};
  Capsule torn = bite;
  torn.radius += kNeck;
  std::vector<char> is_bitten(points.size()), is_cut(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    is_cut[i] = static_cast<char>(IsInCapsule(points[i].x, torn));
    is_bitten[i] = static_cast<char>(is_cut[i] != 0 && IsInCapsule(points[i].x, bite));
  }
  const std::vector<char> is_held = HeldPoints(points, is_cut);
  double gain = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (is_bitten[i] != 0 || is_held[i] == 0) gain += points[i].is_wanted ? 1 : -rest;
  return gain;
}

Bite BestBite(std::span<const TissuePoint> points, std::span<const glm::dvec3> middles,
              const glm::dvec3& portal, const ToolShape& shape, double rest) {
  Bite best;
  const double middle = -0.5 * (shape.bite.a.z + shape.bite.b.z);
  for (const glm::dvec3& p : middles) {
    const glm::dvec3 tip = p + middle * glm::normalize(p - portal);
    const double gain = GainAt(points, portal, tip, shape, rest);
    if (gain <= best.gain) continue;
    ToolInput input;
    input.is_present = true;
    input.opening = 1;
    for (int i = 0; i < kBiteRolls; ++i) {
      const double roll = 2 * std::numbers::pi * i / kBiteRolls;
      input.portal_from_tool = PortalFromTool(portal, tip, roll);
      std::array<Capsule, kMaxCapsules> jaws;
      const auto count = static_cast<std::size_t>(PosedCapsules(shape, input, jaws));
      double left = gain;
      for (const TissuePoint& point : points)
        for (std::size_t k = 0; k < count; ++k)
          if (IsInCapsule(point.x, jaws[k])) left -= kBlocked;
      if (left > best.gain) best = {tip, p, roll, left};
    }
  }
  return best;
}

}  // namespace arthro::simulation
