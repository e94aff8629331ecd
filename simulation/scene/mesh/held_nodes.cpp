#include "simulation/scene/mesh/held_nodes.h"

#include <glm/geometric.hpp>

namespace arthro {

std::vector<std::uint8_t> HeldNodes(std::span<const glm::dvec3> nodes,
                                    std::span<const Ball> balls) {
  std::vector<std::uint8_t> held(nodes.size(), 0);
  for (const Ball& ball : balls)
    for (std::size_t i = 0; i < nodes.size(); ++i)
      if (glm::distance(nodes[i], ball.centre) <= ball.radius) held[i] = 1;
  return held;
}

}  // namespace arthro
