#include "app/view/backdrop/drawn_relief.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <thread>

#include "app/view/backdrop/rough_relief.h"
#include "simulation/core/units.h"
#include "simulation/haptics/relief/relief_smoothing.h"
#include "simulation/scene/backdrop/relief_shares.h"

namespace arthro::app {
namespace {

// Further smoothing of the slopes for the lamp, over that which the noise asks for: a glint shows a
// third of the slope that a hand feels.
constexpr double kLampBlur = 2;

// Least height of a step that is drawn with a side, over the median standard error of the samples:
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

// `made.sampled` as textures. `after`: the maps; of the depth only the unknown part counts.
void MakeTextures(const glm::ivec2& panorama_size, const ReliefMaps& after,
                  const Backdrop& backdrop, DrawnRelief& made) {
  const auto& [depth, sigma] = after;
  made.is_noisy = !sigma.empty() && !depth.empty();
  const bool wraps = IsWholeTurn(backdrop.projection, panorama_size.x);
  const DepthMap sampled_sigma = SampledRelief(sigma);
  double error = 0;
  {
    const std::jthread other([&] {
      if (made.is_noisy)
        error = SharesOf(made.sampled, sampled_sigma, {}).median_sigma.value_or(0.0);
    });
    made.texture = MakeReliefTexture(panorama_size, depth, made.sampled, wraps, sampled_sigma);
    made.ceiling = MakeReliefCeiling(made.texture, wraps);
  }
  if (backdrop.relight > 0 || made.is_noisy)
    made.slopes = MakeBroadSlopes(
        made.texture, wraps,
        kLampBlur * SmoothingPx(error, backdrop) * made.texture.width / std::max(depth.width, 1));
  made.least_side = made.is_noisy ? kSideOfError * error : 0.0;
}

}  // namespace

DrawnRelief MakeDrawnRelief(const glm::ivec2& panorama_size, const DepthMap& depth,
                            const DepthMap& sigma, const Backdrop& backdrop, NoiseRemoval removal,
                            const std::atomic<bool>* stop) {
  DrawnRelief made;
  if (sigma.empty() || depth.empty())
    made.sampled = SampledRelief(depth);
  else if (removal == NoiseRemoval::kRough)
    made.sampled = RoughRelief(depth, sigma, backdrop);
  else
    made.sampled = SampledRelief(simulation::WithoutNoise(depth, sigma, backdrop, stop));
  MakeTextures(panorama_size, {depth, sigma}, backdrop, made);
  return made;
}

std::optional<PixelBounds> SmallChange(const ReliefMaps& before, const ReliefMaps& after) {
  constexpr double kLargePart = 0.25;  // share of the map
  const auto differ = [](const DepthMap& a, const DepthMap& b) {
    return a.width != b.width || a.height != b.height;
  };
  if (differ(before.depth, after.depth) || differ(before.sigma, after.sigma)) return std::nullopt;
  const PixelBounds changed =
      Joined(DifferenceOf(before.depth, after.depth), DifferenceOf(before.sigma, after.sigma));
  const double area = static_cast<double>(changed.width()) * changed.height();
  if (area > kLargePart * after.depth.width * after.depth.height) return std::nullopt;
  return changed;
}

DrawnRelief WithChange(const DrawnRelief& relief, const glm::ivec2& panorama_size,
                       const ReliefMaps& after, const Backdrop& backdrop,
                       const PixelBounds& changed, const std::atomic<bool>* stop) {
  DrawnRelief made;
  made.sampled = relief.sampled;
  const simulation::QuietPart quiet =
      simulation::WithoutNoiseAround(after.depth, after.sigma, backdrop, changed, stop);
  PutSampled(quiet.relief, quiet.box, {after.depth.width, after.depth.height}, made.sampled);
  MakeTextures(panorama_size, after, backdrop, made);
  return made;
}

DrawnRelief WithShift(const DrawnRelief& relief, const glm::ivec2& panorama_size,
                      const ReliefMaps& before, const ReliefMaps& after, const Backdrop& backdrop,
                      const PixelBounds& changed) {
  DrawnRelief made;
  made.sampled = relief.sampled;
  ShiftSampled(before.depth, after.depth, changed, made.sampled);
  MakeTextures(panorama_size, after, backdrop, made);
  return made;
}

}  // namespace arthro::app
