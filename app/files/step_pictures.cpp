#include "app/files/step_pictures.h"

#include <algorithm>

#include <opencv2/imgproc.hpp>

#include "app/steps/depth/depth_step.h"

namespace arthro::app {
namespace {

constexpr std::size_t kMostKept = 400;  // pictures; 11 MB

}  // namespace

bool WantsStepPicture(const EditorState& state) {
  return !state.dragging && !state.practice && !state.practice_only && state.document().panorama &&
         !DepthIsUnderWay(state) && !state.step_pictures.contains(state.history.StateId());
}

void KeepStepPicture(EditorState& state, const ColourImage& seen) {
  if (seen.empty()) return;
  const cv::Mat whole(seen.height, seen.width, CV_8UC3, const_cast<std::uint8_t*>(seen.rgb.data()));
  auto small = std::make_shared<ColourImage>(kStepPictureSide, kStepPictureSide);
  cv::Mat target(small->height, small->width, CV_8UC3, small->rgb.data());
  cv::resize(whole, target, target.size(), 0, 0, cv::INTER_AREA);
  // Ids grow, so the first ones are the oldest.
  if (state.step_pictures.size() >= kMostKept)
    state.step_pictures.erase(state.step_pictures.begin());
  state.step_pictures[state.history.StateId()] = std::move(small);
}

std::shared_ptr<const ColourImage> StepPicture(const EditorState& state, int step) {
  const auto found = state.step_pictures.find(state.history.IdOf(step));
  return found == state.step_pictures.end() ? nullptr : found->second;
}

}  // namespace arthro::app
