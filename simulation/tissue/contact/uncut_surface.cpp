#include "simulation/tissue/contact/uncut_surface.h"

#include <algorithm>
#include <array>
#include <vector>

#include <glm/geometric.hpp>

namespace arthro::simulation {
namespace {

// In spacings of the field: largest error of its skin, and distance from a cut within which it
// stays as it is.
constexpr double kReach = 0.8, kNearCut = 1.0;
// Largest displacement of vertices at a cut, in spacings. The lips of a cut follow grid cells, so
// they are relaxed too.
constexpr double kMostMoved = 0.4;
constexpr int kRelaxations = 4;

}  // namespace

void ProjectOnto(const SurfaceFinder& uncut, const SolidField& field,
                 std::span<const std::uint8_t> is_new, SurfaceMesh& skin) {
  const double reach = kReach * field.spacing(), near_cut = kNearCut * field.spacing(),
               most = kMostMoved * field.spacing();
  std::vector<std::size_t> free, at_cut;
  for (std::size_t v = 0; v < skin.vertices.size(); ++v)
    if (is_new.empty() || is_new[v] != 0)
      (field.CutDistance(skin.vertices[v]) < -near_cut ? free : at_cut).push_back(v);
  const std::vector<glm::dvec3> of_grid = skin.vertices;
  for (const std::size_t v : free) skin.vertices[v] = uncut.Nearest(skin.vertices[v], reach);

  // Triangles with a vertex that may move.
  std::vector<unsigned char> is_moved(skin.vertices.size(), 0);
  for (const auto* list : {&free, &at_cut})
    for (const std::size_t v : *list) is_moved[v] = 1;
  std::vector<std::array<int, 3>> triangles;
  for (const auto& t : skin.triangles)
    if (std::ranges::any_of(t, [&](int v) { return is_moved[static_cast<std::size_t>(v)] != 0; }))
      triangles.push_back(t);
  std::vector<glm::dvec3> sum(skin.vertices.size());
  std::vector<int> count(skin.vertices.size());
  for (int relaxation = 0; relaxation < kRelaxations; ++relaxation) {
    std::fill(sum.begin(), sum.end(), glm::dvec3(0.0));
    std::fill(count.begin(), count.end(), 0);
    for (const auto& t : triangles)
      for (std::size_t i = 0; i < 3; ++i) {
        const auto v = static_cast<std::size_t>(t[i]), w = static_cast<std::size_t>(t[(i + 1) % 3]);
        sum[v] += skin.vertices[w];
        ++count[v];
      }
    const auto relaxed = [&](std::size_t v) {
      return count[v] > 0 ? 0.5 * (skin.vertices[v] + sum[v] / static_cast<double>(count[v]))
                          : skin.vertices[v];
    };
    for (const std::size_t v : free) skin.vertices[v] = uncut.Nearest(relaxed(v), reach);
    for (const std::size_t v : at_cut) {
      const glm::dvec3 way = relaxed(v) - of_grid[v];
      const double length = glm::length(way);
      skin.vertices[v] = of_grid[v] + (length > most ? most / length : 1.0) * way;
    }
  }
}

}  // namespace arthro::simulation
