// The instructor's page: trainees by exercises, and for a chosen pair the learning curve with the
// band of a group, CUSUM as advice, the attempts, and the gate.
#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <imgui.h>

#include "app/panels/command_button.h"
#include "app/panels/fixed_window.h"
#include "app/panels/plot.h"
#include "app/steps/lessons/instructor/cohort_board.h"
#include "app/steps/lessons/value_words.h"
#include "simulation/training/score/learning.h"

namespace arthro::app {
namespace {

constexpr float kCodeWidth = 84, kCellWidth = 72, kMostCellWidth = 200;  // px at scale 1

void Head(Ui& ui, EditorState& state, const CohortBoard& board) {
  LargeText(ui, "Trainees");
  ImGui::SameLine(0, ui.Px(24));
  ImGui::BeginChild("cohort choice", {ui.Px(240), ui.Px(54)});
  std::vector<std::string> cohorts = {"All cohorts"};
  cohorts.insert(cohorts.end(), board.cohorts.begin(), board.cohorts.end());
  const auto own = std::ranges::find(cohorts, board.choice.cohort);
  int chosen = own == cohorts.end() ? 0 : static_cast<int>(own - cohorts.begin());
  if (Combo(ui, "Cohort", chosen, cohorts))
    ChooseCohort(state, chosen == 0 ? "" : cohorts[static_cast<std::size_t>(chosen)]);
  ImGui::EndChild();
  ImGui::SameLine(0, ui.Px(12));
  ImGui::BeginChild("search", {ui.Px(200), ui.Px(54)});
  std::string search = board.search;
  if (TextField(ui, "Find", search, "part of a code")) FindTrainees(state, search);
  ImGui::EndChild();
  ImGui::SameLine(0, ui.Px(12));
  ImGui::BeginChild("robots", {ui.Px(130), ui.Px(54)});
  ImGui::SetCursorPosY(ImGui::GetCursorPosY() + ui.Px(22));
  bool has_robots = board.performers == Performers::kRobots;
  if (Checkbox(ui, "Robots", has_robots,
               "Show the attempts that `arthroscene robot` kept, instead of those of people."))
    ShowAttemptsOf(state, has_robots ? Performers::kRobots : Performers::kPeople);
  ImGui::EndChild();
  ImGui::SameLine(0, ui.Px(12));
  ImGui::BeginChild("count", {ui.Px(160), ui.Px(54)});
  ImGui::SetCursorPosY(ImGui::GetCursorPosY() + ui.Px(26));
  QuietText(ui,
            board.rows.size() == 1 ? "1 trainee" : fmt::format("{} trainees", board.rows.size()));
  ImGui::EndChild();
}

// "2/5" and below it what counts most: the gate, or else the last outcome.
void Cell(Ui& ui, EditorState& state, const CohortBoard& board, int row, int exercise) {
  const CohortCell& cell =
      board.rows[static_cast<std::size_t>(row)].cells[static_cast<std::size_t>(exercise)];
  const bool is_chosen = board.row == row && board.exercise == exercise;
  const std::string tries = cell.tries == 0 ? "–" : fmt::format("{}/{}", cell.passes, cell.tries);
  // Both lines are the cell.
  const float top = ImGui::GetCursorPosY(), line = ImGui::GetTextLineHeightWithSpacing();
  if (ListEntry(ui,
                fmt::format("{}##{} {}", tries, board.rows[static_cast<std::size_t>(row)].code,
                            exercise + 1),
                is_chosen, 0, {0, line + ImGui::GetTextLineHeight()}))
    ChooseCell(state, row, exercise);
  ImGui::SetCursorPosY(top + line);
  if (cell.is_gate_opened)
    ColouredText(ui, "opened", kWarning);
  else if (cell.is_gate_passed)
    ColouredText(ui, "gate", kGood);
  else
    QuietText(ui, cell.last);
}

// The cells share the page's width; where they would get too narrow, the table scrolls instead.
float CellWidth(const Ui& ui, float width, std::size_t cells) {
  const float between = 2 * ImGui::GetStyle().CellPadding.x + 1;
  const float room = width - ImGui::GetStyle().ScrollbarSize - ui.Px(kCodeWidth) - between;
  return std::clamp(
      std::floor(room / static_cast<float>(std::max<std::size_t>(cells, 1))) - between,
      ui.Px(kCellWidth), ui.Px(kMostCellWidth));
}

void Table(Ui& ui, EditorState& state, const CohortBoard& board, float width, float height) {
  const auto& exercises = state.document().scene.exercises;
  if (board.rows.empty())
    return QuietText(ui, board.search.empty() && board.choice.cohort.empty()
                             ? "No trainee is in these records yet; the trainee's page adds them."
                             : "No trainee of this cohort has such a code.");
  const int columns = static_cast<int>(exercises.size()) + 1;
  constexpr auto kFlags = ImGuiTableFlags_RowBg | ImGuiTableFlags_ScrollY |
                          ImGuiTableFlags_ScrollX | ImGuiTableFlags_BordersInnerV;
  if (!ImGui::BeginTable("cohort", columns, kFlags, {0, height})) return;
  ImGui::TableSetupScrollFreeze(1, 1);
  ImGui::TableSetupColumn("trainee", ImGuiTableColumnFlags_WidthFixed, ui.Px(kCodeWidth));
  const float cell = CellWidth(ui, width, exercises.size());
  for (const Exercise& exercise : exercises)
    ImGui::TableSetupColumn(exercise.id.c_str(), ImGuiTableColumnFlags_WidthFixed, cell);
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  QuietText(ui, "Trainee");
  for (std::size_t i = 0; i < exercises.size(); ++i) {
    ImGui::TableNextColumn();
    QuietText(ui, fmt::format("{}. {}", i + 1, exercises[i].title));
  }
  ImGuiListClipper shown;
  shown.Begin(static_cast<int>(board.rows.size()));
  while (shown.Step()) {
    ReadShownRows(state, shown.DisplayStart, shown.DisplayEnd);
    for (int row = shown.DisplayStart; row < shown.DisplayEnd; ++row) {
      ImGui::TableNextRow();
      ImGui::TableNextColumn();
      Text(ui, board.rows[static_cast<std::size_t>(row)].code);
      for (int i = 0; i < columns - 1; ++i) {
        ImGui::TableNextColumn();
        Cell(ui, state, board, row, i);
      }
    }
  }
  ImGui::EndTable();
}

// A value in the unit that a person reads; the plot has numbers only.
std::string TitleOf(const CohortBoard& board) {
  const auto& [metric, part] = board.metrics[static_cast<std::size_t>(board.metric)];
  return fmt::format("{}, {}", MetricWords(metric, part), ShownUnitOfMetric(metric));
}

Plot CurvePlot(const CohortBoard& board) {
  const std::string& metric = board.metrics[static_cast<std::size_t>(board.metric)].first;
  const LearningCurve& curve = board.curve;
  Plot plot;
  plot.title = TitleOf(board);
  plot.has_whole_steps = true;
  plot.left = 0.5;
  plot.right = static_cast<double>(curve.points.size()) + 0.5;
  plot.low = plot.high = 0;
  PlotCurve values, median;
  values.has_dots = true;
  values.colour = kQuiet;
  median.colour = kAccent;
  for (std::size_t i = 0; i < curve.points.size(); ++i) {
    const auto x = static_cast<float>(i + 1);
    const auto shown = [&](const std::optional<double>& value) {
      return value ? static_cast<float>(ShownValueOfMetric(metric, *value)) : kNoValue;
    };
    values.points.push_back({x, shown(curve.points[i].value)});
    median.points.push_back({x, shown(curve.median[i])});
  }
  plot.curves = {values, median};
  if (curve.band) {
    plot.bands.emplace_back(ShownValueOfMetric(metric, curve.band->first),
                            ShownValueOfMetric(metric, curve.band->second));
    plot.high = plot.bands[0].second;
  }
  FitAxes(plot);
  return plot;
}

Plot CusumPlot(const LearningCurve& curve) {
  Plot plot;
  plot.title = "CUSUM of failures";
  plot.has_whole_steps = true;
  plot.left = 0;
  plot.right = std::max(9.0, static_cast<double>(curve.cusum.size()));
  plot.low = 1.1 * simulation::CusumLowerLine();
  plot.high = 1.1 * simulation::CusumUpperLine();
  plot.limits = {simulation::CusumLowerLine(), simulation::CusumUpperLine()};
  PlotCurve sum;
  sum.has_dots = true;
  sum.points.push_back({0, 0});
  for (std::size_t i = 0; i < curve.cusum.size(); ++i)
    sum.points.push_back({static_cast<float>(i + 1), static_cast<float>(curve.cusum[i])});
  plot.curves = {sum};
  FitAxes(plot);
  return plot;
}

// Choice of the reference group whose band is drawn.
void Band(Ui& ui, EditorState& state, const CohortBoard& board) {
  std::vector<std::string> groups = {"No band"};
  groups.insert(groups.end(), board.groups.begin(), board.groups.end());
  int chosen = 0;
  if (board.choice.has_band && groups.size() > 1) {
    const auto own = std::ranges::find(groups, board.choice.group);
    chosen = board.choice.group.empty() ? 1
             : own == groups.end()      ? -1
                                        : static_cast<int>(own - groups.begin());
  }
  if (Combo(ui, "Band", chosen, groups, "The reference group whose middle half is drawn."))
    ChooseGroup(state, chosen == 0 ? "" : groups[static_cast<std::size_t>(chosen)]);
}

std::string BandWords(const CohortBoard& board) {
  if (!board.curve.band_words.empty())
    return fmt::format("Dots: attempts. Line: median of three. Band: middle half of {}.",
                       board.curve.band_words);
  if (board.groups.empty())
    return "Dots: attempts. Line: median of three. There is no reference group.";
  return "Dots: attempts. Line: median of three.";
}

void Curves(Ui& ui, EditorState& state, const CohortBoard& board, float width, float height) {
  std::vector<std::string> words;
  for (const auto& [metric, part] : board.metrics) words.push_back(MetricWords(metric, part));
  int chosen = board.metric;
  ImGui::BeginChild("metric choice", {ui.Px(260), ui.Px(54)});
  if (Combo(ui, "Metric", chosen, words)) ChooseMetric(state, chosen);
  ImGui::EndChild();
  ImGui::SameLine(0, ui.Px(12));
  ImGui::BeginChild("group choice", {ui.Px(220), ui.Px(54)});
  Band(ui, state, board);
  ImGui::EndChild();
  QuietText(ui, BandWords(board));
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const float rest = height - (corner.y - ImGui::GetWindowPos().y) - ui.Px(34);
  const float half = (width - ui.Px(8)) / 2;
  DrawPlot(ui, CurvePlot(board), {corner.x, corner.y, half, rest});
  DrawPlot(ui, CusumPlot(board.curve), {corner.x + half + ui.Px(8), corner.y, half, rest});
  ImGui::SetCursorScreenPos({corner.x, corner.y + rest + ui.Px(6)});
  Text(ui, board.curve.advice);
}

void Attempts(Ui& ui, EditorState& state, const CohortBoard& board, float height) {
  Heading(ui, "Attempts");
  std::string opened;
  ImGui::BeginChild("attempts", {0, height});
  for (std::size_t i = 0; i < board.curve.points.size(); ++i) {
    const AttemptPoint& point = board.curve.points[board.curve.points.size() - 1 - i];
    if (ListEntry(ui,
                  fmt::format("{}  {}  {}##{}", TimeWords(point.started),
                              simulation::ToString(point.outcome), ToString(point.mode), point.id),
                  false))
      opened = point.id;
  }
  if (board.curve.points.empty()) QuietText(ui, "No attempt yet.");
  ImGui::EndChild();
  CommandButton(ui, state, "rate-blinded", {-FLT_MIN, ui.Px(36)});
  if (!opened.empty()) Guarded(state, "Attempt", [&] { ShowStoredAttempt(state, opened); });
}

void Gate(Ui& ui, EditorState& state, CohortBoard& board) {
  Heading(ui, "Gate");
  ReadShownRows(state, board.row, board.row + 1);
  const CohortCell& cell = board.rows[static_cast<std::size_t>(board.row)]
                               .cells[static_cast<std::size_t>(board.exercise)];
  if (cell.is_gate_opened) return ColouredText(ui, "Opened by an instructor.", kWarning);
  TextField(ui, "Instructor's code", board.who, "for example I-2");
  TextField(ui, "Reason", board.reason, "kept in the audit");
  CommandButton(ui, state, "open-gate", {-FLT_MIN, ui.Px(36)});
}

}  // namespace

void InstructorPage(Ui& ui, EditorState& state) {
  CohortBoard& board = FreshCohortBoard(state);
  const ImVec2 room = ImGui::GetContentRegionAvail();
  const float foot = ui.Px(54), side = ui.Px(330);
  Head(ui, state, board);
  if (!board.fault.empty()) ColouredText(ui, board.fault, kWarning);
  const float top = ImGui::GetCursorPosY();
  const bool has_choice = board.row >= 0 && board.exercise >= 0 && !board.metrics.empty();
  // In a low window the page scrolls as a whole, and not its parts.
  const float below = has_choice ? std::max(ui.Px(350), 0.46f * room.y) : 0;
  Table(ui, state, board, room.x, std::max(ui.Px(170), room.y - top - foot - below - ui.Px(16)));
  if (has_choice) {
    const float curves = room.x - side - ui.Px(16);
    ImGui::BeginChild("curves", {curves, below});
    Heading(ui,
            fmt::format(
                "{} – {}", board.rows[static_cast<std::size_t>(board.row)].code,
                state.document().scene.exercises[static_cast<std::size_t>(board.exercise)].title));
    Curves(ui, state, board, curves, below);
    ImGui::EndChild();
    ImGui::SameLine(0, ui.Px(16));
    ImGui::BeginChild("cell", {0, below});
    Attempts(ui, state, board, std::max(ui.Px(60), below - ui.Px(276)));
    Gate(ui, state, board);
    ImGui::EndChild();
  } else if (!board.rows.empty()) {
    QuietText(ui, "Choose a trainee's cell to see the learning curve and the attempts.");
  }
  ImGui::SetCursorPosY(std::max(ImGui::GetCursorPosY(), room.y - ui.Px(40)));
  CommandButton(ui, state, "attempt-table", {ui.Px(150), ui.Px(44)});
  ImGui::SameLine();
  CommandButton(ui, state, "open-attempt", {ui.Px(170), ui.Px(44)});
  ImGui::SameLine();
  CommandButton(ui, state, "trainee-page", {ui.Px(170), ui.Px(44)});
  ImGui::SameLine();
  CommandButton(ui, state, "close-lesson", {ui.Px(120), ui.Px(44)});
}

}  // namespace arthro::app
