#include "app/editor/marks/brush_marks.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <imgui.h>

#include "app/editor/marks/model_marks.h"
#include "app/platform/theme.h"
#include "app/steps/depth/depth_step.h"

namespace arthro::app {
namespace {

constexpr unsigned kStroke = 0xC0F0C850;
constexpr unsigned kTouch = 0xFF60E8F8;  // yellow
constexpr unsigned kProbe = 0xFFD8D8D8;  // steel

bool HasMarks(const EditorState& state) { return PaintsDepth(state) || TouchesRelief(state); }

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

// Ring, normal and probe of the touch preview.
void MarkTouch(const Ui& ui, const TouchReading& touch, const glm::dvec3& portal,
               const ToWindow& to_window) {
  constexpr double kRing = 1.5e-3, kArrow = 6e-3, kHead = 1.5e-3, kRod = 15e-3;  // m
  const bool feels = touch.tip_force > 0;
  const glm::dvec3 normal = feels ? touch.normal : -glm::normalize(touch.point);
  const glm::dvec3 other = std::abs(normal.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
  const glm::dvec3 first = glm::normalize(glm::cross(normal, other)),
                   second = glm::cross(normal, first);
  using Path = std::vector<std::optional<glm::dvec3>>;
  // Points along the rod, since the scope's lens bends a line.
  constexpr int kParts = 24;
  Path rod, ring, arrow;
  const double length = std::min(kRod, glm::distance(portal, touch.point));
  const glm::dvec3 back = glm::normalize(portal - touch.point);
  for (int i = 0; i <= kParts; ++i) {
    const double share = static_cast<double>(i) / kParts, a = 2 * std::numbers::pi * share;
    rod.emplace_back(touch.point + share * length * back);
    ring.emplace_back(touch.point + kRing * (std::cos(a) * first + std::sin(a) * second));
    arrow.emplace_back(touch.point + share * kArrow * normal);
  }
  const glm::dvec3 end = touch.point + kArrow * normal, neck = end - kHead * normal;
  const Path head{neck + 0.6 * kHead * first, end, neck - 0.6 * kHead * first};
  const unsigned colour = feels ? kTouch : kQuiet;
  Line(rod, to_window, kMarkShadow, ui.Px(7));
  Line(rod, to_window, kProbe, ui.Px(4));
  Line(ring, to_window, kMarkShadow, ui.Px(4));
  Line(ring, to_window, colour, ui.Px(2));
  if (!feels) return;
  for (const auto& [shade, width] : {std::pair(kMarkShadow, 4.5), std::pair(colour, 2.2)}) {
    Line(arrow, to_window, shade, ui.Px(width));
    Line(head, to_window, shade, ui.Px(width));
  }
}

void Mark(const Ui& ui, const EditorState& state, const Area& area, const ToWindow& to_window) {
  if (TouchesRelief(state)) {
    const TouchPreview& touch = state.steps.depth->touch;
    const glm::dvec3 portal(state.document().scene.portals.incision_spacing, 0, 0);
    ImGui::GetWindowDrawList()->PushClipRect({area.x, area.y},
                                             {area.x + area.width, area.y + area.height}, true);
    if (touch.reading) MarkTouch(ui, *touch.reading, portal, to_window);
    ImGui::GetWindowDrawList()->PopClipRect();
    return;
  }
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
  if (!HasMarks(state)) return;
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
  if (!HasMarks(state)) return;
  const FixedWindow same(ui, "overview", window, kPictureWindow);
  Mark(ui, state, window, [&](const glm::dvec3& x) -> std::optional<glm::dvec2> {
    const auto pixel = pixel_of(x);
    if (!pixel) return std::nullopt;
    return *pixel + glm::dvec2(window.x + 0.5, window.y + 0.5);
  });
}

}  // namespace arthro::app
