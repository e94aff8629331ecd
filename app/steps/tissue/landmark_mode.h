// Landmarks that an author pairs by clicks: a point of the chosen tissue's model and its place in
// the scene, in either order. Every change solves for the pose anew; only *Align* moves the tissue,
// as one step of the history. m; model points in the tissue's own frame, scene points in the portal
// frame.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/state/editor_state.h"
#include "authoring/alignment/landmark_alignment.h"

namespace arthro::app {

struct Ui;

// Pairs of a tissue whose landmarks are not at hand.
struct KeptLandmarks {
  std::string tissue;
  std::vector<authoring::LandmarkPair> pairs;
  bool solves_scale = false;
};

struct LandmarkMode {
  bool is_on = false;
  std::string tissue;  // whose landmarks these are
  std::vector<authoring::LandmarkPair> pairs;
  // The half of a pair that was clicked first.
  std::optional<glm::dvec3> model;
  std::optional<authoring::ScenePoint> scene;
  int chosen = -1;  // index of a pair, -1 none
  bool solves_scale = false;
  bool shows_outline = true;  // the tissue is an outline in the scope's picture
  authoring::LandmarkAlignment alignment;
  std::vector<KeptLandmarks> kept;  // pairs of the other tissues
};

// True while clicks place landmarks of the chosen tissue.
bool PlacesLandmarks(const EditorState& state);
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
