#include "app/steps/tissue/hand_placing.h"

#include <fmt/format.h>

#include "app/state/edits.h"
#include "app/steps/tissue/import_frames.h"
#include "app/steps/tissue/tissue_step.h"
#include "authoring/alignment/distance_colours.h"
#include "authoring/alignment/placing_notes.h"
#include "authoring/alignment/surface_alignment.h"
#include "simulation/core/units.h"
#include "simulation/scene/solids/solid_io.h"

namespace arthro::app {
namespace fs = std::filesystem;
namespace {

// Share of the front behind the relief that is worth a word: less is a horn
// behind a bone, or the noise of a relief.
constexpr double kWorthSaying = 0.1;

const Tissue& PlacedTissue(const EditorState& state) {
  return state.document().scene.tissues.at(static_cast<std::size_t>(state.tissue));
}

const SurfaceMesh& PlacedSurface(const EditorState& state) {
  return OrEmpty(state.document().surfaces.at(static_cast<std::size_t>(state.tissue)));
}

void SetPose(EditorState& state, const Pose& pose, const std::string& what) {
  PlaceTissue(state, state.tissue, pose, what);
}

// True while the Place page of a tissue is open.
bool IsPlacePage(const EditorState& state) {
  return !state.practice && state.step == Step::kTissue &&
         state.steps.tissue->page == TissuePage::kPlace && state.tissue >= 0 &&
         state.tissue < static_cast<int>(state.document().scene.tissues.size());
}

const authoring::ReliefTarget& ReliefOf(EditorState& state) {
  HandPlacing::Kept& kept = state.steps.tissue->placing.kept;
  const authoring::Document& document = state.document();
  if (kept.depth != document.depth || kept.panorama != document.panorama ||
      !(kept.backdrop == document.scene.backdrop)) {
    kept = {};
    kept.depth = document.depth;
    kept.panorama = document.panorama;
    kept.backdrop = document.scene.backdrop;
    kept.relief = authoring::MakeReliefTarget(document);
  }
  return kept.relief;
}

}  // namespace

const authoring::ReliefFit& FitOfChosen(EditorState& state) {
  const authoring::ReliefTarget& relief = ReliefOf(state);
  HandPlacing::Kept& kept = state.steps.tissue->placing.kept;
  const SharedSurface& surface =
      state.document().surfaces.at(static_cast<std::size_t>(state.tissue));
  const Pose& pose = PlacedTissue(state).pose;
  if (kept.surface == surface && (kept.pose == pose || state.dragging)) return kept.fit;
  kept.surface = surface;
  kept.pose = pose;
  kept.fit = authoring::FitOf(relief, OrEmpty(surface), pose);
  kept.colours = nullptr;
  kept.contours = nullptr;
  return kept.fit;
}

std::shared_ptr<const std::vector<glm::dvec3>> ShownDistances(EditorState& state) {
  HandPlacing& placing = state.steps.tissue->placing;
  if (!IsPlacePage(state) || !placing.shows_distances) return nullptr;
  FitOfChosen(state);  // brings what is kept up to date
  HandPlacing::Kept& kept = placing.kept;
  if (!kept.colours)
    kept.colours = std::make_shared<const std::vector<glm::dvec3>>(
        authoring::DistanceColours(kept.relief, OrEmpty(kept.surface), kept.pose));
  return kept.colours;
}

std::shared_ptr<const DistanceLines> ShownContours(EditorState& state) {
  HandPlacing& placing = state.steps.tissue->placing;
  if (!IsPlacePage(state) || !placing.shows_contours) return nullptr;
  FitOfChosen(state);  // brings what is kept up to date
  HandPlacing::Kept& kept = placing.kept;
  if (!kept.contours)
    kept.contours = std::make_shared<const DistanceLines>(
        authoring::DistanceContours(kept.relief, OrEmpty(kept.surface), kept.pose));
  return kept.contours;
}

void NoteBefore(EditorState& state) {
  HandPlacing& placing = state.steps.tissue->placing;
  placing.before = PlacedTissue(state).pose;
  placing.before_tissue = PlacedTissue(state).name;
  placing.shows_before = false;
}

bool HasBefore(const EditorState& state) {
  const HandPlacing& placing = state.steps.tissue->placing;
  return IsPlacePage(state) && placing.before && placing.before_tissue == PlacedTissue(state).name;
}

std::optional<Pose> ShownBefore(const EditorState& state) {
  const HandPlacing& placing = state.steps.tissue->placing;
  return placing.shows_before && HasBefore(state) ? placing.before : std::nullopt;
}

double FadeOf(const EditorState& state) {
  return IsPlacePage(state) ? state.steps.tissue->placing.fade : 0;
}

std::string FitWords(const authoring::ReliefFit& fit) {
  if (!fit.is_known) return "It is nowhere near the relief.";
  return fmt::format("{:.2f} mm from the relief (median); {:.0f} % of its front within 1 mm.",
                     MmFromMetres(fit.median), 100 * fit.within);
}

std::string IntersectionWords(const authoring::ReliefFit& fit) {
  if (!fit.is_known || fit.behind < kWorthSaying) return "";
  return fmt::format("{:.0f} % of its front lies behind the relief, up to {:.1f} mm deep.",
                     100 * fit.behind, MmFromMetres(fit.deepest));
}

void Nudge(EditorState& state, int axis, double sign) {
  const HandPlacing& placing = state.steps.tissue->placing;
  SetPose(state,
          authoring::Shifted(PlacedTissue(state).pose, axis, sign * placing.step, placing.axes),
          "Move");
  EndDrag(state);
}

void NudgeTurn(EditorState& state, int axis, double sign) {
  const HandPlacing& placing = state.steps.tissue->placing;
  SetPose(state,
          authoring::Turned(PlacedTissue(state).pose, axis, sign * placing.turn, placing.axes,
                            authoring::MiddleOf(PlacedSurface(state))),
          "Turn");
  EndDrag(state);
}

void MirrorTissue(EditorState& state) {
  const SurfaceMesh& surface = PlacedSurface(state);
  const double at = authoring::MiddleOf(surface).x;
  Tissue changed = authoring::Mirrored(PlacedTissue(state), at);
  const bool had_mesh = !changed.mesh.empty();
  changed.mesh.clear();
  const auto index = static_cast<std::size_t>(state.tissue);
  const auto mirrored = Share(authoring::Mirrored(surface, at));
  // A solid is its function, which is mirrored into a file of its own.
  std::optional<fs::path> function;
  if (IsSolidFile(changed.surface)) {
    function = state.scratch.NewFile(changed.surface.filename());
    WriteSolid(*function,
               authoring::Mirrored(ReadSolid(FileOf(state.document(), changed.surface)), at));
    changed.surface = fs::path("tissues") / function->filename();
  }
  Edit(state, "Mirror " + changed.name, "", [&](authoring::Document& next) {
    next.surfaces[index] = mirrored;
    next.scene.tissues[index] = changed;
    authoring::MirrorInNotes(next.scene, changed.name, at);
    if (function) next.files[changed.surface.generic_string()] = {*function, mirrored, {}};
  });
  if (had_mesh) state.message += "; make its tetrahedra anew.";
}

void FitToRelief(EditorState& state) {
  const authoring::SurfaceAlignment found = authoring::AlignSurface(
      ReliefOf(state), PlacedSurface(state), PlacedTissue(state).pose, PatchOf(state));
  if (found.is_aligned) {
    NoteBefore(state);
    SetPose(state, found.portal_from_tissue, "Fit");
    EndDrag(state);
  }
  state.message = found.sentence;
}

std::optional<Ball> PatchOf(const EditorState& state) {
  const HandPlacing& placing = state.steps.tissue->placing;
  if (!IsPlacePage(state) || !placing.patch || placing.patch_tissue != PlacedTissue(state).name)
    return std::nullopt;
  return placing.patch;
}

bool PicksPatch(const EditorState& state) {
  const HandPlacing& placing = state.steps.tissue->placing;
  return placing.picks_patch && IsPlacePage(state) && !PlacesLandmarks(state);
}

void TogglePatch(EditorState& state) {
  HandPlacing& placing = state.steps.tissue->placing;
  placing.picks_patch = !PicksPatch(state);
  placing.lays = false;
  state.message =
      placing.picks_patch
          ? "Click on the part of the tissue that is to lie on the relief; Esc ends this."
          : "Drags turn and move the views again.";
}

void TakePatch(EditorState& state, int tissue, const glm::dvec3& x_in_tissue) {
  if (!PicksPatch(state)) return;
  if (tissue != state.tissue) {
    state.message =
        fmt::format("Another tissue was clicked; click on {}.", PlacedTissue(state).name);
    return;
  }
  HandPlacing& placing = state.steps.tissue->placing;
  placing.patch = Ball{x_in_tissue, placing.patch_radius / PlacedTissue(state).pose.scale};
  placing.patch_tissue = PlacedTissue(state).name;
  placing.picks_patch = false;
  state.message = "Fit to the relief takes this part now.";
}

void RemovePatch(EditorState& state) {
  state.steps.tissue->placing.patch.reset();
  state.message = "Fit to the relief takes the whole side again.";
}

bool JudgesPlace(const EditorState& state) { return IsPlacePage(state); }

bool IsOutlined(const EditorState& state) {
  if (PlacesLandmarks(state)) return state.steps.tissue->landmarks.shows_outline;
  return IsPlacePage(state) && state.steps.tissue->placing.shows_outline;
}

bool LaysOnRelief(const EditorState& state) {
  const HandPlacing& placing = state.steps.tissue->placing;
  return placing.lays && IsPlacePage(state) && PlacedTissue(state).name == placing.tissue &&
         !PlacesLandmarks(state);
}

void ToggleLaying(EditorState& state) {
  HandPlacing& placing = state.steps.tissue->placing;
  placing.lays = !LaysOnRelief(state);
  placing.picks_patch = false;
  placing.tissue = PlacedTissue(state).name;
  if (placing.lays) NoteBefore(state);
  state.message =
      placing.lays ? "Drag over the scope's picture, the panorama or the overview to lay it there."
                   : "Drags turn and move the views again.";
}

void LayTissue(EditorState& state, const authoring::Sight& sight) {
  if (!LaysOnRelief(state)) return;
  const auto point = authoring::PointOnRelief(state.document(), sight);
  if (!point) {
    state.message = authoring::kNothingImaged;
    return;
  }
  state.dragging = true;
  SetPose(state,
          authoring::LaidOnRelief(ReliefOf(state), PlacedSurface(state), PlacedTissue(state).pose,
                                  point->x_in_portal),
          "Lay");
}

}  // namespace arthro::app
