// Criteria of the exercise that is edited: what is measured, in which tool, within which limits, in
// the units of a reader, and where the limit comes from.
#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <imgui.h>

#include "app/panels/options_panel.h"
#include "app/state/edits.h"
#include "app/steps/lessons/author/author_fields.h"
#include "app/steps/lessons/value_words.h"
#include "simulation/training/metrics/metric_words.h"
#include "simulation/training/metrics/metrics.h"

namespace arthro::app {
namespace {

// Choice of the metric; another one begins with limits of its own.
bool MetricField(Ui& ui, Criterion& criterion) {
  std::vector<std::string> words;
  int metric = -1;
  for (const simulation::Metric& known : simulation::EveryMetric()) {
    if (known.id == criterion.metric) metric = static_cast<int>(words.size());
    words.emplace_back(known.name);
  }
  const std::string help = metric < 0 ? "" : MetricHelp(criterion.metric);
  const bool is_changed = Combo(ui, "Metric", metric, words);
  if (is_changed)
    criterion =
        StartCriterion(std::string(simulation::EveryMetric()[static_cast<std::size_t>(metric)].id));
  if (!help.empty()) QuietText(ui, help);
  return is_changed;
}

// The tool where a metric is measured in several.
bool PartField(Ui& ui, Criterion& criterion) {
  std::vector<std::string> parts = simulation::PartsOf(criterion.metric);
  if (parts.empty())
    return TextField(ui, "Part", criterion.part, "for example: instrument on medial meniscus");
  if (parts.size() == 1 && (criterion.part.empty() || criterion.part == parts.front()))
    return false;
  auto own = std::ranges::find(parts, criterion.part);
  int chosen = own == parts.end() ? -1 : static_cast<int>(own - parts.begin());
  if (!Combo(ui, "Tool", chosen, parts)) return false;
  criterion.part = parts[static_cast<std::size_t>(chosen)];
  return true;
}

Change LimitField(Ui& ui, const std::string& metric, const char* name,
                  std::optional<double>& limit) {
  if (!limit) return {};
  const std::string unit = ShownUnitOfMetric(metric);
  const double factor = ShownValueOfMetric(metric, 1);
  double shown = *limit * factor;
  QuietText(ui, name);
  ImGui::SetNextItemWidth(-FLT_MIN);
  const Change change = NumberField(ui, name, shown, 0.1, -1e9, 1e9,
                                    unit.empty() ? "%.6g" : ("%.6g " + unit).c_str());
  if (change) limit = shown / factor;
  return change;
}

void LimitFields(Ui& ui, EditedExercise& edited, Criterion& criterion) {
  int kind = criterion.min && criterion.max ? 2 : criterion.min ? 1 : 0;
  if (Combo(ui, "Limit", kind, {"at most", "at least", "between"})) {
    const double value = criterion.max.value_or(criterion.min.value_or(0));
    criterion.max = kind == 1 ? std::optional<double>() : value;
    criterion.min =
        kind == 0 ? std::optional<double>() : criterion.min.value_or(kind == 2 ? 0 : value);
    if (!criterion.max) criterion.max_from.reset();
    edited.Note(true, "Limit of the criterion");
  }
  edited.Note(LimitField(ui, criterion.metric, "At least", criterion.min), "Criterion");
  edited.Note(LimitField(ui, criterion.metric, "At most", criterion.max), "Criterion");
}

// A reference group, whose results set the upper limit once it is large enough.
void GroupFields(Ui& ui, EditedExercise& edited, Criterion& criterion) {
  if (!criterion.max) return;
  std::string group = criterion.max_from ? criterion.max_from->group : "";
  if (TextField(ui, "Limit from the group", group, "none; for example: experts")) {
    if (group.empty())
      criterion.max_from.reset();
    else if (criterion.max_from)
      criterion.max_from->group = group;
    else
      criterion.max_from = GroupLimit{group};
    edited.Note(true, "Group of the criterion");
  }
  if (!criterion.max_from) return;
  QuietText(ui,
            "Its mean and so many standard deviations; until it has five results, the limit "
            "above.");
  edited.Note(Slider(ui, "Standard deviations", criterion.max_from->plus_sd, -3, 3, "%.1f"),
              "Group of the criterion");
}

}  // namespace

void CriteriaPanel(Ui& ui, EditorState& state) {
  LessonsStep& step = *state.steps.lessons;
  if (Button(ui, "Add a criterion", true, {-FLT_MIN, 0})) AddCriterion(state);
  const auto& criteria = ChosenExercise(state)->criteria;
  for (std::size_t i = 0; i < criteria.size(); ++i)
    if (ListEntry(
            ui,
            fmt::format("{} {}##criterion{}", MetricWords(criteria[i].metric, criteria[i].part),
                        LimitsOfMetric(criteria[i].metric, {criteria[i].min, criteria[i].max}), i),
            static_cast<int>(i) == step.criterion))
      step.criterion = static_cast<int>(i);
  const Exercise& now = *ChosenExercise(state);
  if (step.criterion < 0 || step.criterion >= static_cast<int>(now.criteria.size())) return;
  const auto chosen = static_cast<std::size_t>(step.criterion);
  EditedExercise edited(state);
  Criterion& changed = edited.changed.criteria[chosen];
  edited.Note(MetricField(ui, changed), "Metric of the criterion");
  edited.Note(PartField(ui, changed), "Tool of the criterion");
  LimitFields(ui, edited, changed);
  GroupFields(ui, edited, changed);
  edited.Note(TextField(ui, "Source of the limit", changed.source, "publication or person"),
              "Source of the limit");
  edited.Apply();
  if (Button(ui, "Remove criterion", true, {-FLT_MIN, 0})) {
    EditExercise(state, "Remove criterion", "", [&](Exercise& e) {
      e.criteria.erase(e.criteria.begin() + static_cast<std::ptrdiff_t>(chosen));
    });
    step.criterion = -1;
  }
}

}  // namespace arthro::app
