#include "app/steps/tissue/tissue_balls.h"

#include <glm/gtc/quaternion.hpp>

#include "app/state/chosen_tissue.h"
#include "app/state/edits.h"

namespace arthro::app {
namespace {

std::vector<Ball>& BallsOf(Tissue& tissue, BallKind kind) {
  return kind == BallKind::kHeld ? tissue.fixed : tissue.probed;
}

// Names of the steps of the history.
struct Names {
  const char *add, *remove, *remove_all;
};
Names NamesOf(BallKind kind) {
  if (kind == BallKind::kHeld) return {"Hold", "Release a place of", "Release"};
  return {"Probe", "Take a probed place from", "Take the probed places from"};
}

// Null where none is chosen.
glm::dvec3 InTissue(const Pose& pose, const glm::dvec3& x_in_portal) {
  return (glm::conjugate(pose.quaternion) * (x_in_portal - pose.position)) / pose.scale;
}

}  // namespace

const std::vector<Ball>& BallsOf(const Tissue& tissue, BallKind kind) {
  return kind == BallKind::kHeld ? tissue.fixed : tissue.probed;
}

void AddBall(EditorState& state, BallKind kind, int tissue, const glm::dvec3& x_in_tissue) {
  Tissue changed = state.document().scene.tissues.at(static_cast<std::size_t>(tissue));
  std::vector<Ball>& balls = BallsOf(changed, kind);
  balls.push_back({x_in_tissue, state.steps.tissue->ball_radius / changed.pose.scale});
  const int added = static_cast<int>(balls.size()) - 1;
  SetTissue(state, tissue, changed, NamesOf(kind).add);
  EndDrag(state);  // each is a step of its own
  state.tissue = tissue;
  state.steps.tissue->ball = added;
}

void AddBallAtInstrument(EditorState& state, BallKind kind) {
  const Tissue* tissue = ChosenTissue(state);
  if (!tissue) return;
  const glm::dvec3 portal(state.document().scene.portals.incision_spacing, 0, 0);
  AddBall(state, kind, state.tissue,
          InTissue(tissue->pose, portal + simulation::TipInOwnPortal(state.instrument)));
}

void SetBall(EditorState& state, BallKind kind, int tissue, int index, const Ball& ball,
             const std::string& what) {
  Tissue changed = state.document().scene.tissues.at(static_cast<std::size_t>(tissue));
  BallsOf(changed, kind).at(static_cast<std::size_t>(index)) = ball;
  SetTissue(state, tissue, changed, what);
}

bool HasChosenBall(const EditorState& state, BallKind kind) {
  const Tissue* tissue = ChosenTissue(state);
  return tissue && state.steps.tissue->ball >= 0 &&
         state.steps.tissue->ball < static_cast<int>(BallsOf(*tissue, kind).size());
}

bool HasBalls(const EditorState& state, BallKind kind) {
  const Tissue* tissue = ChosenTissue(state);
  return tissue && !BallsOf(*tissue, kind).empty();
}

void RemoveChosenBall(EditorState& state, BallKind kind) {
  if (!HasChosenBall(state, kind)) return;
  Tissue changed = *ChosenTissue(state);
  std::vector<Ball>& balls = BallsOf(changed, kind);
  balls.erase(balls.begin() + state.steps.tissue->ball);
  const int left = static_cast<int>(balls.size());
  SetTissue(state, state.tissue, changed, NamesOf(kind).remove);
  EndDrag(state);
  if (state.steps.tissue->ball >= left) --state.steps.tissue->ball;
}

void RemoveAllBalls(EditorState& state, BallKind kind) {
  if (!HasBalls(state, kind)) return;
  Tissue changed = *ChosenTissue(state);
  BallsOf(changed, kind).clear();
  SetTissue(state, state.tissue, changed, NamesOf(kind).remove_all);
  EndDrag(state);
  state.steps.tissue->ball = -1;
}

std::optional<BallKind> BallKindOf(TissuePage page) {
  if (page == TissuePage::kHold) return BallKind::kHeld;
  if (page == TissuePage::kMesh) return BallKind::kProbed;
  return std::nullopt;
}

}  // namespace arthro::app
