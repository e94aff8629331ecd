// Landmarks that an author pairs by clicks: a point of the chosen tissue's model and its place in
// the scene, in either order. The pairs are kept with the scene, each change of them as a step of
// the history, and every change solves for the pose anew; only *Align* moves the tissue. m; model
// points in the tissue's own frame, scene points in the portal
// frame.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/state/editor_state.h"
#include "authoring/alignment/landmark_alignment.h"

namespace arthro::app {

struct Ui;

struct LandmarkMode {
  bool is_on = false;
  std::string tissue;  // whose landmarks these are
  // Those of the document, where their clicks meet its relief (KeepLandmarksFresh).
  std::vector<authoring::LandmarkPair> pairs;
  // The half of a pair that was clicked first.
  std::optional<glm::dvec3> model;
  std::optional<authoring::ScenePoint> scene;
  int chosen = -1;  // index of a pair, -1 none
  bool solves_scale = false;
  bool shows_outline = true;  // the tissue is an outline in the scope's picture
  authoring::LandmarkAlignment alignment;
  // Source of pairs and alignment.
  std::string notes;
  std::shared_ptr<const DepthMap> depth;
  SharedSurface surface;
  Pose pose;
};

// True while clicks place landmarks of the chosen tissue.
bool PlacesLandmarks(const EditorState& state);
// Takes pairs and alignment from the document where it has changed, as by an undone step.
void KeepLandmarksFresh(EditorState& state);
void ToggleLandmarks(EditorState& state);
void LeaveLandmarks(EditorState& state);

// Takes a click on a model; one on another tissue than the chosen one is refused in words.
void TakeModelPoint(EditorState& state, int tissue, const glm::dvec3& x_in_tissue);
// Takes a click into the scene along a line of sight; a hole in the relief is refused in words.
void TakeScenePoint(EditorState& state, const authoring::Sight& sight);

void ChooseLandmark(EditorState& state, int pair);
bool HasChosenLandmark(const EditorState& state);
void RemoveChosenLandmark(EditorState& state);
void RemoveAllLandmarks(EditorState& state);
void LeaveOutLandmark(EditorState& state, int pair, bool is_left_out);
void SolveForScale(EditorState& state, bool solves_scale);
// Lays the tissue where the pairs put it.
void AlignByLandmarks(EditorState& state);

// Next action of the author, one sentence.
std::string LandmarkPrompt(const EditorState& state);

// The list of pairs with their residuals, and the buttons.
void LandmarkFields(Ui& ui, EditorState& state);

}  // namespace arthro::app
