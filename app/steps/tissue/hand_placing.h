// Placing the chosen tissue by hand on the Place page: steps along and about axes, dragging on the
// relief, its mirror image, the fit of its surface to the relief, and how well it lies there. m,
// rad, portal frame.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/state/editor_state.h"
#include "authoring/alignment/distance_colours.h"
#include "authoring/alignment/place_by_hand.h"
#include "authoring/alignment/relief_distance.h"
#include "authoring/alignment/scene_point.h"

namespace arthro::app {

struct Ui;

// Contours of kContourLevels, in the tissue's own frame.
using DistanceLines = std::vector<std::vector<authoring::ContourSegment>>;

struct HandPlacing {
  authoring::NudgeAxes axes = authoring::NudgeAxes::kPortal;
  double step = 1e-3;            // m
  double turn = 0.08726646;      // rad, 5 degrees
  bool snaps = false;            // drags on the handle go by whole steps
  bool shows_outline = false;    // the tissue is an outline in the scope's picture
  bool shows_distances = false;  // its distances from the relief are colours in the overview
  bool shows_contours = false;   // and lines in the scope's picture and the panorama
  bool shows_before = false;     // the tissue is shown where the last fit or alignment found it
  double fade = 0;               // share by which it is faded out of the scope's picture
  std::optional<Pose> before;    // pose to compare with
  // Part of the surface that is fitted to the relief, in the tissue's own frame; none: one side.
  std::optional<Ball> patch;
  double patch_radius = 5e-3;  // m of the joint, of the next one
  bool picks_patch = false;    // a click on the tissue puts the patch there
  std::string patch_tissue;    // name of the one that `patch` is on
  bool lays = false;           // a drag over a picture lays the tissue onto the relief
  std::string tissue;          // name of the one that is laid
  std::string before_tissue;   // name of the one that `before` is about
  // Relief and fit of the chosen tissue, kept while nothing of them changes.
  struct Kept {
    std::shared_ptr<const DepthMap> depth;
    std::shared_ptr<const ColourImage> panorama;
    Backdrop backdrop;
    authoring::ReliefTarget relief;
    SharedSurface surface;
    Pose pose;
    authoring::ReliefFit fit;
    // Colours of its vertices; null until they are asked for.
    std::shared_ptr<const std::vector<glm::dvec3>> colours;
    std::shared_ptr<const DistanceLines> contours;  // null until they are asked for
  } kept;
};

// Fit of the chosen tissue to the relief; while a drag goes on, that of its beginning.
const authoring::ReliefFit& FitOfChosen(EditorState& state);
// "0.12 mm from the relief, 91 % of its front within 1 mm": how well it lies there.
std::string FitWords(const authoring::ReliefFit& fit);
// A front that lies behind the relief, which a wrong place or what hides it explains; empty where
// little of it does.
std::string IntersectionWords(const authoring::ReliefFit& fit);

// One step of the history each.
void Nudge(EditorState& state, int axis, double sign);
void NudgeTurn(EditorState& state, int axis, double sign);
void MirrorTissue(EditorState& state);  // its tetrahedra are to be made anew
// Refines the pose until the surface, or its patch, lies on the relief.
void FitToRelief(EditorState& state);
// Patch of the chosen tissue; nothing where there is none.
std::optional<Ball> PatchOf(const EditorState& state);
// True while clicks on the chosen tissue put its patch there.
bool PicksPatch(const EditorState& state);
void TogglePatch(EditorState& state);
void TakePatch(EditorState& state, int tissue, const glm::dvec3& x_in_tissue);
void RemovePatch(EditorState& state);

// Colours of the distances of the chosen tissue from the relief; null where they are not shown.
std::shared_ptr<const std::vector<glm::dvec3>> ShownDistances(EditorState& state);

// Contours of the distances of the chosen tissue from the relief; null where they are not shown.
std::shared_ptr<const DistanceLines> ShownContours(EditorState& state);

// Colour of a contour for ImGui: amber on the relief, blue in front of it, red behind it; the
// nearer, the brighter.
constexpr unsigned ColourOfContour(double level) {
  if (level == 0) return 0xFF40D0FF;
  const double mm = (level < 0 ? -level : level) * 1e3;
  const auto pale = static_cast<unsigned>(mm < 0.75 ? 0xC0 : mm < 1.5 ? 0x70 : 0x20);
  return level > 0 ? 0xFF000000 | 0xFFu << 16 | pale << 8 | pale / 2
                   : 0xFF000000 | pale << 16 | pale / 2 << 8 | 0xFFu;
}

// Keeps the present pose of the chosen tissue, to compare with.
void NoteBefore(EditorState& state);
bool HasBefore(const EditorState& state);
// The pose from before while it is shown.
std::optional<Pose> ShownBefore(const EditorState& state);
// Share by which the chosen tissue is faded out of the scope's picture; 0: not at all.
double FadeOf(const EditorState& state);

// True while the place of the chosen tissue is judged: the Place page is open.
bool JudgesPlace(const EditorState& state);

// True while the chosen tissue is an outline in the scope's picture.
bool IsOutlined(const EditorState& state);

// True while drags over the pictures lay the chosen tissue onto the relief.
bool LaysOnRelief(const EditorState& state);
void ToggleLaying(EditorState& state);
void LayTissue(EditorState& state, const authoring::Sight& sight);

void FitFields(Ui& ui, EditorState& state);   // judging, fitting and laying
void StepFields(Ui& ui, EditorState& state);  // sizes of steps, and the mirror

}  // namespace arthro::app
