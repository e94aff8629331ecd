// The widgets that panels are made of: Dear ImGui's, each recorded under its English name, so that
// scripts and tests can find it, and shown in the window's language. Sizes are in pixels at content
// scale 1.
#pragma once

#include <string>
#include <vector>

#include <imgui.h>

#include "app/platform/theme.h"
#include "app/platform/translation.h"
#include "app/platform/widget_registry.h"

namespace arthro::app {

inline constexpr double kThumbButton = 44;  // px; height of a button that a thumb hits

// Drawing context of a panel; lives for one frame.
struct Ui {
  WidgetRegistry& widgets;
  const Fonts& fonts;
  Translation& translation;
  float scale = 1.0f;

  float Px(double pixels) const { return static_cast<float>(pixels) * scale; }
  // The text in the window's language. Widgets look their own texts up; this is for texts that are
  // measured or drawn by hand.
  const std::string& In(const std::string& english) const { return translation.Of(english); }
  float WidthOf(const std::string& english) const {
    return ImGui::CalcTextSize(In(english).c_str()).x;
  }
};

// Records ImGui's last item, and that it was used in this frame.
void RecordItem(Ui& ui, const std::string& name, bool enabled = true, const std::string& value = "",
                WidgetKind kind = WidgetKind::kButton);

// An area that takes the mouse; at least 1 px wide and high, since ImGui aborts on less.
bool HitArea(const char* id, const ImVec2& size, ImGuiButtonFlags flags = 0);

bool Button(Ui& ui, const std::string& name, bool enabled = true, const ImVec2& size = {0, 0},
            const char* tooltip = nullptr);
// A button that stands for a state: lit while `chosen`.
bool ToggleButton(Ui& ui, const std::string& name, bool chosen, bool enabled = true,
                  const ImVec2& size = {0, 0}, const char* tooltip = nullptr);
// Room before the words of the next row, within what is lit when it is chosen.
class PaddedRow {
 public:
  explicit PaddedRow(const Ui& ui);
  ~PaddedRow();
  PaddedRow(const PaddedRow&) = delete;
  PaddedRow& operator=(const PaddedRow&) = delete;

 private:
  float room_;
};

// A row of a list. A table has padding of its own.
bool ListEntry(Ui& ui, const std::string& name, bool chosen, ImGuiSelectableFlags flags = 0,
               const ImVec2& size = {0, 0});
// A heading that opens and closes what follows.
bool Section(Ui& ui, const std::string& name, bool is_open_at_first = false);
// One line that is typed into, without a label.
void TextInput(Ui& ui, const std::string& name, std::string& text, const std::string& hint,
               ImGuiInputTextFlags flags = 0);
bool Checkbox(Ui& ui, const std::string& name, bool& value, const char* tooltip = nullptr);

// Change of a slider or field in this frame.
struct Change {
  bool changed = false;   // the value is another one
  bool held = false;      // the mouse or keyboard still has hold of it
  bool released = false;  // it was just let go after a change
  explicit operator bool() const { return changed; }
};

// Label above, slider below over the whole width; Ctrl+click types a number, which is kept within
// the range. `format` as printf takes it, with the unit.
Change Slider(Ui& ui, const std::string& name, double& value, double min, double max,
              const char* format, const char* tooltip = nullptr);
// A field that is typed into where the range has more values than a slider can set.
Change SliderInt(Ui& ui, const std::string& name, int& value, int min, int max, const char* format,
                 const char* tooltip = nullptr);
// A number field that is dragged or typed into, `width` wide; label on its left if it has room.
Change NumberField(Ui& ui, const std::string& name, double& value, double step, double min,
                   double max, const char* format, const char* tooltip = nullptr);
bool TextField(Ui& ui, const std::string& name, std::string& value, const char* hint = "");
// Index of the chosen word; true when another one was chosen.
bool Combo(Ui& ui, const std::string& name, int& chosen, const std::vector<std::string>& words,
           const char* tooltip = nullptr);

// A key that goes down in this frame, for the dialog that is drawn; not the one that opened it.
bool DialogKeyPressed(int key);  // GLFW_KEY_…

// Bar over the whole width, filled to the share `filled`, with a line at the share `mark`; 0: none.
void MarkedBar(Ui& ui, const std::string& name, double filled, unsigned colour, double mark,
               const std::string& value);
void Heading(Ui& ui, const std::string& text);
void LargeText(Ui& ui, const std::string& text, unsigned colour = kBright);
void Text(Ui& ui, const std::string& text);       // wrapped
void QuietText(Ui& ui, const std::string& text);  // wrapped, secondary
// One line that gives up its middle where there is no room for all; `full` is its tooltip. 0: up to
// the window's edge.
void ShortenedText(Ui& ui, const std::string& text, const std::string& full, float room = 0);
void ColouredText(Ui& ui, const std::string& text, unsigned colour);
// Shown while the last item is pointed at, with the keys that do the same.
void Tooltip(Ui& ui, const char* text, const std::string& keys = "", const char* why_disabled = "");
// `words` drawn by hand, in the window's language, in a colour of the theme's ground.
void DrawWords(Ui& ui, const ImVec2& corner, unsigned colour, const std::string& words);
void Gap(Ui& ui, double pixels = 6);

}  // namespace arthro::app
