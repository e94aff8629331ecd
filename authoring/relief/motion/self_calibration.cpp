#include "authoring/relief/motion/self_calibration.h"

#include <algorithm>
#include <cmath>

#include "authoring/relief/motion/growth.h"

namespace arthro::authoring {

FocalFit FitFocal(const std::vector<Track>& tracks, const Lens& lens, const Motion& motion,
                  const std::atomic<bool>* stop) {
  FocalFit fit;
  fit.scene = motion.scene;
  fit.rms_before_px = motion.rms_px;
  const LensProfile profile(lens);
  for (int round = 0; round < 2; ++round)
    fit.rms_px =
        AdjustBundle(tracks, profile, {.iterations = 25, .stop = stop, .focal = &fit.factor},
                     fit.scene, nullptr);
  // How fast the residuals grow beside the minimum gives the standard error.
  constexpr double kAside = 0.01;
  int observations = 0;
  for (const TrackPoint& point : fit.scene.points)
    observations += static_cast<int>(std::count(point.uses.begin(), point.uses.end(), true));
  Reconstruction aside = fit.scene;
  const LensProfile moved(WithFocal(lens, fit.factor * (1 + kAside)));
  const double rms = AdjustBundle(tracks, moved, {.iterations = 12, .stop = stop}, aside, nullptr);
  const double rise = std::max(1e-12, rms * rms - fit.rms_px * fit.rms_px);
  fit.sigma = std::min(1.0, kAside * fit.rms_px / std::sqrt(2 * std::max(1, observations) * rise));
  return fit;
}

Lens WithFocal(const Lens& lens, double factor) {
  Lens changed = lens;
  changed.focal_px *= factor;
  return changed;
}

void ChangeLens(const Lens& lens, std::vector<Track>& tracks) {
  for (Track& track : tracks)
    std::erase_if(track.seen, [&](Observation& seen) {
      const auto ray = RayFromPixel(lens, {seen.pixel.x(), seen.pixel.y()});
      if (ray) seen.ray = {ray->x, ray->y, ray->z};
      return !ray;
    });
}

}  // namespace arthro::authoring
