#include "app/editor/pictures/render_scale.h"

#include <algorithm>
#include <cmath>

namespace arthro::app {
namespace {

// The cost of a frame as a share of the whole: that of the features, measured by `bench view`,
// times the number of pixels.
struct RenderStep {
  double scale;
  CameraFeatures features;
  double cost;
};
constexpr double kFewest = 0.795;  // cost with the exposure alone
constexpr RenderStep Coarser(double scale) {
  return {scale, CameraFeatures::kExposure, kFewest * scale * scale};
}
constexpr std::array kSteps{RenderStep{1.0, CameraFeatures::kOcclusion, 1.0},
                            RenderStep{1.0, CameraFeatures::kEdges, 0.875},
                            RenderStep{1.0, CameraFeatures::kFringe, 0.84},
                            RenderStep{1.0, CameraFeatures::kSharpness, 0.805},
                            RenderStep{1.0, CameraFeatures::kGrain, 0.80},
                            RenderStep{1.0, CameraFeatures::kExposure, kFewest},
                            Coarser(0.9),
                            Coarser(0.8),
                            Coarser(0.7),
                            Coarser(0.6),
                            Coarser(0.5)};
// Coarser where a frame takes so much longer than it may, and finer only where that would surely
// leave some room: between the two nothing changes.
constexpr double kTooLong = 1.15, kRoom = 0.9;

int Last() { return static_cast<int>(kSteps.size()) - 1; }
const RenderStep& StepOf(int step) { return kSteps[static_cast<std::size_t>(step)]; }

}  // namespace

double RenderScale::value() const { return StepOf(step_).scale; }
CameraFeatures RenderScale::features() const { return StepOf(step_).features; }

void RenderScale::Note(double seconds) {
  if (!(seconds > 0.0) || !std::isfinite(seconds)) return;
  seconds_[noted_++ % kFrames] = seconds;
  if (noted_ < kFrames) return;
  std::array<double, kFrames> sorted = seconds_;
  std::sort(sorted.begin(), sorted.end());
  const double usual = sorted[kFrames / 2];
  const int before = step_;
  if (usual > kTooLong * kFrameTime) {
    // Assumes a time proportional to the step's cost; otherwise one more step follows.
    while (step_ < Last() &&
           usual * StepOf(step_).cost / StepOf(before).cost > kTooLong * kFrameTime)
      ++step_;
  } else {
    // The same bound is from above for a finer picture, so it will not be too slow again.
    while (step_ > 0 && usual * StepOf(step_ - 1).cost / StepOf(before).cost < kRoom * kFrameTime)
      --step_;
  }
  if (step_ != before) noted_ = 0;
}

}  // namespace arthro::app
