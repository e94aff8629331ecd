#include "app/steps/tissue/landmark_mode.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "app/state/chosen_tissue.h"
#include "app/state/edits.h"
#include "app/steps/tissue/import_frames.h"
#include "app/steps/tissue/tissue_step.h"
#include "authoring/alignment/placing_notes.h"
#include "authoring/project/estimated_depth.h"
#include "simulation/core/units.h"

namespace arthro::app {
namespace {

LandmarkMode& ModeOf(EditorState& state) { return state.steps.tissue->landmarks; }
const LandmarkMode& ModeOf(const EditorState& state) { return state.steps.tissue->landmarks; }

// Pairs of the chosen tissue as the document has them.
authoring::TissueLandmarks KeptOf(const EditorState& state) {
  const std::string& name = ChosenTissue(state)->name;
  const authoring::PlacingNotes notes = authoring::NotesOf(state.document().scene);
  const auto* kept = authoring::LandmarksOf(notes, name);
  return kept != nullptr ? *kept : authoring::TissueLandmarks{name, ModeOf(state).solves_scale, {}};
}

// Text that the notes were read from; empty where there are none.
std::string NotesTextOf(const Scene& scene) {
  const auto text = scene.extensions.find(authoring::kPlacingKey);
  return text == scene.extensions.end() ? "" : text->second;
}

void TakeAnew(EditorState& state) {
  LandmarkMode& mode = ModeOf(state);
  const Tissue* tissue = ChosenTissue(state);
  if (tissue == nullptr) return;
  const authoring::Document& document = state.document();
  mode.notes = NotesTextOf(document.scene);
  mode.depth = document.depth;
  mode.surface = document.surfaces.at(static_cast<std::size_t>(state.tissue));
  mode.pose = tissue->pose;
  const authoring::TissueLandmarks kept = KeptOf(state);
  mode.pairs = authoring::OnRelief(kept.pairs, document, authoring::UnstatedOrigin(document));
  mode.solves_scale = kept.solves_scale;
  mode.chosen = std::min(mode.chosen, static_cast<int>(mode.pairs.size()) - 1);
  authoring::LandmarkOptions options;
  options.scale = mode.solves_scale ? authoring::AlignScale::kSolve : authoring::AlignScale::kKeep;
  mode.alignment =
      authoring::AlignLandmarks(mode.pairs, tissue->pose, OrEmpty(mode.surface), options);
}

// One step of the history; `change` gets a copy of the pairs.
template <class Change>
void ChangePairs(EditorState& state, const std::string& what, const Change& change) {
  authoring::TissueLandmarks kept = KeptOf(state);
  change(kept);
  if (kept != KeptOf(state))
    Edit(state, what + " " + kept.tissue, "", [&](authoring::Document& next) {
      authoring::PlacingNotes notes = authoring::NotesOf(next.scene);
      authoring::Put(notes, kept);
      authoring::PutNotes(next.scene, notes);
    });
  TakeAnew(state);
}

// Makes a pair of both halves once they are there.
void Complete(EditorState& state) {
  LandmarkMode& mode = ModeOf(state);
  if (mode.model && mode.scene) {
    ChangePairs(state, "Add a landmark of", [&](authoring::TissueLandmarks& kept) {
      authoring::LandmarkPair& pair = kept.pairs.emplace_back();
      pair.x_in_tissue = *mode.model;
      pair.scene = *mode.scene;
    });
    mode.model.reset();
    mode.scene.reset();
    mode.chosen = static_cast<int>(mode.pairs.size()) - 1;
  }
  state.message = LandmarkPrompt(state);
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
  if (mode.tissue != tissue->name) {
    mode = {};
    mode.tissue = tissue->name;
  }
  mode.is_on = true;
  state.steps.tissue->page = TissuePage::kPlace;
  TakeAnew(state);
  state.message = LandmarkPrompt(state);
}

void LeaveLandmarks(EditorState& state) {
  LandmarkMode& mode = ModeOf(state);
  mode.is_on = false;
  mode.model.reset();
  mode.scene.reset();
  state.message = "The landmarks of " + mode.tissue + " are kept with the scene.";
}

void KeepLandmarksFresh(EditorState& state) {
  if (!PlacesLandmarks(state)) return;
  const LandmarkMode& mode = ModeOf(state);
  const authoring::Document& document = state.document();
  if (mode.notes != NotesTextOf(document.scene) || mode.depth != document.depth ||
      mode.surface != document.surfaces.at(static_cast<std::size_t>(state.tissue)) ||
      !(mode.pose == ChosenTissue(state)->pose))
    TakeAnew(state);
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
  const auto point = authoring::PointOnRelief(state.document(), sight,
                                              authoring::UnstatedOrigin(state.document()));
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
  ChangePairs(state, "Remove a landmark of", [&](authoring::TissueLandmarks& kept) {
    kept.pairs.erase(kept.pairs.begin() + ModeOf(state).chosen);
  });
  state.message = LandmarkPrompt(state);
}

void RemoveAllLandmarks(EditorState& state) {
  LandmarkMode& mode = ModeOf(state);
  mode.model.reset();
  mode.scene.reset();
  ChangePairs(state, "Remove the landmarks of",
              [](authoring::TissueLandmarks& kept) { kept.pairs.clear(); });
  state.message = LandmarkPrompt(state);
}

void LeaveOutLandmark(EditorState& state, int pair, bool is_left_out) {
  if (pair < 0 || pair >= static_cast<int>(ModeOf(state).pairs.size())) return;
  ChangePairs(state, is_left_out ? "Leave out a landmark of" : "Take a landmark of",
              [&](authoring::TissueLandmarks& kept) {
                kept.pairs[static_cast<std::size_t>(pair)].is_left_out = is_left_out;
              });
}

void SolveForScale(EditorState& state, bool solves_scale) {
  ModeOf(state).solves_scale = solves_scale;
  ChangePairs(state, solves_scale ? "Solve for the scale of" : "Keep the scale of",
              [&](authoring::TissueLandmarks& kept) { kept.solves_scale = solves_scale; });
}

void AlignByLandmarks(EditorState& state) {
  LandmarkMode& mode = ModeOf(state);
  KeepLandmarksFresh(state);  // the scale that is kept may have changed
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
