// The scope's picture and the author's overview: they show a texture and say what the user did over
// it.
#include <algorithm>
#include <cmath>

#include <imgui.h>

#include "app/editor/panels/panels.h"
#include "app/panels/fixed_window.h"
#include "app/state/command.h"
#include "app/state/edits.h"
#include "app/steps/practice/hand_motion.h"
#include "simulation/core/units.h"

namespace arthro::app {
namespace {

constexpr float kStripHeight = 66;  // px at scale 1, of the pose's numbers

// A texture as it is: VTK leaves alpha below 1 where translucent things were.
void OpaqueImage(ImDrawList* draw, unsigned texture, const ImVec2& low, const ImVec2& high) {
  draw->AddImage(reinterpret_cast<ImTextureID>(static_cast<std::intptr_t>(texture)), low, high,
                 {0, 1}, {1, 0});
}

// The left button was let go over the last item where it had been pressed.
bool WasClicked() {
  constexpr float kSlack = 4;  // px
  const ImGuiIO& io = ImGui::GetIO();
  return ImGui::IsItemDeactivated() && ImGui::IsItemHovered() && ImGui::IsMouseReleased(0) &&
         io.MouseDragMaxDistanceSqr[0] <= kSlack * kSlack;
}

// The edge of the square picture in its area.
float PictureEdge(const Ui& ui, bool practice, const Area& area) {
  const float strip = practice ? 0 : ui.Px(kStripHeight);
  return std::floor(
      std::max(16.0f, std::min(area.width - ui.Px(16), area.height - strip - ui.Px(16))));
}

// Insertion, swing and roll of the author's scope as numbers that can be typed.
void PoseStrip(Ui& ui, EditorState& state, const ImVec2& corner, float total_width) {
  const float width = (total_width - 3 * ui.Px(8)) / 4;
  double mm = MmFromMetres(state.scope.depth), latitude = DegreesFromRadians(state.scope.latitude),
         longitude = DegreesFromRadians(state.scope.longitude),
         roll = DegreesFromRadians(state.scope.roll);
  const auto limits = simulation::ScopeLimits(state.document().scene);
  const double most_latitude = DegreesFromRadians(limits.max_latitude),
               most_longitude = DegreesFromRadians(limits.max_longitude);
  struct Field {
    const char* name;
    double* value;
    double step, low, high;
    const char* format;
  };
  const Field fields[] = {{"Insertion", &mm, 0.1, MmFromMetres(limits.min_depth),
                           MmFromMetres(limits.max_depth), "%.1f mm"},
                          {"Latitude", &latitude, 0.2, -most_latitude, most_latitude, "%.1f°"},
                          {"Longitude", &longitude, 0.2, -most_longitude, most_longitude, "%.1f°"},
                          {"Roll", &roll, 0.5, -720, 720, "%.1f°"}};
  bool changed = false;
  float x = corner.x;
  for (const Field& field : fields) {
    ImGui::SetCursorScreenPos({x, corner.y});
    QuietText(ui, field.name);
    ImGui::SetCursorScreenPos({x, corner.y + ImGui::GetTextLineHeight() + ui.Px(4)});
    ImGui::SetNextItemWidth(width);
    changed = NumberField(ui, field.name, *field.value, field.step, field.low, field.high,
                          field.format, "How the scope is held. Drag, or double-click to type.")
                  .changed ||
              changed;
    x += width + ui.Px(8);
  }
  if (changed)
    state.scope = {RadiansFromDegrees(latitude), RadiansFromDegrees(longitude),
                   RadiansFromDegrees(roll), MetresFromMm(mm)};
}

// The overview's picture and what is done to it, in the window that was begun.
OverviewInput Overview(Ui& ui, const Area& area, unsigned texture) {
  OverviewInput input;
  ImGui::SetCursorScreenPos({area.x, area.y});
  HitArea("Overview", {area.width, area.height},
          ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight |
              ImGuiButtonFlags_MouseButtonMiddle);
  RecordItem(ui, "Overview", true, "", WidgetKind::kPicture);
  const ImGuiIO& io = ImGui::GetIO();
  input.hovered = ImGui::IsItemHovered();
  input.owned = ImGui::IsItemActive();
  input.pointer = {io.MousePos.x - area.x, io.MousePos.y - area.y};
  for (int button = 0; button < 3; ++button) {
    input.pressed[button] = ImGui::IsItemHovered() && ImGui::IsMouseClicked(button);
    input.released[button] = ImGui::IsMouseReleased(button) && ImGui::IsItemDeactivated();
  }
  if (input.hovered) input.wheel = io.MouseWheel;
  input.clicked = WasClicked();
  input.shift = io.KeyShift;
  input.ctrl = io.KeyCtrl;
  if (texture != 0)
    OpaqueImage(ImGui::GetWindowDrawList(), texture, {area.x, area.y},
                {area.x + area.width, area.y + area.height});
  ImGui::SetCursorScreenPos({area.x + ui.Px(12), area.y + ui.Px(8)});
  QuietText(ui, "Overview");
  return input;
}

}  // namespace

int ScopePictureSize(const Ui& ui, const EditorState& state, const Area& area) {
  return static_cast<int>(PictureEdge(ui, state.practice.has_value(), area));
}

PictureInput ScopePicture(Ui& ui, EditorState& state, const Area& area, unsigned texture) {
  const FixedWindow window(ui, "picture", area, kPictureWindow);
  const bool practice = state.practice.has_value();
  const float edge = PictureEdge(ui, practice, area);
  const float strip = practice ? 0 : ui.Px(kStripHeight);
  const ImVec2 low = {std::floor(area.x + 0.5f * (area.width - edge)),
                      std::floor(area.y + std::max(0.5f * (area.height - strip - edge), 0.0f))};
  ImDrawList* draw = ImGui::GetWindowDrawList();
  draw->AddRectFilled({area.x, area.y}, {area.x + area.width, area.y + area.height}, 0xFF000000);
  PictureInput input;
  ImGui::SetCursorScreenPos(low);
  HitArea("Picture", {edge, edge},
          ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight);
  RecordItem(ui, "Picture", true, "", WidgetKind::kPicture);
  input.hovered = ImGui::IsItemHovered();
  input.focused = ImGui::IsWindowFocused();
  input.area = {low.x, low.y, edge, edge};
  const ImGuiIO& io = ImGui::GetIO();
  const glm::dvec2 pointer(io.MousePos.x - low.x - 0.5, io.MousePos.y - low.y - 0.5);
  if (WasClicked()) input.clicked = pointer;
  if (ImGui::IsItemActive() && io.MouseDown[0]) input.held = pointer;
  input.released = ImGui::IsItemDeactivated();
  // The way to the place of the press is no drag.
  if (ImGui::IsItemActive() && !ImGui::IsItemActivated()) {
    const glm::dvec2 drag = {io.MouseDelta.x / edge, io.MouseDelta.y / edge};
    if (io.MouseDown[0]) input.scope_drag = drag;
    if (io.MouseDown[1]) input.instrument_drag = drag;
  }
  if (input.hovered) input.wheel = io.MouseWheel;
  input.shift = io.KeyShift;
  input.ctrl = io.KeyCtrl;
  if (texture != 0) {
    OpaqueImage(draw, texture, low, {low.x + edge, low.y + edge});
  } else {
    const char* words = "Drop a panorama, a video or a scene here";
    ui.widgets.RecordText(words);
    const ImVec2 size = ImGui::CalcTextSize(words);
    draw->AddText({low.x + 0.5f * (edge - size.x), low.y + 0.5f * (edge - size.y)}, kQuiet, words);
  }
  if (!practice) {
    PoseStrip(ui, state, {area.x + ui.Px(12), area.y + area.height - strip + ui.Px(2)},
              area.width - ui.Px(24));
  }
  return input;
}

OverviewInput OverviewPicture(Ui& ui, const Area& area, unsigned texture) {
  const FixedWindow window(ui, "overview", area, kPictureWindow);
  return Overview(ui, area, texture);
}

OverviewInput InsetOverview(Ui& ui, const Area& area, unsigned texture) {
  const FixedWindow window(ui, "inset overview", area, kInsetWindow);
  const OverviewInput input = Overview(ui, area, texture);
  ImGui::GetWindowDrawList()->AddRect({area.x, area.y}, {area.x + area.width, area.y + area.height},
                                      kQuiet);
  return input;
}

bool ApplyPictureInput(EditorState& state, const PictureInput& input,
                       const simulation::ScopeView& view, double field_of_view) {
  const auto& scope = state.practice ? state.practice->scope().pose() : state.scope;
  const auto& instrument = state.practice ? state.practice->instrument().pose() : state.instrument;
  simulation::RodPose of_scope, of_instrument;
  of_scope = MotionOfDrag(scope, view, field_of_view, input.scope_drag.x, input.scope_drag.y);
  of_instrument = MotionOfDrag(instrument, view, field_of_view, input.instrument_drag.x,
                               input.instrument_drag.y);
  simulation::RodPose& turned = input.ctrl ? of_instrument : of_scope;
  if (input.shift)
    turned.roll += kRollANotch * input.wheel;
  else
    turned.depth += kInsertionANotch * input.wheel;
  return MoveHands(state, of_scope, of_instrument);
}

bool ApplyHeldKeys(EditorState& state, bool picture_has_focus, double seconds) {
  const ImGuiIO& io = ImGui::GetIO();
  if (io.WantTextInput || io.KeyCtrl || io.KeyAlt) return false;
  const auto held = [&](int key) { return io.KeysDown[key]; };
  if (state.practice) state.practice->Press(held(kActKey));
  state.steps.practice->hands->HoldDeadMan(held(kDeadManKey));
  const bool is_turned = TurnHead(state, HeadTurnOfKeys(seconds, held));
  return MoveHands(state, MotionOfKeys(false, picture_has_focus, seconds, held),
                   MotionOfKeys(true, picture_has_focus, seconds, held)) ||
         is_turned;
}

}  // namespace arthro::app
