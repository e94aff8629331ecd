#include "authoring/tissue/pull_middles.h"

#include <algorithm>
#include <vector>

#include <glm/geometric.hpp>

#include "authoring/tissue/surface_simplify.h"
#include "authoring/tissue/tet_quality.h"

namespace arthro::authoring {

PulledMiddles PullMiddles(TetMesh& mesh, const SurfaceMesh& fine, const Progress& progress) {
  PulledMiddles result;
  if (mesh.order != 2) return result;
  const std::vector<std::uint8_t> is_outside = SurfaceNodes(mesh);
  // Which elements a middle belongs to.
  std::vector<std::vector<int>> elements(mesh.rest_positions.size());
  for (int e = 0; e < mesh.ElementCount(); ++e)
    for (int k = 4; k < 10; ++k)
      elements[static_cast<std::size_t>(mesh.elements[static_cast<std::size_t>(e) * 10 + k])]
          .push_back(e);
  const auto is_sound = [&](std::size_t node) {
    return std::all_of(elements[node].begin(), elements[node].end(),
                       [&](int e) { return JacobianShare(mesh, e) >= kLeastJacobian; });
  };
  // A middle that its neighbours held back may go further once they have gone.
  struct Middle {
    std::size_t node;
    glm::dvec3 straight, move;
    double share = 0;
  };
  std::vector<Middle> middles;
  for (std::size_t node = 0; node < elements.size(); ++node)
    if (!elements[node].empty() && is_outside[node]) {
      progress.Step("curving the elements",
                    static_cast<double>(node) / static_cast<double>(elements.size()));
      const glm::dvec3 straight = mesh.rest_positions[node];
      middles.push_back({node, straight, NearestOnSurface(straight, fine) - straight});
    }
  for (int sweep = 0; sweep < 3; ++sweep)
    for (Middle& middle : middles)
      for (double share = 1.0; share > middle.share && share > 0.1; share -= 0.125) {
        mesh.rest_positions[middle.node] = middle.straight + share * middle.move;
        if (is_sound(middle.node)) {
          middle.share = share;
          break;
        }
        mesh.rest_positions[middle.node] = middle.straight + middle.share * middle.move;
      }
  for (const Middle& middle : middles) {
    ++(middle.share == 1.0 ? result.pulled : result.held_back);
    result.largest_move = std::max(result.largest_move, middle.share * glm::length(middle.move));
  }
  return result;
}

}  // namespace arthro::authoring
