// Relief of a depth map as the picture draws it: without the noise that its standard error
// explains, with its maxima and slopes. Plain values, no OpenGL, so that it can be made beside the
// window: the noise of a map of two megapixels takes seconds to remove.
#pragma once

#include <atomic>
#include <optional>

#include <glm/vec2.hpp>

#include "app/view/backdrop/backdrop_texture.h"
#include "simulation/scene/scene.h"

namespace arthro::app {

struct DrawnRelief {
  DepthMap sampled;  // the relief without its noise, at the texels of `texture`
  ReliefTexture texture;
  ReliefCeiling ceiling;
  BroadSlopes slopes;     // for the lamp; empty where neither it nor the error is known
  bool is_noisy = false;  // the standard error is known
  double least_side = 0;  // m, height of the lowest step that has a side; 0: no limit
};

// How the noise of a depth map is removed: wholly, or quickly, to be drawn until that is done
// (rough_relief.h).
enum class NoiseRemoval { kWhole, kRough };

// Maps of the same backdrop. `sigma`: standard error of the depth map, of its size; empty: not
// known.
struct ReliefMaps {
  const DepthMap& depth;
  const DepthMap& sigma;
};

// Throws Error(kCancelled) once `stop` is set; null: it never is. The same holds below.
DrawnRelief MakeDrawnRelief(const glm::ivec2& panorama_size, const DepthMap& depth,
                            const DepthMap& sigma, const Backdrop& backdrop,
                            NoiseRemoval removal = NoiseRemoval::kWhole,
                            const std::atomic<bool>* stop = nullptr);

// Part of the map in which both differ, when it is small against the map: a stroke of a brush or
// its undoing. Nothing where all of it has to be made anew.
std::optional<PixelBounds> SmallChange(const ReliefMaps& before, const ReliefMaps& after);

// The relief after such a change. Noise is removed only where the change reaches, so that a step
// near it may be judged by a shorter piece of its line (relief_smoothing.h).
DrawnRelief WithChange(const DrawnRelief& relief, const glm::ivec2& panorama_size,
                       const ReliefMaps& after, const Backdrop& backdrop,
                       const PixelBounds& changed, const std::atomic<bool>* stop = nullptr);
// The same at once: heights change by as much as those of the map did, low-passed, and the noise of
// the change stays.
DrawnRelief WithShift(const DrawnRelief& relief, const glm::ivec2& panorama_size,
                      const ReliefMaps& before, const ReliefMaps& after, const Backdrop& backdrop,
                      const PixelBounds& changed);

}  // namespace arthro::app
