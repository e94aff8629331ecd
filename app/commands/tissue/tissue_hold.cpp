#include "app/commands/tissue/tissue_hold.h"

#include <glm/gtc/quaternion.hpp>

#include "app/commands/edits.h"

namespace arthro::app {
namespace {

// Null where none is chosen.
const Tissue* ChosenTissue(const EditorState& state) {
  const auto& tissues = state.document().scene.tissues;
  return state.tissue >= 0 && state.tissue < static_cast<int>(tissues.size())
             ? &tissues[static_cast<std::size_t>(state.tissue)]
             : nullptr;
}

glm::dvec3 InTissue(const Pose& pose, const glm::dvec3& x_in_portal) {
  return (glm::conjugate(pose.quaternion) * (x_in_portal - pose.position)) / pose.scale;
}

}  // namespace

void HoldAt(EditorState& state, int tissue, const glm::dvec3& x_in_tissue) {
  Tissue changed = state.document().scene.tissues.at(static_cast<std::size_t>(tissue));
  changed.fixed.push_back({x_in_tissue, state.hold_radius / changed.pose.scale});
  const int added = static_cast<int>(changed.fixed.size()) - 1;
  SetTissue(state, tissue, changed, "Hold");
  EndDrag(state);  // each is a step of its own
  state.tissue = tissue;
  state.ball = added;
}

void HoldAtInstrument(EditorState& state) {
  const Tissue* tissue = ChosenTissue(state);
  if (!tissue) return;
  const glm::dvec3 portal(state.document().scene.portals.incision_spacing, 0, 0);
  HoldAt(state, state.tissue,
         InTissue(tissue->pose, portal + simulation::TipInOwnPortal(state.instrument)));
}

void SetBall(EditorState& state, int tissue, int index, const Ball& ball, const std::string& what) {
  Tissue changed = state.document().scene.tissues.at(static_cast<std::size_t>(tissue));
  changed.fixed.at(static_cast<std::size_t>(index)) = ball;
  SetTissue(state, tissue, changed, what);
}

bool HasChosenBall(const EditorState& state) {
  const Tissue* tissue = ChosenTissue(state);
  return tissue && state.ball >= 0 && state.ball < static_cast<int>(tissue->fixed.size());
}

void ReleaseChosenBall(EditorState& state) {
  if (!HasChosenBall(state)) return;
  Tissue changed = *ChosenTissue(state);
  changed.fixed.erase(changed.fixed.begin() + state.ball);
  SetTissue(state, state.tissue, changed, "Release a place of");
  EndDrag(state);
  if (state.ball >= static_cast<int>(changed.fixed.size())) --state.ball;
}

void ReleaseAll(EditorState& state) {
  const Tissue* tissue = ChosenTissue(state);
  if (!tissue || tissue->fixed.empty()) return;
  Tissue changed = *tissue;
  changed.fixed.clear();
  SetTissue(state, state.tissue, changed, "Release");
  EndDrag(state);
  state.ball = -1;
}

}  // namespace arthro::app
