#include "app/files/step_pictures.h"

#include "app/steps/depth/depth_step.h"
#include "authoring/footage/resized_picture.h"

namespace arthro::app {
namespace {

constexpr std::size_t kMostPictures = 400;  // pictures; 11 MB

}  // namespace

bool WantsStepPicture(const EditorState& state) {
  return !state.dragging && !state.practice && !state.practice_only && state.document().panorama &&
         !DepthIsUnderWay(state) && !state.step_pictures.contains(state.history.StateId());
}

void KeepStepPicture(EditorState& state, const ColourImage& seen) {
  if (seen.empty()) return;
  // Ids grow, so the first ones are the oldest.
  if (state.step_pictures.size() >= kMostPictures)
    state.step_pictures.erase(state.step_pictures.begin());
  state.step_pictures[state.history.StateId()] =
      Share(authoring::Resized(seen, kStepPictureSide, kStepPictureSide));
}

std::shared_ptr<const ColourImage> StepPicture(const EditorState& state, int step) {
  const auto found = state.step_pictures.find(state.history.IdOf(step));
  return found == state.step_pictures.end() ? nullptr : found->second;
}

}  // namespace arthro::app
