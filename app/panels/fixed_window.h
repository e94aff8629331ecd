// An ImGui window without frame or title that fills an area and cannot be moved.
#pragma once

#include <imgui.h>

#include "app/panels/widgets.h"

namespace arthro::app {

// In window coordinates, px.
struct Area {
  float x = 0, y = 0, width = 0, height = 0;
};
inline constexpr ImGuiWindowFlags kPageWindow =
    ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
    ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings |
    ImGuiWindowFlags_NoBringToFrontOnFocus;
inline constexpr ImGuiWindowFlags kBarWindow =
    kPageWindow | ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse;
// Keys that move the hands do not walk through its widgets.
inline constexpr ImGuiWindowFlags kPictureWindow =
    kBarWindow | ImGuiWindowFlags_NoNavInputs | ImGuiWindowFlags_NoNavFocus;

// Over other pictures.
inline constexpr ImGuiWindowFlags kInsetWindow =
    kPictureWindow & ~ImGuiWindowFlags_NoBringToFrontOnFocus;

class FixedWindow {
 public:
  FixedWindow(Ui& ui, const char* name, const Area& area, ImGuiWindowFlags flags) {
    ImGui::SetNextWindowPos({area.x, area.y});
    ImGui::SetNextWindowSize({area.width, area.height});
    const bool bar = flags == kBarWindow, picture = (flags & kInsetWindow) == kInsetWindow;
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0.0f);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 0.0f);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding,
                        picture ? ImVec2(0, 0) : ImVec2(ui.Px(12), ui.Px(bar ? 8 : 10)));
    ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1, 1});
    if (bar) ImGui::PushStyleColor(ImGuiCol_WindowBg, ImGui::GetStyleColorVec4(ImGuiCol_PopupBg));
    ImGui::Begin(name, nullptr, flags);
    if (bar) ImGui::PopStyleColor();
    ImGui::PopStyleVar(4);
  }
  ~FixedWindow() { ImGui::End(); }
  FixedWindow(const FixedWindow&) = delete;
  FixedWindow& operator=(const FixedWindow&) = delete;
};

}  // namespace arthro::app
