#include "app/steps/tissue/landmark_mode.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "app/state/edits.h"
#include "app/steps/tissue/import_frames.h"
#include "app/steps/tissue/tissue_step.h"
#include "simulation/core/units.h"

namespace arthro::app {
namespace {

LandmarkMode& ModeOf(EditorState& state) { return state.steps.tissue->landmarks; }
const LandmarkMode& ModeOf(const EditorState& state) { return state.steps.tissue->landmarks; }

const Tissue* ChosenTissue(const EditorState& state) {
  const auto& tissues = state.document().scene.tissues;
  return state.tissue >= 0 && state.tissue < static_cast<int>(tissues.size())
             ? &tissues[static_cast<std::size_t>(state.tissue)]
             : nullptr;
}

void SolveAnew(EditorState& state) {
  LandmarkMode& mode = ModeOf(state);
  const Tissue* tissue = ChosenTissue(state);
  if (tissue == nullptr) return;
  authoring::LandmarkOptions options;
  options.scale = mode.solves_scale ? authoring::AlignScale::kSolve : authoring::AlignScale::kKeep;
  const auto& surface = state.document().surfaces.at(static_cast<std::size_t>(state.tissue));
  mode.alignment = authoring::AlignLandmarks(mode.pairs, tissue->pose, OrEmpty(surface), options);
}

// Makes a pair of both halves once they are there.
void Complete(EditorState& state) {
  LandmarkMode& mode = ModeOf(state);
  if (mode.model && mode.scene) {
    authoring::LandmarkPair& pair = mode.pairs.emplace_back();
    pair.x_in_tissue = *mode.model;
    pair.scene = *mode.scene;
    mode.model.reset();
    mode.scene.reset();
    mode.chosen = static_cast<int>(mode.pairs.size()) - 1;
    SolveAnew(state);
  }
  state.message = LandmarkPrompt(state);
}

// Puts the present pairs aside and takes up those of another tissue.
void TakeLandmarksOf(LandmarkMode& mode, const std::string& tissue) {
  std::vector<KeptLandmarks> kept = std::move(mode.kept);
  if (!mode.pairs.empty()) kept.push_back({mode.tissue, std::move(mode.pairs), mode.solves_scale});
  mode = {};
  mode.tissue = tissue;
  const auto own = std::find_if(kept.begin(), kept.end(),
                                [&](const KeptLandmarks& one) { return one.tissue == tissue; });
  if (own != kept.end()) {
    mode.pairs = std::move(own->pairs);
    mode.solves_scale = own->solves_scale;
    kept.erase(own);
  }
  mode.kept = std::move(kept);
}

}  // namespace

bool PlacesLandmarks(const EditorState& state) {
  const LandmarkMode& mode = ModeOf(state);
  const Tissue* tissue = ChosenTissue(state);
  return mode.is_on && !state.practice && state.step == Step::kTissue &&
         state.steps.tissue->page == TissuePage::kPlace && tissue != nullptr &&
         tissue->name == mode.tissue;
}

void ToggleLandmarks(EditorState& state) {
  if (PlacesLandmarks(state)) return LeaveLandmarks(state);
  const Tissue* tissue = ChosenTissue(state);
  if (tissue == nullptr) return;
  LandmarkMode& mode = ModeOf(state);
  if (mode.tissue != tissue->name) TakeLandmarksOf(mode, tissue->name);
  mode.is_on = true;
  state.steps.tissue->page = TissuePage::kPlace;
  SolveAnew(state);
  state.message = LandmarkPrompt(state);
}

void LeaveLandmarks(EditorState& state) {
  LandmarkMode& mode = ModeOf(state);
  mode.is_on = false;
  mode.model.reset();
  mode.scene.reset();
  state.message = "The landmarks of " + mode.tissue + " are kept.";
}

void TakeModelPoint(EditorState& state, int tissue, const glm::dvec3& x_in_tissue) {
  if (!PlacesLandmarks(state)) return;
  if (tissue != state.tissue) {
    state.message = fmt::format("Another tissue was clicked; click on {}.", ModeOf(state).tissue);
    return;
  }
  ModeOf(state).model = x_in_tissue;
  Complete(state);
}

void TakeScenePoint(EditorState& state, const authoring::Sight& sight) {
  if (!PlacesLandmarks(state)) return;
  const auto point = authoring::PointOnRelief(state.document(), sight);
  if (!point) {
    state.message = authoring::kNothingImaged;
    return;
  }
  ModeOf(state).scene = *point;
  Complete(state);
}

void ChooseLandmark(EditorState& state, int pair) { ModeOf(state).chosen = pair; }

bool HasChosenLandmark(const EditorState& state) {
  const LandmarkMode& mode = ModeOf(state);
  return PlacesLandmarks(state) && mode.chosen >= 0 &&
         mode.chosen < static_cast<int>(mode.pairs.size());
}

void RemoveChosenLandmark(EditorState& state) {
  if (!HasChosenLandmark(state)) return;
  LandmarkMode& mode = ModeOf(state);
  mode.pairs.erase(mode.pairs.begin() + mode.chosen);
  if (mode.chosen >= static_cast<int>(mode.pairs.size())) --mode.chosen;
  SolveAnew(state);
  state.message = LandmarkPrompt(state);
}

void RemoveAllLandmarks(EditorState& state) {
  LandmarkMode& mode = ModeOf(state);
  mode.pairs.clear();
  mode.model.reset();
  mode.scene.reset();
  mode.chosen = -1;
  SolveAnew(state);
  state.message = LandmarkPrompt(state);
}

void LeaveOutLandmark(EditorState& state, int pair, bool is_left_out) {
  LandmarkMode& mode = ModeOf(state);
  if (pair < 0 || pair >= static_cast<int>(mode.pairs.size())) return;
  mode.pairs[static_cast<std::size_t>(pair)].is_left_out = is_left_out;
  SolveAnew(state);
}

void SolveForScale(EditorState& state, bool solves_scale) {
  ModeOf(state).solves_scale = solves_scale;
  SolveAnew(state);
}

void AlignByLandmarks(EditorState& state) {
  LandmarkMode& mode = ModeOf(state);
  SolveAnew(state);  // the scale that is kept may have changed
  if (!PlacesLandmarks(state) || !mode.alignment.is_aligned()) return;
  const std::string name = ChosenTissue(state)->name;
  NoteBefore(state);
  PlaceTissue(state, state.tissue, mode.alignment.portal_from_tissue, "Align");
  EndDrag(state);
  state.message =
      fmt::format("Aligned {} to {:.2f} mm rms.", name, MmFromMetres(mode.alignment.rms));
}

std::string LandmarkPrompt(const EditorState& state) {
  const LandmarkMode& mode = ModeOf(state);
  if (mode.model)
    return "Now click its place in the scope's picture, or on the relief in the overview.";
  if (mode.scene)
    return fmt::format("Now click the same point of {} in the overview.", mode.tissue);
  return fmt::format("Click a point of {} in the overview, or its place in the scope's picture.",
                     mode.tissue);
}

}  // namespace arthro::app
