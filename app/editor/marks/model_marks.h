// The chosen tissue drawn over a picture, to judge its place: its outline, lines of equal distance
// from the relief, and the whole of it over a picture that does not show it. Portal frame, m; areas
// in window coordinates, px. Each function draws into the current ImGui window, clipped to `area`.
#pragma once

#include <functional>
#include <optional>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <imgui.h>

#include "app/panels/fixed_window.h"
#include "app/panels/widgets.h"
#include "app/state/editor_state.h"

namespace arthro::app {

// Window coordinates of a place; nothing for one that the picture cannot show.
using ToWindow = std::function<std::optional<glm::dvec2>(const glm::dvec3& x_in_portal)>;

inline constexpr unsigned kModelColour = 0xFF4DB8F2;  // amber

inline ImVec2 Corner(const glm::dvec2& x) {
  return {static_cast<float>(x.x), static_cast<float>(x.y)};
}

class MarkClip {
 public:
  explicit MarkClip(const Area& area) {
    ImGui::GetWindowDrawList()->PushClipRect({area.x, area.y},
                                             {area.x + area.width, area.y + area.height}, true);
  }
  ~MarkClip() { ImGui::GetWindowDrawList()->PopClipRect(); }
  MarkClip(const MarkClip&) = delete;
  MarkClip& operator=(const MarkClip&) = delete;
};

// Silhouette as seen from `eye`.
void DrawOutline(const Ui& ui, const EditorState& state, const Area& area, const glm::dvec3& eye,
                 const ToWindow& to_window);
// Contours of the part of the surface that faces `eye`, while they are shown.
void DrawContours(const Ui& ui, EditorState& state, const Area& area, const glm::dvec3& eye,
                  const ToWindow& to_window);
// The part that faces `eye`, lit from there, with the opacity `share` of 0 to 1.
void FillModel(const EditorState& state, const Area& area, const glm::dvec3& eye,
               const ToWindow& to_window, double share);

}  // namespace arthro::app
