#include "app/editor/marks/conflict_marks.h"

#include <utility>

#include <glm/geometric.hpp>
#include <imgui.h>

#include "app/platform/theme.h"
#include "app/steps/portals/portals_step.h"

namespace arthro::app {
namespace {

bool ShowsConflicts(const EditorState& state) {
  return state.step == Step::kPortals && !state.practice && !state.practice_only;
}

// A cross in a ring.
void ConflictMark(const Ui& ui, const glm::dvec2& place) {
  const ImVec2 at{static_cast<float>(place.x), static_cast<float>(place.y)};
  ImDrawList* draw = ImGui::GetWindowDrawList();
  const float ring = ui.Px(10), arm = ui.Px(5);
  for (const auto& [colour, width] : {std::pair(kMarkShadow, 4.5), std::pair(kBad, 2.2)}) {
    draw->AddCircle(at, ring, colour, 32, ui.Px(width));
    draw->AddLine({at.x - arm, at.y - arm}, {at.x + arm, at.y + arm}, colour, ui.Px(width));
    draw->AddLine({at.x - arm, at.y + arm}, {at.x + arm, at.y - arm}, colour, ui.Px(width));
  }
}

}  // namespace

void MarkConflictsInScope(Ui& ui, EditorState& state, const Area& window, const Area& picture,
                          const simulation::ScopeView& view,
                          const simulation::ScopeOptics& optics) {
  if (!ShowsConflicts(state)) return;
  const FixedWindow same(ui, "picture", window, kPictureWindow);
  const double radius = 0.5 * picture.width;
  for (const ShaftFinding& conflict : FindShaftConflicts(state)) {
    const glm::dvec2 place = simulation::PlaceOf(optics, view, conflict.x_in_portal - view.tip);
    if (glm::length(place) <= 1.0)
      ConflictMark(ui,
                   {picture.x + radius + radius * place.x, picture.y + radius - radius * place.y});
  }
}

void MarkConflictsInOverview(
    Ui& ui, EditorState& state, const Area& window,
    const std::function<std::optional<glm::dvec2>(const glm::dvec3&)>& pixel_of) {
  if (!ShowsConflicts(state)) return;
  const FixedWindow same(ui, "overview", window, kPictureWindow);
  ImGui::GetWindowDrawList()->PushClipRect(
      {window.x, window.y}, {window.x + window.width, window.y + window.height}, true);
  for (const ShaftFinding& conflict : FindShaftConflicts(state))
    if (const auto pixel = pixel_of(conflict.x_in_portal))
      ConflictMark(ui, *pixel + glm::dvec2(window.x + 0.5, window.y + 0.5));
  ImGui::GetWindowDrawList()->PopClipRect();
}

}  // namespace arthro::app
