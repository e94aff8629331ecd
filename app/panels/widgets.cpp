#include "app/panels/widgets.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>

#include <imgui_internal.h>
#include <imgui_stdlib.h>

namespace arthro::app {
namespace {

// A slider is at most some thousand pixels wide, and ImGui aborts on half the range of int.
constexpr long long kMostSliderValues = 1'000'000;

// ImGui's own identity of a widget: hidden behind "##" where the label is drawn elsewhere.
std::string Hidden(const std::string& name) { return "##" + name; }

Change ChangeOfLastItem(bool changed) {
  return {changed, ImGui::IsItemActive(), ImGui::IsItemDeactivatedAfterEdit()};
}

std::string Formatted(const char* format, double value) {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

// Zero in the place of a negative number that would be shown as "-0.0".
double WithoutMinusZero(const char* format, double value) {
  const std::string text = Formatted(format, value);
  const bool is_zero = text.find_first_of("123456789") == std::string::npos;
  return is_zero && text.starts_with('-') ? 0.0 : value;
}

// "0.0 mm to 47.5 mm", for the tip of a slider.
std::string RangeWords(const std::string& low, const std::string& high) {
  return low + " to " + high;
}

void Label(Ui& ui, const std::string& name) {
  ui.widgets.RecordText(name);
  ImGui::PushStyleColor(ImGuiCol_Text, OnGround(kQuiet));
  ImGui::TextUnformatted(ui.In(name).c_str());
  ImGui::PopStyleColor();
}

// The value, at the right end of the label's line.
void ValueOverSlider(const std::string& value) {
  ImGui::SameLine(ImGui::GetContentRegionMax().x - ImGui::CalcTextSize(value.c_str()).x);
  ImGui::TextUnformatted(value.c_str());
}

// Hides the number that ImGui writes over the grab, but not the one that is being typed.
class NumberHidden {
 public:
  explicit NumberHidden(const std::string& hidden_name)
      : hidden_(!ImGui::TempInputIsActive(ImGui::GetID(hidden_name.c_str()))) {
    if (hidden_) ImGui::PushStyleColor(ImGuiCol_Text, 0u);
  }
  ~NumberHidden() {
    if (hidden_) ImGui::PopStyleColor();
  }

 private:
  bool hidden_;
};

// ImGui's last item was clicked, or changed and let go, by mouse or keyboard.
void NoteUse(Ui& ui, WidgetKind kind) {
  if (kind == WidgetKind::kSlider || kind == WidgetKind::kText) {
    if (ImGui::IsItemDeactivatedAfterEdit()) ui.widgets.NoteAct(true);
    return;
  }
  if (kind == WidgetKind::kCombo) return;  // noted with the entry that is chosen
  const ImGuiID id = ImGui::GetItemID();
  const bool is_clicked = ImGui::IsItemDeactivated() && ImGui::IsMouseReleased(0) &&
                          ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenBlockedByPopup);
  if (is_clicked || (id != 0 && GImGui->NavActivateId == id)) ui.widgets.NoteAct(false);
}

// The keyboard acts on ImGui's last item from now on, without pressing it.
void TakeFocus(Ui& ui, ImGuiID id) {
  ImGuiWindow* const window = ImGui::GetCurrentWindow();
  const ImRect rectangle = GImGui->LastItemData.Rect;
  ui.widgets.AskFocus(0);
  ImGui::ClearActiveID();
  ImGui::FocusWindow(window);
  ImGui::SetNavID(id, window->DC.NavLayerCurrent, 0, ImGui::WindowRectAbsToRel(window, rectangle));
  GImGui->NavDisableHighlight = false;
  GImGui->NavDisableMouseHover = true;
  if (!window->ClipRect.Contains(rectangle)) ImGui::SetScrollHereY();
}

}  // namespace

void RecordItem(Ui& ui, const std::string& name, bool enabled, const std::string& value,
                WidgetKind kind) {
  // The part inside the window's clip rectangle is what can be pointed at.
  const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
  const ImRect clip = ImGui::GetCurrentWindow()->ClipRect;
  WidgetRecord record;
  record.name = name;
  record.x0 = std::max(low.x, clip.Min.x), record.y0 = std::max(low.y, clip.Min.y);
  record.x1 = std::min(high.x, clip.Max.x), record.y1 = std::min(high.y, clip.Max.y);
  record.is_cut = low.x < clip.Min.x - 1 || high.x > clip.Max.x + 1;
  record.visible = record.x1 > record.x0 && record.y1 > record.y0;
  record.enabled = enabled && (GImGui->LastItemData.InFlags & ImGuiItemFlags_Disabled) == 0;
  record.value = value;
  record.kind = kind;
  const ImGuiWindow* const modal = ImGui::GetTopMostPopupModal();
  record.reachable =
      modal == nullptr ||
      ImGui::IsWindowWithinBeginStackOf(ImGui::GetCurrentWindow(), const_cast<ImGuiWindow*>(modal));
  record.id = ImGui::GetItemID();
  const ImGuiWindow* const window = ImGui::GetCurrentWindow();
  if ((window->Flags & ImGuiWindowFlags_NoNavInputs) != 0) record.id = 0;
  record.focused = record.id != 0 && GImGui->NavId == record.id && !GImGui->NavDisableHighlight;
  if (record.id != 0 && ui.widgets.wanted_focus() == record.id) TakeFocus(ui, record.id);
  const bool is_picture = kind == WidgetKind::kPicture || kind == WidgetKind::kShown;
  ui.widgets.Record(std::move(record));
  if (ui.widgets.IsWanted(name)) ImGui::SetScrollHereY();
  if (ui.widgets.widgets().back().enabled && !is_picture) NoteUse(ui, kind);
}

bool HitArea(const char* id, const ImVec2& size, ImGuiButtonFlags flags) {
  return ImGui::InvisibleButton(id, {std::max(size.x, 1.0f), std::max(size.y, 1.0f)}, flags);
}

void Tooltip(Ui& ui, const char* text, const std::string& keys, const char* why_disabled) {
  if (text == nullptr || *text == '\0') return;
  ui.widgets.NoteTip();
  ui.In(text);  // Notes a text without translation before anybody points at it.
  if (!ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled) || ImGui::IsAnyItemActive())
    return;
  // Only after the pointer has rested: tips must not flicker over a list that is swept.
  if (GImGui->HoveredIdTimer < 0.5f) return;
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(ui.Px(340));
  const std::string shown = ui.In(text);
  ImGui::TextUnformatted((keys.empty() ? shown : shown + " (" + ui.In(keys) + ")").c_str());
  if (*why_disabled != '\0') {
    ImGui::PushStyleColor(ImGuiCol_Text, OnGround(kWarning));
    ImGui::TextUnformatted(ui.In(why_disabled).c_str());
    ImGui::PopStyleColor();
  }
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

bool Button(Ui& ui, const std::string& name, bool enabled, const ImVec2& size,
            const char* tooltip) {
  ImGui::BeginDisabled(!enabled);
  const bool pressed = ImGui::Button(ui.translation.Label(name).c_str(), size);
  ImGui::EndDisabled();
  RecordItem(ui, name, enabled);
  Tooltip(ui, tooltip);
  return pressed && enabled;
}

bool ToggleButton(Ui& ui, const std::string& name, bool chosen, bool enabled, const ImVec2& size,
                  const char* tooltip) {
  if (chosen) {
    ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetStyleColorVec4(ImGuiCol_ButtonActive));
    ImGui::PushStyleColor(ImGuiCol_ButtonHovered, ImGui::GetStyleColorVec4(ImGuiCol_ButtonActive));
  }
  ImGui::BeginDisabled(!enabled);
  const bool pressed = ImGui::Button(ui.translation.Label(name).c_str(), size);
  ImGui::EndDisabled();
  if (chosen) ImGui::PopStyleColor(2);
  RecordItem(ui, name, enabled, chosen ? "on" : "off");
  Tooltip(ui, tooltip);
  return pressed && enabled;
}

// ImGui lights half the spacing of items on each side of the words.
PaddedRow::PaddedRow(const Ui& ui) : room_(ui.Px(8)) {
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {2 * room_, ImGui::GetStyle().ItemSpacing.y});
  ImGui::Indent(room_);
}

PaddedRow::~PaddedRow() {
  ImGui::Unindent(room_);
  ImGui::PopStyleVar();
}

bool ListEntry(Ui& ui, const std::string& name, bool chosen, ImGuiSelectableFlags flags,
               const ImVec2& size) {
  std::optional<PaddedRow> padded;
  if (ImGui::GetCurrentTable() == nullptr) padded.emplace(ui);
  const bool pressed = ImGui::Selectable(ui.translation.Label(name).c_str(), chosen, flags, size);
  RecordItem(ui, name, true, chosen ? "on" : "off");
  return pressed;
}

bool Section(Ui& ui, const std::string& name, bool is_open_at_first) {
  const bool is_open = ImGui::CollapsingHeader(
      ui.translation.Label(name).c_str(), is_open_at_first ? ImGuiTreeNodeFlags_DefaultOpen : 0);
  RecordItem(ui, name, true, is_open ? "on" : "off");
  return is_open;
}

void TextInput(Ui& ui, const std::string& name, std::string& text, const std::string& hint,
               ImGuiInputTextFlags flags) {
  ImGui::InputTextWithHint(Hidden(name).c_str(), ui.In(hint).c_str(), &text, flags);
  RecordItem(ui, name, true, text, WidgetKind::kText);
}

bool Checkbox(Ui& ui, const std::string& name, bool& value, const char* tooltip) {
  const bool changed = ImGui::Checkbox(ui.translation.Label(name).c_str(), &value);
  RecordItem(ui, name, true, value ? "on" : "off");
  Tooltip(ui, tooltip);
  return changed;
}

Change Slider(Ui& ui, const std::string& name, double& value, double min, double max,
              const char* format, const char* tooltip) {
  Label(ui, name);
  ValueOverSlider(Formatted(format, value));
  ImGui::SetNextItemWidth(-FLT_MIN);
  double shown = value;
  bool changed = false;
  {
    const NumberHidden hidden(Hidden(name));
    changed = ImGui::SliderScalar(Hidden(name).c_str(), ImGuiDataType_Double, &shown, &min, &max,
                                  format, ImGuiSliderFlags_AlwaysClamp);
  }
  const Change change = ChangeOfLastItem(changed && std::isfinite(shown) && shown != value);
  if (change.changed) value = shown;
  RecordItem(ui, name, true, Formatted(format, shown), WidgetKind::kSlider);
  Tooltip(ui, tooltip, RangeWords(Formatted(format, min), Formatted(format, max)));
  return change;
}

Change SliderInt(Ui& ui, const std::string& name, int& value, int min, int max, const char* format,
                 const char* tooltip) {
  Label(ui, name);
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  const bool is_typed = static_cast<long long>(max) - min > kMostSliderValues;
  if (!is_typed) ValueOverSlider(text);
  ImGui::SetNextItemWidth(-FLT_MIN);
  int shown = value;
  bool changed = false;
  if (is_typed) {
    changed = ImGui::InputInt(Hidden(name).c_str(), &shown, 1, 100);
    shown = std::clamp(shown, min, max);
  } else {
    const NumberHidden hidden(Hidden(name));
    changed = ImGui::SliderInt(Hidden(name).c_str(), &shown, min, max, format,
                               ImGuiSliderFlags_AlwaysClamp);
  }
  const Change change = ChangeOfLastItem(changed && shown != value);
  if (change.changed) value = shown;
  std::snprintf(text, sizeof text, format, shown);
  RecordItem(ui, name, true, text, WidgetKind::kSlider);
  char low[64], high[64];
  std::snprintf(low, sizeof low, format, min);
  std::snprintf(high, sizeof high, format, max);
  Tooltip(ui, tooltip, RangeWords(low, high));
  return change;
}

Change NumberField(Ui& ui, const std::string& name, double& value, double step, double min,
                   double max, const char* format, const char* tooltip) {
  double shown = WithoutMinusZero(format, value);
  const bool changed =
      ImGui::DragScalar(Hidden(name).c_str(), ImGuiDataType_Double, &shown,
                        static_cast<float>(step), &min, &max, format, ImGuiSliderFlags_AlwaysClamp);
  const Change change = ChangeOfLastItem(changed && std::isfinite(shown) && shown != value);
  if (change.changed) value = shown;
  RecordItem(ui, name, true, Formatted(format, shown), WidgetKind::kSlider);
  Tooltip(ui, tooltip, RangeWords(Formatted(format, min), Formatted(format, max)));
  return change;
}

bool TextField(Ui& ui, const std::string& name, std::string& value, const char* hint) {
  Label(ui, name);
  ImGui::SetNextItemWidth(-FLT_MIN);
  // Taken over when the field is left, so that one rename is one step.
  std::string typed = value;
  ImGui::InputTextWithHint(Hidden(name).c_str(), ui.In(hint).c_str(), &typed);
  const unsigned id = ImGui::GetItemID();
  const bool done = ImGui::IsItemDeactivatedAfterEdit();
  if (ImGui::IsItemActive()) ui.widgets.KeepDraft(id, typed);
  // The focus was taken away before the field could hand over its text.
  if (const std::string* draft = ui.widgets.DraftOf(id); done && draft && typed == value)
    typed = *draft;
  RecordItem(ui, name, true, typed, WidgetKind::kText);
  Tooltip(ui, hint);
  if (done) value = typed;
  return done;
}

bool Combo(Ui& ui, const std::string& name, int& chosen, const std::vector<std::string>& words,
           const char* tooltip) {
  Label(ui, name);
  ImGui::SetNextItemWidth(-FLT_MIN);
  const std::string shown = chosen >= 0 && chosen < static_cast<int>(words.size())
                                ? words[static_cast<std::size_t>(chosen)]
                                : "";
  bool changed = false;
  const bool open =
      ImGui::BeginCombo(Hidden(name).c_str(), ui.In(shown.empty() ? "choose…" : shown).c_str());
  RecordItem(ui, name, true, shown, WidgetKind::kCombo);
  const std::size_t own = ui.widgets.widgets().size() - 1;
  Tooltip(ui, tooltip);
  if (open) {
    for (int i = 0; i < static_cast<int>(words.size()); ++i) {
      const std::string& word = words[static_cast<std::size_t>(i)];
      if (ListEntry(ui, word, i == chosen) && i != chosen) chosen = i, changed = true;
    }
    ImGui::EndCombo();
  }
  if (changed) ui.widgets.NoteAct(false, own);
  return changed;
}

bool DialogKeyPressed(int key) {
  return !ImGui::IsWindowAppearing() && ImGui::IsKeyPressed(key, false);
}

void Heading(Ui& ui, const std::string& text) {
  ImGui::PushFont(ui.fonts.heading);
  Text(ui, text);
  ImGui::PopFont();
}

void LargeText(Ui& ui, const std::string& text, unsigned colour) {
  ImGui::PushFont(ui.fonts.large);
  ColouredText(ui, text, colour);
  ImGui::PopFont();
}

void Text(Ui& ui, const std::string& text) {
  ImGui::PushTextWrapPos(0.0f);
  ImGui::TextUnformatted(ui.In(text).c_str());
  ImGui::PopTextWrapPos();
  if (ImGui::IsItemVisible()) ui.widgets.RecordText(text);
}

void MarkedBar(Ui& ui, const std::string& name, double filled, unsigned colour, double mark,
               const std::string& value) {
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x, height = ui.Px(16);
  const auto at = [&](double share) {
    return corner.x + width * static_cast<float>(std::clamp(share, 0.0, 1.0));
  };
  ImDrawList* draw = ImGui::GetWindowDrawList();
  draw->AddRectFilled(corner, {corner.x + width, corner.y + height},
                      ImGui::GetColorU32(ImGuiCol_FrameBg), ui.Px(4));
  if (filled > 0)
    draw->AddRectFilled(corner, {std::max(at(filled), corner.x + ui.Px(3)), corner.y + height},
                        OnGround(colour), ui.Px(4));
  if (mark > 0)
    draw->AddLine({at(mark), corner.y}, {at(mark), corner.y + height}, OnGround(kBright), ui.Px(2));
  ImGui::Dummy({width, height});
  RecordItem(ui, name, true, value, WidgetKind::kShown);
}

void QuietText(Ui& ui, const std::string& text) { ColouredText(ui, text, kQuiet); }

void ColouredText(Ui& ui, const std::string& text, unsigned colour) {
  ImGui::PushStyleColor(ImGuiCol_Text, OnGround(colour));
  Text(ui, text);
  ImGui::PopStyleColor();
}

void ShortenedText(Ui& ui, const std::string& text, const std::string& full, float room) {
  if (room <= 0) room = ImGui::GetContentRegionAvail().x;
  const std::string whole = ui.In(text);
  std::string shown = whole;
  // Whole characters go from the middle: bytes that go on with one begin with binary 10.
  const auto goes_on = [](char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; };
  std::size_t left = (whole.size() + 1) / 2;
  while (left > 0 && left < whole.size() && goes_on(whole[left])) --left;
  std::size_t right = left;
  while (ImGui::CalcTextSize(shown.c_str()).x > room && (left > 0 || right < whole.size())) {
    if (left > 0 && left >= whole.size() - right)
      while (--left > 0 && goes_on(whole[left])) {
      }
    else
      while (++right < whole.size() && goes_on(whole[right])) {
      }
    shown = whole.substr(0, left) + "…" + whole.substr(right);
  }
  ImGui::TextUnformatted(shown.c_str());
  ui.widgets.RecordText(text);
  if (ImGui::IsItemHovered() && (shown != whole || full != text)) {
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(ui.Px(420));
    ImGui::TextUnformatted(ui.In(full).c_str());
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
  }
}

void DrawWords(Ui& ui, const ImVec2& corner, unsigned colour, const std::string& words) {
  ui.widgets.RecordText(words);
  ImGui::GetWindowDrawList()->AddText(corner, OnGround(colour), ui.In(words).c_str());
}

void Gap(Ui& ui, double pixels) { ImGui::Dummy({0, ui.Px(pixels)}); }

}  // namespace arthro::app
