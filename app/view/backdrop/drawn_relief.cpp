#include "app/view/backdrop/drawn_relief.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "simulation/core/units.h"
#include "simulation/haptics/relief/relief_smoothing.h"
#include "simulation/scene/backdrop/relief_shares.h"

namespace arthro::app {
namespace {

// Further smoothing of the slopes for the lamp, over that which the noise asks for: a glint shows a
// third of the slope that a hand feels.
constexpr double kLampBlur = 2;

// Least height of a step that is drawn with a side, over the median standard error of the relief:
// five standard deviations of the difference of two texels, as outlines have (relief_outlines.cpp).
constexpr double kSideOfError = 5 * std::numbers::sqrt2;

// Median smoothing that the noise of a depth map asks for, as a standard deviation in its pixels at
// the radius of the backdrop; 0 where none is known [method.md, Backdrop force].
double SmoothingPx(double error, const Backdrop& backdrop) {
  const simulation::NoiseLimits limits;
  const double smoothing =
      std::min(limits.widest, error / (2 * std::numbers::sqrt2 * limits.slope));
  const Projection& projection = backdrop.projection;
  const double px_per_rad = projection.type == ProjectionType::kEquirectangular
                                ? DegreesFromRadians(projection.px_per_deg)
                                : projection.focal_px;
  return smoothing * px_per_rad / backdrop.radius;
}

}  // namespace

DrawnRelief MakeDrawnRelief(const glm::ivec2& panorama_size, const DepthMap& depth,
                            const DepthMap& sigma, const Backdrop& backdrop, ReliefNoise noise) {
  DrawnRelief drawn;
  drawn.is_noisy = !sigma.empty() && !depth.empty();
  const bool wraps = IsWholeTurn(backdrop.projection, panorama_size.x);
  const bool removes = drawn.is_noisy && noise == ReliefNoise::kRemoved;
  const DepthMap quiet = removes ? simulation::WithoutNoise(depth, sigma, backdrop) : DepthMap();
  const double error = drawn.is_noisy ? SharesOf(depth, sigma, {}).median_sigma.value_or(0.0) : 0.0;
  drawn.texture = MakeReliefTexture(panorama_size, removes ? quiet : depth, wraps, sigma);
  drawn.ceiling = MakeReliefCeiling(drawn.texture, wraps);
  if (backdrop.relight > 0 || drawn.is_noisy)
    drawn.slopes = MakeBroadSlopes(
        drawn.texture, wraps,
        kLampBlur * SmoothingPx(error, backdrop) * drawn.texture.width / std::max(depth.width, 1));
  if (drawn.is_noisy) drawn.least_side = kSideOfError * error;
  return drawn;
}

}  // namespace arthro::app
