// A relief with its uncertainty and origin, by reference to the parts of a scene. Frame: portal;
// lengths in m, pixels those of the panorama.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "simulation/scene/image.h"
#include "simulation/scene/projection.h"

namespace arthro::authoring {

struct ReliefView {
  const DepthMap& relief;
  const DepthMap& sigma;    // standard error; empty: unknown
  const OriginMap& origin;  // empty: unknown
  const Projection& projection;
  double radius = 0;  // radius of the sphere about the portal
};

// Value of the relief at one pixel.
struct ReliefReading {
  glm::dvec2 pixel{0.0};
  glm::dvec3 point{0.0};  // on the surface
  double range = 0;       // from the portal to the surface; NaN where the surface is unknown
  double sigma = 0;       // standard error of the range; NaN where it is unknown
  ReliefOrigin origin = ReliefOrigin::kNone;
};

// Reads the cell that is nearest to the pixel. Pixels outside of the relief have a range of NaN.
ReliefReading ReadRelief(const ReliefView& view, const glm::dvec2& pixel);

}  // namespace arthro::authoring
