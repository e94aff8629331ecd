#include "app/editor/render_scale.h"

#include <algorithm>
#include <cmath>

namespace arthro::app {
namespace {

constexpr std::array kScales{1.0, 0.9, 0.8, 0.7, 0.6, 0.5};
// Coarser where a frame takes so much longer than it may, and finer only where that would surely
// leave some room: between the two nothing changes.
constexpr double kTooLong = 1.15, kRoom = 0.9;

int Last() { return static_cast<int>(kScales.size()) - 1; }
double ScaleOf(int step) { return kScales[static_cast<std::size_t>(step)]; }

}  // namespace

double RenderScale::value() const { return ScaleOf(step_); }

void RenderScale::Note(double seconds) {
  if (!(seconds > 0.0) || !std::isfinite(seconds)) return;
  seconds_[noted_++ % kFrames] = seconds;
  if (noted_ < kFrames) return;
  std::array<double, kFrames> sorted = seconds_;
  std::sort(sorted.begin(), sorted.end());
  const double usual = sorted[kFrames / 2];
  const int before = step_;
  if (usual > kTooLong * kFrameTime) {
    // Assumes a time proportional to the number of pixels; otherwise one more step follows.
    while (step_ < Last() &&
           usual * std::pow(ScaleOf(step_) / ScaleOf(before), 2) > kTooLong * kFrameTime)
      ++step_;
  } else {
    // The same bound is from above for a finer picture, so it will not be too slow again.
    while (step_ > 0 &&
           usual * std::pow(ScaleOf(step_ - 1) / ScaleOf(before), 2) < kRoom * kFrameTime)
      --step_;
  }
  if (step_ != before) noted_ = 0;
}

}  // namespace arthro::app
