// Relief of a depth map as the picture draws it: without the noise that its standard error
// explains, with its maxima and slopes. Plain values, no OpenGL, so that it can be made beside the
// window: the noise of a map of two megapixels takes seconds to remove.
#pragma once

#include <glm/vec2.hpp>

#include "app/view/backdrop/backdrop_texture.h"
#include "simulation/scene/scene.h"

namespace arthro::app {

struct DrawnRelief {
  ReliefTexture texture;
  ReliefCeiling ceiling;
  BroadSlopes slopes;     // for the lamp; empty where neither it nor the error is known
  bool is_noisy = false;  // the standard error is known
  double least_side = 0;  // m, height of the lowest step that has a side; 0: no limit
};

// Whether the noise of a depth map is removed, or drawn until that is done.
enum class ReliefNoise { kRemoved, kKept };

// `sigma`: standard error of the depth map, of its size; empty: not known.
DrawnRelief MakeDrawnRelief(const glm::ivec2& panorama_size, const DepthMap& depth,
                            const DepthMap& sigma, const Backdrop& backdrop,
                            ReliefNoise noise = ReliefNoise::kRemoved);

}  // namespace arthro::app
