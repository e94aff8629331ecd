#include "tests/support/tissue/tissue_meshes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

#include "simulation/core/error.h"
#include "simulation/core/units.h"

namespace arthro::test {
namespace {

constexpr double kNear = 1e-9;  // m: on a plane or not; cells are larger than 10 µm

// Steps from a hexahedron's first corner to its last, an axis at a time: one tetrahedron for each
// order of the axes. Odd orders are mirrored, so two of their corners change places.
constexpr int kAxisOrders[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2},
                                   {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
constexpr bool kIsOdd[6] = {false, true, true, false, false, true};
// Edges in the order of their middle nodes (tet_mesh.h).
constexpr int kEdges[6][2] = {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};

using Node = std::array<int, 3>;  // index in the grid of nodes

std::vector<double> WithMiddles(const std::vector<double>& ticks) {
  std::vector<double> fine;
  for (std::size_t i = 0; i + 1 < ticks.size(); ++i) {
    fine.push_back(ticks[i]);
    fine.push_back(0.5 * (ticks[i] + ticks[i + 1]));
  }
  fine.push_back(ticks.back());
  return fine;
}

template <class Holds>
void AddSet(TetMesh& mesh, const std::string& name, Holds holds) {
  std::vector<std::uint8_t> flags;
  for (const glm::dvec3& x : mesh.rest_positions) flags.push_back(holds(x) ? 1 : 0);
  mesh.sets[name] = flags;
}

bool Is(double value, double wanted) { return std::abs(value - wanted) < kNear; }

GridTicks EvenBox(const Cells& cells, const glm::dvec3& size) {
  return {EvenTicks(0, size.x, cells[0]), EvenTicks(0, size.y, cells[1]),
          EvenTicks(0, size.z, cells[2])};
}

}  // namespace

std::vector<double> EvenTicks(double low, double high, int cells) {
  if (cells < 1)
    throw Error(Code::kBadArgument, "a grid has at least one cell along each of its axes");
  std::vector<double> ticks;
  for (int i = 0; i <= cells; ++i) ticks.push_back(low + (high - low) * i / cells);
  return ticks;
}

std::vector<double> GradedTicks(double low, double high, int cells, double ratio) {
  double whole = 0, cell = 1;
  for (int i = 0; i < cells; ++i, cell *= ratio) whole += cell;
  std::vector<double> ticks{low};
  double done = 0;
  cell = 1;
  for (int i = 0; i + 1 < cells; ++i, cell *= ratio)
    ticks.push_back(low + (high - low) * (done += cell) / whole);
  ticks.push_back(high);
  return ticks;
}

TetMesh GridMesh(int order, const GridTicks& ticks,
                 const std::function<glm::dvec3(const glm::dvec3&)>& place) {
  for (const auto& axis : ticks)
    if (axis.size() < 2 ||
        std::adjacent_find(axis.begin(), axis.end(), std::greater_equal<>()) != axis.end())
      throw Error(Code::kBadArgument, "ticks of a grid rise, and there are at least two an axis");
  GridTicks nodes = ticks;
  if (order == 2)
    for (auto& axis : nodes) axis = WithMiddles(axis);
  const auto index = [&](const Node& n) {
    return (n[0] * static_cast<int>(nodes[1].size()) + n[1]) * static_cast<int>(nodes[2].size()) +
           n[2];
  };

  TetMesh mesh;
  mesh.order = order;
  for (const double a : nodes[0])
    for (const double b : nodes[1])
      for (const double c : nodes[2]) mesh.rest_positions.push_back(place({a, b, c}));

  const int step = order == 2 ? 2 : 1;
  Node first;
  for (first[0] = 0; first[0] + step < static_cast<int>(nodes[0].size()); first[0] += step)
    for (first[1] = 0; first[1] + step < static_cast<int>(nodes[1].size()); first[1] += step)
      for (first[2] = 0; first[2] + step < static_cast<int>(nodes[2].size()); first[2] += step)
        for (int tet = 0; tet < 6; ++tet) {
          std::array<Node, 4> corner{first, first, first, first};
          for (int walked = 1; walked < 4; ++walked)
            for (int k = 0; k < walked; ++k)
              corner[static_cast<std::size_t>(walked)]
                    [static_cast<std::size_t>(kAxisOrders[tet][k])] += step;
          if (kIsOdd[tet]) std::swap(corner[1], corner[2]);
          for (const Node& n : corner) mesh.elements.push_back(index(n));
          if (order != 2) continue;
          for (const auto& edge : kEdges) {
            Node middle;
            for (std::size_t axis = 0; axis < 3; ++axis)
              middle[axis] = (corner[static_cast<std::size_t>(edge[0])][axis] +
                              corner[static_cast<std::size_t>(edge[1])][axis]) /
                             2;
            mesh.elements.push_back(index(middle));
          }
        }
  return mesh;
}

TetMesh BeamMesh(int order, const Cells& cells) {
  const glm::dvec3 size(0.1, 0.01, 0.01);
  TetMesh mesh =
      GridMesh(order, EvenBox(cells, size), [](const glm::dvec3& parameter) { return parameter; });
  AddSet(mesh, "clamp", [](const glm::dvec3& x) { return Is(x.x, 0); });
  AddSet(mesh, "end", [&](const glm::dvec3& x) { return Is(x.x, size.x); });
  AddSet(mesh, "tip", [&](const glm::dvec3& x) {
    return Is(x.x, size.x) && (Is(x.y, 0) || Is(x.y, size.y)) && (Is(x.z, 0) || Is(x.z, size.z));
  });
  return mesh;
}

TetMesh CookMesh(int order, const Cells& cells) {
  const glm::dvec3 size(0.048, 1, 0.01);  // y: share of the height between the slanted edges
  TetMesh mesh = GridMesh(order, EvenBox(cells, size), [&](const glm::dvec3& p) {
    const double along = p.x / size.x;
    const double low = 0.044 * along, high = 0.044 + 0.016 * along;
    return glm::dvec3(p.x, low + (high - low) * p.y, p.z);
  });
  AddSet(mesh, "clamp", [](const glm::dvec3& x) { return Is(x.x, 0); });
  AddSet(mesh, "end", [&](const glm::dvec3& x) { return Is(x.x, size.x); });
  AddSet(mesh, "tip", [&](const glm::dvec3& x) {
    return Is(x.x, size.x) && Is(x.y, 0.06) && (Is(x.z, 0) || Is(x.z, size.z));
  });
  return mesh;
}

TetMesh BlockMesh(int order, const Cells& cells) {
  constexpr double kSide = 0.01;
  TetMesh mesh = GridMesh(order, EvenBox(cells, glm::dvec3(kSide)),
                          [](const glm::dvec3& parameter) { return parameter; });
  AddSet(mesh, "bottom", [](const glm::dvec3& x) { return Is(x.z, 0); });
  AddSet(mesh, "top", [](const glm::dvec3& x) { return Is(x.z, kSide); });
  AddSet(mesh, "bulge", [](const glm::dvec3& x) {
    return Is(x.x, kSide) && Is(x.y, kSide / 2) && Is(x.z, kSide / 2);
  });
  return mesh;
}

TetMesh MeniscusMesh(int order, const GridTicks& ticks) {
  const double half_sweep = RadiansFromDegrees(kSweepDegrees / 2);
  const auto height = [](double radius) {
    constexpr double kInside = 0.0015, kOutside = 0.006;
    return kInside +
           (kOutside - kInside) * (radius - kMeniscusInner) / (kMeniscusOuter - kMeniscusInner);
  };
  TetMesh mesh = GridMesh(order, ticks, [&](const glm::dvec3& p) {
    const double angle = half_sweep * (1 - 2 * p.x);
    return glm::dvec3(p.y * std::cos(angle), p.y * std::sin(angle), height(p.y) * p.z);
  });

  const auto radius = [](const glm::dvec3& x) { return std::hypot(x.x, x.y); };
  // Distances along the arc rather than angles are compared, so that kNear is a length.
  const auto past = [&](const glm::dvec3& x, double degrees) {
    return (std::abs(std::atan2(x.y, x.x)) - RadiansFromDegrees(degrees)) * radius(x);
  };
  const auto is_horn = [&](const glm::dvec3& x) { return past(x, kSweepDegrees / 2) > -kNear; };
  const auto is_top = [&](const glm::dvec3& x) { return Is(x.z, height(radius(x))); };
  AddSet(mesh, "horns", is_horn);
  AddSet(mesh, "underside", [&](const glm::dvec3& x) { return Is(x.z, 0) && !is_horn(x); });
  AddSet(mesh, "patch", [&](const glm::dvec3& x) {
    return is_top(x) && radius(x) > kPatchInner - kNear && radius(x) < kPatchOuter + kNear &&
           past(x, kPatchDegrees) < kNear;
  });
  AddSet(mesh, "inner", [&](const glm::dvec3& x) {
    return is_top(x) && Is(radius(x), kMeniscusInner) && Is(x.y, 0);
  });
  return mesh;
}

GridTicks MeniscusTicks(const Cells& cells) {
  return {EvenTicks(0, 1, cells[0]), EvenTicks(kMeniscusInner, kMeniscusOuter, cells[1]),
          EvenTicks(0, 1, cells[2])};
}

GridTicks MeniscusTicks(const std::vector<double>& degrees, const std::vector<double>& radius_mm,
                        const std::vector<double>& height) {
  GridTicks ticks;
  for (auto d = degrees.rbegin(); d != degrees.rend(); ++d)
    ticks[0].push_back(0.5 - *d / kSweepDegrees);
  for (const double d : degrees)
    if (d > 0) ticks[0].push_back(0.5 + d / kSweepDegrees);
  for (const double mm : radius_mm) ticks[1].push_back(MetresFromMm(mm));
  ticks[2] = height;
  return ticks;
}

GridTicks BentMeniscusTicks(int beyond, int across) {
  const std::vector<double> radius = across == 3 ? std::vector<double>{10, 12.5, 15, 20}
                                                 : std::vector<double>{10, 12.5, 15, 17.2, 20};
  return MeniscusTicks(GradedTicks(kPatchDegrees, kSweepDegrees / 2, beyond, 0.9), radius, {0, 1});
}

GridTicks PressedMeniscusTicks() {
  return MeniscusTicks({6.5, kPatchDegrees, 10.8, 21, kSweepDegrees / 2},
                       {10, 11.5, 12.2, 12.5, 12.8, 14.5, 15, 15.5, 16.5, 20}, {0, 0.8, 1});
}

}  // namespace arthro::test
