// The scope's picture and the author's overview: they show a texture and say what the user did over
// it.
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <imgui.h>

#include "app/editor/panels/panels.h"
#include "app/panels/command_button.h"
#include "app/panels/fixed_window.h"
#include "app/state/command.h"
#include "app/state/edits.h"
#include "app/steps/lessons/lessons_step.h"
#include "app/steps/practice/hand_motion.h"
#include "app/view/overview/overview.h"
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

// The author holds the scope: its pose stands below the picture.
bool HasStrip(const EditorState& state) {
  return !state.practice && state.steps.lessons->page != LessonPage::kDebrief;
}

// The edge of the square picture in its area.
float PictureEdge(const Ui& ui, bool has_strip, const Area& area) {
  const float strip = has_strip ? ui.Px(kStripHeight) : 0;
  return std::floor(
      std::max(16.0f, std::min(area.width - ui.Px(16), area.height - strip - ui.Px(16))));
}

// Pictures are black in every theme, so their words are bright.
void WordsOverPicture(Ui& ui, const std::string& words) {
  ImGui::PushStyleColor(ImGuiCol_Text, kQuiet);
  ImGui::TextUnformatted(ui.In(words).c_str());
  ImGui::PopStyleColor();
  ui.widgets.RecordText(words);
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
    // In a narrow picture a name ends with its field.
    ImGui::PushClipRect({x, corner.y}, {x + width, corner.y + 2 * ImGui::GetTextLineHeight()},
                        true);
    WordsOverPicture(ui, field.name);
    ImGui::PopClipRect();
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

constexpr float kCornerGap = 6, kCornerEdge = 8;  // px at scale 1

float CornerWidth(const Ui& ui, const EditorState& state, const std::vector<const char*>& ids) {
  const float padding = 2 * ImGui::GetStyle().FramePadding.x, gap = ui.Px(kCornerGap);
  float width = ui.Px(kCornerEdge) - gap;
  for (const char* id : ids) width += ui.WidthOf(CommandOf(state, id).words) + padding + gap;
  return width;
}

// Commands over the upper right corner of a picture, the last one at the edge; in a narrow picture
// the first ones are left out.
void CornerButtons(Ui& ui, EditorState& state, const Area& area, std::vector<const char*> ids) {
  while (ids.size() > 1 && CornerWidth(ui, state, ids) > area.width) ids.erase(ids.begin());
  const float gap = ui.Px(kCornerGap), edge = ui.Px(kCornerEdge);
  float x = area.x + area.width - CornerWidth(ui, state, ids);
  for (const char* id : ids) {
    ImGui::SetCursorScreenPos({x, area.y + edge});
    CommandButton(ui, state, id);
    x += ImGui::GetItemRectSize().x + gap;
  }
}

// Commands along the lower edge of a picture, the first one at its left.
void SideButtons(Ui& ui, EditorState& state, const Area& area) {
  const float edge = ui.Px(kCornerEdge);
  ImGui::SetCursorScreenPos({area.x + edge, area.y + area.height - edge - ImGui::GetFrameHeight()});
  for (const char* id : {"overview-front", "overview-top", "overview-right"}) {
    CommandButton(ui, state, id);
    ImGui::SameLine(0, ui.Px(kCornerGap));
  }
  ImGui::NewLine();
}

// The overview's picture and what is done to it, in the window that was begun.
// `buttons` come before the area that takes the mouse, so that a click on one is theirs alone.
template <class Buttons>
OverviewInput OverviewArea(Ui& ui, const Area& area, unsigned texture, bool has_label,
                           const Buttons& buttons) {
  OverviewInput input;
  if (texture != 0)
    OpaqueImage(ImGui::GetWindowDrawList(), texture, {area.x, area.y},
                {area.x + area.width, area.y + area.height});
  buttons();
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
  ImGui::SetCursorScreenPos({area.x + ui.Px(12), area.y + ui.Px(8)});
  if (has_label) WordsOverPicture(ui, "Overview");
  return input;
}

// Place to take hold of the chosen tissue: a disc with four arrows.
void DrawHandle(Ui& ui, const Area& area, const glm::dvec2& place) {
  ImDrawList* draw = ImGui::GetWindowDrawList();
  const ImVec2 middle = {area.x + static_cast<float>(place.x),
                         area.y + static_cast<float>(place.y)};
  const float radius = ui.Px(Overview::kHandleRadius);
  draw->AddCircleFilled(middle, radius, 0xA0202020);
  draw->AddCircle(middle, radius, kAccent, 0, ui.Px(1.5));
  for (const auto& [x, y] : {std::pair{1.0f, 0.0f}, {-1.0f, 0.0f}, {0.0f, 1.0f}, {0.0f, -1.0f}}) {
    const float out = 0.72f * radius, in = 0.38f * radius, half = 0.26f * radius;
    draw->AddTriangleFilled({middle.x + x * out, middle.y + y * out},
                            {middle.x + x * in + y * half, middle.y + y * in + x * half},
                            {middle.x + x * in - y * half, middle.y + y * in - x * half}, kBright);
  }
  ui.widgets.Record({"Handle", middle.x - radius, middle.y - radius, middle.x + radius,
                     middle.y + radius, true, true, "", WidgetKind::kPicture});
}

}  // namespace

int ScopePictureSize(const Ui& ui, const EditorState& state, const Area& area) {
  return static_cast<int>(PictureEdge(ui, HasStrip(state), area));
}

PictureInput ScopePicture(Ui& ui, EditorState& state, const Area& area, unsigned texture) {
  const FixedWindow window(ui, "picture", area, kPictureWindow);
  const bool has_strip = HasStrip(state);
  const float edge = PictureEdge(ui, has_strip, area);
  const float strip = has_strip ? ui.Px(kStripHeight) : 0;
  const ImVec2 low = {std::floor(area.x + 0.5f * (area.width - edge)),
                      std::floor(area.y + std::max(0.5f * (area.height - strip - edge), 0.0f))};
  ImDrawList* draw = ImGui::GetWindowDrawList();
  draw->AddRectFilled({area.x, area.y}, {area.x + area.width, area.y + area.height}, 0xFF000000);
  if (texture != 0) {
    OpaqueImage(draw, texture, low, {low.x + edge, low.y + edge});
  } else {
    const char* words = "Drop a panorama, a video or a scene here";
    ui.widgets.RecordText(words);
    const std::string shown = ui.In(words);
    const ImVec2 size = ImGui::CalcTextSize(shown.c_str());
    draw->AddText({low.x + 0.5f * (edge - size.x), low.y + 0.5f * (edge - size.y)}, kQuiet,
                  shown.c_str());
  }
  if (has_strip)
    CornerButtons(ui, state, area,
                  {state.views.shown == ViewLayout::Shown::kBoth ? "view-scope" : "view-both"});
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
  // The way to where a drag begins is no part of it.
  if (ImGui::IsItemActive() && !ImGui::IsItemActivated()) {
    const glm::dvec2 drag = {io.MouseDelta.x / edge, io.MouseDelta.y / edge};
    if (io.MouseDown[0]) input.scope_drag = drag;
    if (io.MouseDown[1]) input.instrument_drag = drag;
  }
  if (input.hovered) input.wheel = io.MouseWheel;
  input.shift = io.KeyShift;
  input.ctrl = io.KeyCtrl;
  if (has_strip) {
    PoseStrip(ui, state, {area.x + ui.Px(12), area.y + area.height - strip + ui.Px(2)},
              area.width - ui.Px(24));
  }
  return input;
}

Area LabelledPicture(Ui& ui, const Area& area, unsigned texture, const std::string& name,
                     const std::string& words) {
  const FixedWindow window(ui, name.c_str(), area, kPictureWindow);
  const float edge = PictureEdge(ui, false, area);
  const ImVec2 low = {std::floor(area.x + 0.5f * (area.width - edge)),
                      std::floor(area.y + 0.5f * (area.height - edge))};
  ImDrawList* draw = ImGui::GetWindowDrawList();
  draw->AddRectFilled({area.x, area.y}, {area.x + area.width, area.y + area.height}, 0xFF000000);
  if (texture != 0) OpaqueImage(draw, texture, low, {low.x + edge, low.y + edge});
  ImGui::SetCursorScreenPos(low);
  ImGui::Dummy({edge, edge});
  RecordItem(ui, name, true, "", WidgetKind::kPicture);
  const Area square{low.x, low.y, edge, edge};
  if (words.empty()) return square;
  // A shade keeps the words readable where they reach over the picture.
  const ImVec2 corner = {area.x + ui.Px(12), area.y + ui.Px(8)};
  const float width = ui.WidthOf(words), height = ImGui::GetTextLineHeight();
  draw->AddRectFilled({corner.x - ui.Px(4), corner.y - ui.Px(2)},
                      {corner.x + width + ui.Px(4), corner.y + height + ui.Px(3)}, 0xC0000000,
                      ui.Px(3));
  ImGui::SetCursorScreenPos(corner);
  WordsOverPicture(ui, words);
  return square;
}

OverviewInput OverviewPicture(Ui& ui, EditorState& state, const Area& area, unsigned texture,
                              const std::optional<glm::dvec2>& handle) {
  const FixedWindow window(ui, "overview", area, kPictureWindow);
  // The commands come first where there is no room for both.
  std::vector<const char*> ids = {"fit-overview", "view-both"};
  if (state.views.shown == ViewLayout::Shown::kBoth)
    ids = {"fit-overview", "swap-views", "view-overview"};
  const float label = ui.WidthOf("Overview") + ui.Px(24);
  return OverviewArea(ui, area, texture, area.width > CornerWidth(ui, state, ids) + label, [&] {
    if (handle) DrawHandle(ui, area, *handle);
    CornerButtons(ui, state, area, ids);
    SideButtons(ui, state, area);
  });
}

void ViewSplitter(Ui& ui, EditorState& state, const Layout& layout) {
  if (!layout.shows_picture || !layout.shows_overview) return;
  const Area& left = layout.picture.x < layout.overview.x ? layout.picture : layout.overview;
  const float width = ui.Px(9), beside = layout.picture.width + layout.overview.width;
  const Area area = {left.x + left.width - 0.5f * width, left.y, width, left.height};
  const FixedWindow window(ui, "splitter", area, kInsetWindow | ImGuiWindowFlags_NoBackground);
  ImGui::SetCursorScreenPos({area.x, area.y});
  HitArea("Border of the views", {area.width, area.height});
  RecordItem(ui, "Border of the views", true, "", WidgetKind::kPicture);
  const bool is_held = ImGui::IsItemActive();
  if (is_held || ImGui::IsItemHovered()) {
    ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
    const float middle = area.x + 0.5f * width;
    ImGui::GetWindowDrawList()->AddLine({middle, area.y}, {middle, area.y + area.height}, kAccent,
                                        ui.Px(2));
  }
  if (!is_held || ImGui::IsItemActivated() || beside < 1) return;
  const float from_left = ImGui::GetIO().MousePos.x - left.x;
  const double share = state.views.is_swapped ? from_left / beside : 1.0 - from_left / beside;
  state.views.overview_share = std::clamp(share, ViewLayout::kLeastShare, ViewLayout::kMostShare);
}

OverviewInput InsetOverview(Ui& ui, const Area& area, unsigned texture) {
  const FixedWindow window(ui, "inset overview", area, kInsetWindow);
  const OverviewInput input = OverviewArea(ui, area, texture, true, [] {});
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
  if (state.practice) state.practice->Press(held(kActKey) && !IsPaused(state));
  state.steps.practice->hands->HoldDeadMan(held(kDeadManKey));
  const bool is_turned = TurnHead(state, HeadTurnOfKeys(seconds, held));
  return MoveHands(state, MotionOfKeys(false, picture_has_focus, seconds, held),
                   MotionOfKeys(true, picture_has_focus, seconds, held)) ||
         is_turned;
}

}  // namespace arthro::app
