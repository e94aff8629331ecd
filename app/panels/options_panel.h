// Any options struct as sliders, boxes and lists, by its one list of fields (simulation/core/
// options.h): lengths in millimetres, angles in degrees, the help as a tooltip.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "app/panels/option_words.h"
#include "app/panels/widgets.h"
#include "simulation/core/options.h"

namespace arthro::app {

struct OptionsPanelVisitor {
  Ui& ui;
  double longest = std::numeric_limits<double>::infinity();  // m; a slider ends there
  std::function<bool(std::string_view)> has_effect =
      {};                          // false: the field is grey; empty: none is
  std::string changed_field = {};  // its words; empty when nothing changed
  bool held = false, released = false;

  template <class T, class R>
  void operator()(const char* name, T& field, const R& range, const char* unit, const char* help) {
    ImGui::BeginDisabled(has_effect && !has_effect(name));
    Show(name, field, range, unit, help);
    ImGui::EndDisabled();
  }

 private:
  template <class T, class R>
  void Show(const char* name, T& field, const R& range, const char* unit, const char* help) {
    const std::string words = LabelOfField(name);
    const Border border = PersonBorder(unit);
    if constexpr (std::is_enum_v<T>) {
      std::vector<std::string> choices;
      int chosen = -1;
      for (const auto& [value, word] : range.words) {
        if (value == field) chosen = static_cast<int>(choices.size());
        choices.push_back(LabelOfChoice(name, word));
      }
      if (Combo(ui, words, chosen, choices, help)) {
        field = range.words[static_cast<std::size_t>(chosen)].first;
        changed_field = words;
        released = true;
      }
    } else if constexpr (std::is_same_v<T, bool>) {
      if (Checkbox(ui, words, field, help)) {
        changed_field = words;
        released = true;
      }
    } else if constexpr (std::is_same_v<T, double> && std::is_same_v<R, Range>) {
      double shown = field * border.factor;
      const double most = std::string_view(unit) == "m" ? std::min(range.max, longest) : range.max;
      const double width = (range.max - range.min) * border.factor, high = most * border.factor;
      // The border itself is not allowed where the range lies above it.
      const double low = range.min * border.factor + (range.above_min ? StepOf(width) : 0.0);
      Note(words, Slider(ui, words, shown, low, high, Format(unit, width).c_str(), help),
           [&] { field = shown / border.factor; });
    } else if constexpr (std::is_same_v<T, int> && std::is_same_v<R, Range>) {
      int shown = field;
      const std::string format = std::string("%d") + (*unit ? " " : "") + Escaped(ui.In(unit));
      Note(words,
           SliderInt(ui, words, shown, static_cast<int>(range.min), static_cast<int>(range.max),
                     format.c_str(), help),
           [&] { field = shown; });
    } else if constexpr (std::is_same_v<T, std::string>) {
      if (TextField(ui, words, field, help)) {
        changed_field = words;
        released = true;
      }
    } else {
      static_assert(std::is_same_v<R, Range>, "a number that is shown needs a range");
    }
  }

  template <class Take>
  void Note(const std::string& words, const Change& change, const Take& take) {
    if (change.changed) {
      take();
      changed_field = words;
    }
    held = held || change.held;
    released = released || change.released;
  }

  static std::string Escaped(const std::string& unit) { return unit == "%" ? "%%" : unit; }

  // Least difference that is shown, in the unit that is shown.
  static double StepOf(double width) { return width > 50 ? 0.1 : 0.01; }

  // Decimals that a person can set with the mouse.
  std::string Format(const std::string& unit, double width) const {
    const std::string shown = unit == "m" ? "mm" : unit == "rad" ? "°" : Escaped(ui.In(unit));
    const char* number = StepOf(width) == 0.1 ? "%.1f" : "%.2f";
    return std::string(number) + (shown.empty() ? "" : " ") + shown;
  }
};

// The words of the field that changed, or "". `held` and `released` as in Change. Sliders of
// lengths end at `longest`, m, where that is less than the field allows. Fields without effect, by
// their names in Visit, are grey.
template <class Options>
OptionsPanelVisitor OptionsPanel(Ui& ui, Options& options,
                                 double longest = std::numeric_limits<double>::infinity(),
                                 std::function<bool(std::string_view)> has_effect = {}) {
  OptionsPanelVisitor visitor{ui, longest, std::move(has_effect)};
  options.Visit(visitor);
  return visitor;
}

}  // namespace arthro::app
