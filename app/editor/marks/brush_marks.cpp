#include "app/editor/marks/brush_marks.h"

#include <vector>

#include <glm/geometric.hpp>
#include <imgui.h>

#include "app/platform/theme.h"
#include "app/steps/depth/depth_step.h"

namespace arthro::app {
namespace {

using ToWindow = std::function<std::optional<glm::dvec2>(const glm::dvec3& x_in_portal)>;

constexpr unsigned kStroke = 0xC0F0C850;

// A line through the places that the picture shows.
void Line(const std::vector<std::optional<glm::dvec3>>& places, const ToWindow& to_window,
          unsigned colour, float width) {
  ImDrawList* draw = ImGui::GetWindowDrawList();
  std::optional<glm::dvec2> last;
  for (const auto& place : places) {
    const std::optional<glm::dvec2> at = place ? to_window(*place) : std::nullopt;
    if (last && at)
      draw->AddLine({static_cast<float>(last->x), static_cast<float>(last->y)},
                    {static_cast<float>(at->x), static_cast<float>(at->y)}, colour, width);
    last = at;
  }
}

void Mark(const Ui& ui, const EditorState& state, const Area& area, const ToWindow& to_window) {
  const DepthBrush& brush = state.steps.depth->board.brush;
  ImGui::GetWindowDrawList()->PushClipRect({area.x, area.y},
                                           {area.x + area.width, area.y + area.height}, true);
  const authoring::ReliefView view = ReliefViewOf(state.document());
  std::vector<std::optional<glm::dvec3>> stroke;
  for (const glm::dvec2& point : brush.stroke.points) {
    const glm::dvec2 pixel = point * static_cast<double>(view.relief.width) - 0.5;
    stroke.emplace_back(authoring::ReadRelief(view, pixel).point);
  }
  Line(stroke, to_window, kStroke, ui.Px(3));
  const auto ring = RingOnRelief(state, 1.0), core = RingOnRelief(state, brush.stroke.hardness);
  Line(ring, to_window, kMarkShadow, ui.Px(3));
  Line(ring, to_window, kBright, ui.Px(1.5));
  Line(core, to_window, 0x90FFFFFF, ui.Px(1));
  ImGui::GetWindowDrawList()->PopClipRect();
}

}  // namespace

void MarkBrushInScope(Ui& ui, const EditorState& state, const Area& window, const Area& picture,
                      const simulation::ScopeView& view, const simulation::ScopeOptics& optics) {
  if (!PaintsDepth(state)) return;
  const FixedWindow same(ui, "picture", window, kPictureWindow);
  const double radius = 0.5 * picture.width;
  Mark(ui, state, picture, [&](const glm::dvec3& x) -> std::optional<glm::dvec2> {
    const glm::dvec2 place = simulation::PlaceOf(optics, view, x - view.tip);
    if (!(glm::length(place) <= 1.0)) return std::nullopt;
    return glm::dvec2(picture.x + radius + radius * place.x, picture.y + radius - radius * place.y);
  });
}

void MarkBrushInOverview(
    Ui& ui, const EditorState& state, const Area& window,
    const std::function<std::optional<glm::dvec2>(const glm::dvec3&)>& pixel_of) {
  if (!PaintsDepth(state)) return;
  const FixedWindow same(ui, "overview", window, kPictureWindow);
  Mark(ui, state, window, [&](const glm::dvec3& x) -> std::optional<glm::dvec2> {
    const auto pixel = pixel_of(x);
    if (!pixel) return std::nullopt;
    return *pixel + glm::dvec2(window.x + 0.5, window.y + 0.5);
  });
}

}  // namespace arthro::app
