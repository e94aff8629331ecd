// The panorama and its relief as they are uploaded: reduced where the graphics card needs it, with
// a soft end where nothing was imaged. Plain values, no OpenGL.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "simulation/scene/image.h"
#include "simulation/scene/projection.h"

namespace arthro::app {

struct BackdropTexture {
  int width = 0, height = 0;
  int reduction = 1;   // panorama pixels a texel and axis
  bool wraps = false;  // the panorama is a whole turn: its left edge meets its right
  std::vector<std::uint8_t>
      rgba;                     // top row first; alpha: 255 well inside the imaged part, 0 outside
  std::vector<float> relief;    // m; 0 where it is not known; empty without a depth map
  glm::dvec3 mean_colour{0.2};  // linear, of the imaged part
  glm::dvec3 bright_colour{0.6};  // linear, mean of its brightest fifth
};

// `depth` may be empty. `max_size` is the largest texture edge.
BackdropTexture MakeBackdropTexture(const ColourImage& panorama, const DepthMap& depth,
                                    const Projection& projection, int max_size);

}  // namespace arthro::app
