#include "app/view/instruments/loft_mesh.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace arthro::app {
namespace {

void AddCap(SurfaceMesh& mesh, const Section& section, bool is_last) {
  const int first = static_cast<int>(mesh.vertices.size());
  const int count = static_cast<int>(section.size());
  glm::dvec3 middle{0.0};
  for (const glm::dvec3& x : section) middle += x / static_cast<double>(count);
  mesh.vertices.insert(mesh.vertices.end(), section.begin(), section.end());
  mesh.vertices.push_back(middle);
  for (int i = 0; i < count; ++i) {
    const int a = first + i, b = first + (i + 1) % count;
    if (is_last)
      mesh.triangles.push_back({a, b, first + count});
    else
      mesh.triangles.push_back({b, a, first + count});
  }
}

// Adds one smooth piece: sections `low` to `high`, points `from` to `to` (which may pass the end).
void AddPiece(SurfaceMesh& mesh, const std::vector<Section>& sections, int low, int high, int from,
              int to) {
  const int around = static_cast<int>(sections.front().size());
  const bool is_ring = to - from == around && from == 0;
  const int columns = is_ring ? around : to - from + 1;
  const int first = static_cast<int>(mesh.vertices.size());
  for (int s = low; s <= high; ++s)
    for (int i = 0; i < columns; ++i)
      mesh.vertices.push_back(
          sections[static_cast<std::size_t>(s)][static_cast<std::size_t>((from + i) % around)]);
  for (int s = 0; s < high - low; ++s)
    for (int i = 0; i < to - from; ++i) {
      const int a = first + s * columns + i, b = first + s * columns + (i + 1) % columns;
      mesh.triangles.push_back({a, b, b + columns});
      mesh.triangles.push_back({a, b + columns, a + columns});
    }
}

}  // namespace

void AddLoft(SurfaceMesh& mesh, const std::vector<Section>& sections, const LoftEdges& edges) {
  const int last = static_cast<int>(sections.size()) - 1;
  const int around = static_cast<int>(sections.front().size());
  std::vector<int> cuts = {0};
  for (const int crease : edges.creases)
    if (crease > 0 && crease < last) cuts.push_back(crease);
  cuts.push_back(last);
  for (std::size_t c = 0; c + 1 < cuts.size(); ++c) {
    if (edges.corners.empty()) {
      AddPiece(mesh, sections, cuts[c], cuts[c + 1], 0, around);
      continue;
    }
    for (std::size_t i = 0; i < edges.corners.size(); ++i) {
      const int from = edges.corners[i];
      const int to =
          i + 1 < edges.corners.size() ? edges.corners[i + 1] : edges.corners.front() + around;
      AddPiece(mesh, sections, cuts[c], cuts[c + 1], from, to);
    }
  }
  AddCap(mesh, sections.front(), false);
  AddCap(mesh, sections.back(), true);
}

void AddRod(SurfaceMesh& mesh, const std::vector<glm::dvec2>& stations, int sides,
            const std::vector<int>& creases) {
  std::vector<Section> sections;
  for (const glm::dvec2& station : stations) {
    Section ring;
    for (int i = 0; i < sides; ++i) {
      const double a = 2.0 * std::numbers::pi * i / sides;
      ring.push_back({station.y * std::cos(a), station.y * std::sin(a), station.x});
    }
    sections.push_back(std::move(ring));
  }
  AddLoft(mesh, sections, {{}, creases});
}

std::vector<double> ShaftStations(double end, double length, double spacing) {
  constexpr double kNear = 15e-3, kJoint = 50e-3;  // m behind the end
  std::vector<double> stations;
  double behind = 0.0;
  while (behind < length) {
    stations.push_back(end - behind);
    behind += behind < kNear ? spacing : behind < kJoint ? 2.0 * spacing : 20.0 * spacing;
  }
  stations.push_back(end - length);
  std::ranges::reverse(stations);
  return stations;
}

}  // namespace arthro::app
