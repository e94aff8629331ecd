#include "authoring/tissue/surface/fine_places.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "authoring/tissue/surface/surface_topology.h"
#include "simulation/core/error.h"
#include "simulation/core/finite.h"
#include "simulation/core/units.h"
#include "simulation/scene/mesh/surface_finder.h"

namespace arthro::authoring {
namespace {

std::string Words(const glm::dvec3& x) {
  const glm::dvec3 mm = x / kMetrePerMillimetre;
  return fmt::format("({:.3g}, {:.3g}, {:.3g})", mm.x, mm.y, mm.z);
}

}  // namespace

bool Touches(const Ball& ball, const SurfaceMesh& surface) {
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    if (Distance2(CornersOf(surface, t), ball.centre) <= ball.radius * ball.radius) return true;
  return WindingNumber(surface.vertices, surface.triangles, ball.centre) > 0.5;
}

void RequireTouching(std::span<const Ball> balls, const SurfaceMesh& surface,
                     const std::string& what, const SurfaceSource& source) {
  for (std::size_t i = 0; i < balls.size(); ++i) {
    const Ball& ball = balls[i];
    const auto refuse = [&](const std::string& why) {
      throw Error(Code::kBadArgument, fmt::format("{}, number {}, {}", what, i + 1, why),
                  source.file);
    };
    if (!IsFinite(ball.centre) || !std::isfinite(ball.radius))
      refuse("is not a number; give its centre and radius in millimetres");
    if (!(ball.radius > 0)) refuse("has no radius; give it one of more than 0 mm");
    if (Touches(ball, surface)) continue;
    glm::dvec3 low(INFINITY), high(-INFINITY);
    for (const glm::dvec3& x : surface.vertices) low = glm::min(low, x), high = glm::max(high, x);
    refuse(fmt::format(
        "a ball of {:.3g} mm at {} mm, does not touch the surface, which lies from {} to {} mm; "
        "give its centre in the surface's own frame",
        MmFromMetres(ball.radius), Words(ball.centre), Words(low), Words(high)));
  }
}

double LongestEdgeIn(const Ball& ball, const TetMesh& mesh) {
  double longest = 0;
  for (int e = 0; e < mesh.ElementCount(); ++e) {
    const int* node = &mesh.elements[static_cast<std::size_t>(e) *
                                     static_cast<std::size_t>(mesh.NodesPerElement())];
    const auto at = [&](int i) { return mesh.rest_positions[static_cast<std::size_t>(node[i])]; };
    bool is_in = false;
    for (int i = 0; i < 4; ++i) is_in |= glm::distance(at(i), ball.centre) <= ball.radius;
    for (int i = 0; is_in && i < 4; ++i)
      for (int j = i + 1; j < 4; ++j) longest = std::max(longest, glm::distance(at(i), at(j)));
  }
  return longest;
}

}  // namespace arthro::authoring
