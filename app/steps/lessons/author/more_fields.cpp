// Fields that an exercise seldom needs: tools and disturbances at the start, order, gate, limits,
// zones to avoid, and the ways between steps.
#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>
#include <imgui.h>

#include "app/panels/options_panel.h"
#include "app/state/capital.h"
#include "app/state/edits.h"
#include "app/steps/lessons/author/author_fields.h"
#include "app/steps/lessons/author/step_edit.h"
#include "simulation/core/units.h"

namespace arthro::app {
namespace {

constexpr double kSameAngle = 1e-6;  // rad

// Buttons side by side, each lit while `is_on` says so. Returns the one that was pressed; −1: none.
template <class IsOn>
int ToggleRow(Ui& ui, const std::vector<std::string>& names, const IsOn& is_on) {
  const auto count = static_cast<float>(names.size());
  const float width = (ImGui::GetContentRegionAvail().x - (count - 1) * ui.Px(6)) / count;
  int pressed = -1;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i > 0) ImGui::SameLine(0, ui.Px(6));
    if (ToggleButton(ui, names[i], is_on(i), true, {width, 0})) pressed = static_cast<int>(i);
  }
  return pressed;
}

void ViewAngles(Ui& ui, EditedExercise& edited) {
  QuietText(ui, "View angles that may be used; any where none is lit");
  std::vector<double>& angles = edited.changed.setup.view_angles;
  constexpr int kDegrees[] = {0, 30, 70, 90};
  const auto find = [&](std::size_t i) {
    return std::ranges::find_if(angles, [&](double angle) {
      return std::abs(angle - RadiansFromDegrees(kDegrees[i])) < kSameAngle;
    });
  };
  std::vector<std::string> names;
  for (const int degrees : kDegrees) names.push_back(fmt::format("{}°##may", degrees));
  const int pressed = ToggleRow(ui, names, [&](std::size_t i) { return find(i) != angles.end(); });
  if (pressed < 0) return;
  const auto own = find(static_cast<std::size_t>(pressed));
  if (own != angles.end()) {
    angles.erase(own);
  } else {
    angles.push_back(RadiansFromDegrees(kDegrees[pressed]));
    std::ranges::sort(angles);
  }
  edited.Note(true, "View angles");
}

void AllowedInstruments(Ui& ui, EditedExercise& edited) {
  QuietText(ui, "Instruments that may be used; any where none is lit");
  std::vector<std::string>& allowed = edited.changed.setup.instruments;
  std::vector<std::string> names;
  for (const char* kind : kInstrumentKinds) names.push_back(Capital(kind) + "##may");
  const int pressed = ToggleRow(ui, names, [&](std::size_t i) {
    return std::ranges::count(allowed, kInstrumentKinds[i]) > 0;
  });
  if (pressed < 0) return;
  const std::string kind = kInstrumentKinds[pressed];
  if (std::erase(allowed, kind) == 0) allowed.push_back(kind);
  edited.Note(true, "Instruments");
}

// A value that an exercise has or has not: a box, and a slider where it is ticked.
void OptionalField(Ui& ui, EditedExercise& edited, const char* box, const char* words,
                   std::optional<double>& value, double first, double unit, double low, double high,
                   const char* format) {
  bool has_value = value.has_value();
  if (Checkbox(ui, box, has_value)) {
    value = has_value ? std::optional(first) : std::nullopt;
    edited.Note(true, words);
  }
  if (!value) return;
  double shown = *value / unit;
  edited.Note(Slider(ui, words, shown, low, std::max(high, shown), format), words);
  value = shown * unit;
}

template <class Value>
void Choice(Ui& ui, EditedExercise& edited, const char* words, Value& value,
            const std::vector<std::string>& choices) {
  int chosen = static_cast<int>(value);
  edited.Note(Combo(ui, words, chosen, choices), words);
  value = static_cast<Value>(chosen);
}

// Shares from 0 to 1 of a struct of options.
struct ShareFields {
  Ui& ui;
  EditedExercise& edited;
  template <class T, class R>
  void operator()(const char* name, T& field, const R&, const char*, const char* help) {
    const std::string words = WordsOfField(name);
    edited.Note(Slider(ui, words, field, 0, 1, "%.2f", help), "Disturbances at the start");
  }
};

void Needs(Ui& ui, EditorState& state, EditedExercise& edited) {
  const auto& all = state.document().scene.exercises;
  if (all.size() < 2) return;
  QuietText(ui, "Exercises that are passed first");
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (static_cast<int>(i) == state.steps.lessons->chosen) continue;
    auto& needs = edited.changed.needs;
    bool is_needed = std::ranges::count(needs, all[i].id) > 0;
    if (!Checkbox(ui, fmt::format("{}##need{}", all[i].title, i), is_needed)) continue;
    if (is_needed)
      needs.push_back(all[i].id);
    else
      std::erase(needs, all[i].id);
    edited.Note(true, "Exercises that come first");
  }
}

void Zones(Ui& ui, EditorState& state, EditedExercise& edited) {
  LessonsStep& step = *state.steps.lessons;
  auto& zones = edited.changed.avoid;
  std::string added;
  if (TargetField(ui, edited.changed, "avoid", "Add a zone to avoid", added)) {
    zones.push_back({added, AvoidBy::kInstrument, 0});
    step.zone = static_cast<int>(zones.size()) - 1;
    edited.Note(true, "Zone to avoid");
  }
  for (std::size_t i = 0; i < zones.size(); ++i)
    if (ListEntry(ui, fmt::format("{}##zone{}", zones[i].target, i),
                  static_cast<int>(i) == step.zone))
      step.zone = static_cast<int>(i);
  if (step.zone < 0 || step.zone >= static_cast<int>(zones.size())) return;
  AvoidZone& zone = zones[static_cast<std::size_t>(step.zone)];
  Choice(ui, edited, "Tool that stays out", zone.by, {"Instrument", "Scope", "Both"});
  edited.Note(Slider(ui, "Touches up to", zone.above, 0, 15, "%.1f N",
                     "A touch with at most this force does not count."),
              "Force in the zone");
  if (Button(ui, "Remove this zone", true, {-FLT_MIN, 0})) {
    zones.erase(zones.begin() + step.zone);
    step.zone = -1;
    edited.Note(true, "Remove zone");
  }
}

// The step that follows: the next one, the end, or another by its number.
bool NextField(Ui& ui, const Exercise& exercise, const std::string& words, const char* usual,
               std::string& next) {
  std::vector<std::string> names = {usual, "The end"}, ids = {"", kEndOfExercise};
  for (std::size_t i = 0; i < exercise.steps.size(); ++i) {
    names.push_back(fmt::format("Step {}", i + 1));
    ids.push_back(BaseOf(exercise.steps[i]).id);
  }
  const auto own = std::ranges::find(ids, next);
  int chosen = own == ids.end() ? -1 : static_cast<int>(own - ids.begin());
  if (!Combo(ui, words, chosen, names)) return false;
  next = ids[static_cast<std::size_t>(chosen)];
  return true;
}

}  // namespace

void StartPanel(Ui& ui, EditorState& state) {
  if (Button(ui, "Begin with this view", true, {-FLT_MIN, 0},
             "The scope begins an attempt where you hold it now."))
    BeginWithThisView(state);
  EditedExercise edited(state);
  ViewAngles(ui, edited);
  AllowedInstruments(ui, edited);
  ExerciseSetup& setup = edited.changed.setup;
  Choice(ui, edited, "Camera head", setup.head, {"As in practice", "With the scope", "Upright"});
  OptionalField(ui, edited, "Own incision spacing", "Incision spacing of the exercise",
                setup.incision_spacing, state.document().scene.portals.incision_spacing, 1e-3, -60,
                60, "%.1f mm");
  edited.Apply();
}

void MorePanel(Ui& ui, EditorState& state) {
  EditedExercise edited(state);
  Exercise& changed = edited.changed;
  Choice(ui, edited, "Order of the steps", changed.order, {"One after the other", "Any order"});
  Needs(ui, state, edited);
  QuietText(ui, "Passes of tests that open the exercises after this one");
  double in_a_row = changed.gate.consecutive, after = changed.gate.in_total;
  edited.Note(Slider(ui, "Passes in a row", in_a_row, 0, 10, "%.0f"), "Gate");
  edited.Note(Slider(ui, "Passes after those", after, 0, 20, "%.0f"), "Gate");
  changed.gate.consecutive = static_cast<int>(std::lround(in_a_row));
  changed.gate.in_total = static_cast<int>(std::lround(after));
  QuietText(ui, "Limits that end an attempt");
  ExerciseLimits& limits = changed.limits;
  OptionalField(ui, edited, "Time is limited", "Time limit", limits.time, 180, 1, 10, 900,
                "%.0f s");
  OptionalField(ui, edited, "Force is limited", "Force limit", limits.force, 15, 1, 1, 30,
                "%.1f N");
  OptionalField(ui, edited, "Pressed area is limited", "Limit of the pressed area",
                limits.marked_area, 1e-5, 1e-6, 1, 100, "%.0f mm²");
  Zones(ui, state, edited);
  QuietText(ui, "Disturbances at the start");
  ShareFields shares{ui, edited};
  changed.setup.disturbances.Visit(shares);
  edited.Apply();
  QuietText(ui, "Picture of the exercise");
  PictureField(ui, state, -1);
}

void MoreOfStep(Ui& ui, EditorState& state, std::size_t step) {
  EditedExercise edited(state);
  ExerciseStep& changed = edited.changed.steps[step];
  StepBase& base = BaseOf(changed);
  edited.Note(
      Checkbox(ui, "May fail", base.is_optional, "The exercise can be passed without this step."),
      "Optional step");
  const Exercise& exercise = *ChosenExercise(state);
  edited.Note(NextField(ui, exercise, "After success", "The next step", base.next.done),
              "Step after success");
  edited.Note(NextField(ui, exercise, "After failure", "The end of the attempt", base.next.failed),
              "Step after failure");
  if (auto* answer = std::get_if<AnswerStep>(&changed))
    for (std::size_t i = 0; i < answer->choices.size(); ++i)
      edited.Note(NextField(ui, exercise, fmt::format("After answer {}", i + 1), "As of the step",
                            answer->choices[i].next),
                  "Step after an answer");
  edited.Apply();
  PictureField(ui, state, static_cast<int>(step));
}

}  // namespace arthro::app
