#include "app/report/attempt_report.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "app/plot/svg_text.h"
#include "app/report/attempt_plots.h"
#include "app/report/attempt_words.h"
#include "simulation/core/csv_field.h"

namespace arthro::app {
namespace {

constexpr const char* kStyle =
    "@page{size:A4;margin:14mm}\n"
    "body{font:14px/1.4 'DejaVu Sans',sans-serif;color:#111;max-width:740px;margin:1.5em auto;"
    "padding:0 1em}\n"
    "h1{font-size:20px;margin:0 0 .2em}h2{font-size:15px;margin:1.3em 0 .4em;"
    "page-break-after:avoid}\n"
    "table{border-collapse:collapse;width:100%;font-size:12px}th,td{text-align:left;"
    "padding:.22em .8em .22em 0;vertical-align:top;border-bottom:1px solid #ddd}\n"
    "tr{page-break-inside:avoid}td.number{white-space:nowrap}\n"
    "svg{max-width:100%;height:auto;page-break-inside:avoid}\n"
    ".outcome{border:1.5px solid #222;padding:.5em .8em;margin:.8em 0;font-weight:bold}\n"
    // Figures break between pages as words do.
    ".pictures{orphans:1;widows:1}"
    "figure{display:inline-block;vertical-align:top;margin:0 1.2% .6em 0;width:31.5%;"
    "page-break-inside:avoid}\n"
    "figure img{width:100%;display:block;box-sizing:border-box;background:#000}"
    "figcaption{font-size:11px;padding:.2em 0}.fault img{border:3px solid #a00000}\n"
    ".criteria td:nth-child(-n+4){white-space:nowrap}\n"
    ".missed{font-weight:bold}.small{font-size:11px;color:#444}\n"
    "@media print{body{margin:0;padding:0;max-width:none}}\n";

using Cells = std::vector<std::string>;

// The cells are texts; every value is escaped here.
std::string Table(const Cells& head, const std::vector<Cells>& rows) {
  std::string html = "<table><thead><tr>";
  for (const std::string& cell : head) html += "<th>" + XmlText(cell) + "</th>";
  html += "</tr></thead><tbody>\n";
  for (const Cells& row : rows) {
    html += "<tr>";
    for (const std::string& cell : row) html += "<td>" + XmlText(cell) + "</td>";
    html += "</tr>\n";
  }
  return html + "</tbody></table>\n";
}

std::string Heading(const char* words) { return fmt::format("<h2>{}</h2>\n", words); }

std::string HeadOf(const AttemptReport& report) {
  const AttemptRecord& attempt = report.attempt;
  std::string html = "<table><tbody>\n";
  const auto row = [&](const char* name, const std::string& text) {
    if (!text.empty())
      html += fmt::format("<tr><th>{}</th><td>{}</td></tr>\n", name, XmlText(text));
  };
  row("Trainee", report.trainee);
  if (HasExercise(report))
    row("Exercise",
        fmt::format("{} (version {})",
                    report.exercise.title.empty() ? report.exercise.id : report.exercise.title,
                    report.exercise.version));
  row("Goal", report.goal);
  row("Scene", attempt.scene);
  if (report.is_mode_known) row("Mode", ToString(attempt.mode));
  // A robot begins at the epoch, so that it leaves the same bytes.
  row("Begin", attempt.started.empty() || attempt.mode == AttemptMode::kRobot
                   ? ""
                   : TimeWords(attempt.started) + " UTC");
  row("Duration", attempt.duration ? ValueWords(attempt.duration, "s") + ", without pauses" : "");
  row("Station", report.station);
  row("Devices", report.rig);
  row("Compared with", report.group);
  return html + "</tbody></table>\n";
}

// Place among the members of a group: "5.2 to 8.1 N (n = 6), z = +0.4".
std::string GroupWords(const AttemptReport& report, const std::string& metric,
                       const std::string& part, const std::string& unit) {
  const GroupStanding* standing = StandingIn(report, metric, part);
  if (standing == nullptr || standing->n == 0) return "";
  std::string words = fmt::format("{} to {} (n = {})", ValueWords(standing->q1, unit),
                                  ValueWords(standing->q3, unit), standing->n);
  if (standing->z) words += fmt::format(", z = {:+.1f}", *standing->z);
  return words;
}

// Value of the expert; empty where the expert has none.
std::string ExpertWords(const AttemptReport& report, const std::string& metric,
                        const std::string& part, const std::string& unit) {
  for (const MetricRow& row : report.expert)
    if (row.name == metric && row.part == part && row.value) return ValueWords(row.value, unit);
  return "";
}

// Puts what others reached behind the value: the group and the expert have a column each where
// there are such.
void AddOthers(const AttemptReport& report, Cells& cells, const std::string& group,
               const std::string& expert) {
  auto at = cells.begin() + 2;
  if (!report.group.empty()) at = cells.insert(at, group) + 1;
  if (!report.expert.empty()) cells.insert(at, expert);
}

Cells Head(const AttemptReport& report, Cells cells) {
  AddOthers(report, cells, fmt::format("Middle half of {}", report.group), "Expert");
  return cells;
}

std::string CriteriaOf(const AttemptReport& report) {
  const AttemptRecord& attempt = report.attempt;
  if (attempt.criteria.empty()) return "<p>This exercise has no criteria.</p>\n";
  std::vector<Cells> rows;
  for (const CriterionRow& criterion : attempt.criteria) {
    const std::string unit = UnitOf(attempt, criterion.metric, criterion.part);
    rows.push_back({MetricWords(criterion.metric, criterion.part),
                    ValueWords(criterion.value, unit, LimitsOf(criterion)),
                    LimitWords(LimitsOf(criterion), unit),
                    criterion.passed  ? "✓ met"
                    : criterion.value ? "✗ not met"
                                      : "✗ not measured, so not met",
                    criterion.source});
    AddOthers(report, rows.back(), GroupWords(report, criterion.metric, criterion.part, unit),
              ExpertWords(report, criterion.metric, criterion.part, unit));
  }
  return "<div class=\"criteria\">" +
         Table(Head(report, {"Criterion", "Value", "Limit", "Result", "Source of the limit"}),
               rows) +
         "</div>\n";
}

std::string Joined(const std::vector<std::string>& words) {
  return XmlText(fmt::format("{}", fmt::join(words, "; ")));
}

// A row for each metric that has a value or one of others to compare with. The rest are named:
// those that are zero, and those that were not measured, by the reason.
std::string MetricsOf(const AttemptReport& report) {
  std::vector<Cells> rows;
  std::vector<std::string> zeros;
  std::vector<std::pair<std::string, std::vector<std::string>>> missing;
  for (const MetricRow& metric : report.attempt.metrics) {
    const std::string words = MetricWords(metric.name, metric.part),
                      group = GroupWords(report, metric.name, metric.part, metric.unit),
                      expert = ExpertWords(report, metric.name, metric.part, metric.unit);
    if (group.empty() && expert.empty() && !metric.value) {
      auto reason =
          std::ranges::find(missing, metric.why_none, [](const auto& m) { return m.first; });
      if (reason == missing.end()) reason = missing.insert(reason, {metric.why_none, {}});
      reason->second.push_back(words);
    } else if (group.empty() && expert.empty() && *metric.value == 0.0) {
      zeros.push_back(words);
    } else {
      const std::string value = ValueWords(metric.value, metric.unit);
      rows.push_back({words, metric.value ? value : value + ": " + metric.why_none});
      AddOthers(report, rows.back(), group, expert);
    }
  }
  std::string html;
  if (!rows.empty()) html += Table(Head(report, {"Metric", "Value"}), rows);
  if (!zeros.empty()) html += fmt::format("<p class=\"small\">Zero: {}.</p>\n", Joined(zeros));
  for (const auto& [reason, names] : missing)
    html += fmt::format("<p class=\"small\">Not measured{}: {}.</p>\n",
                        reason.empty() ? "" : " (" + XmlText(reason) + ")", Joined(names));
  return html;
}

std::string EventsOf(const AttemptReport& report) {
  std::vector<Cells> rows;
  for (const EventRow& event : report.attempt.events) {
    // Forces are the one value that a reader knows without its unit.
    const bool is_force = event.kind == "force_over" || event.kind == "probed";
    rows.push_back({fmt::format("{:.2f} s", event.t), EventWords(event.kind),
                    StepNumber(report.steps, event.step), event.target,
                    is_force ? ValueWords(event.value, "N") : "", event.note});
  }
  return Table({"Time", "Event", "Step", "Target", "Force", "Note"}, rows);
}

}  // namespace

const GroupStanding* StandingIn(const AttemptReport& report, const std::string& metric,
                                const std::string& part) {
  for (const GroupStanding& standing : report.standings)
    if (standing.metric == metric && standing.part == part) return &standing;
  return nullptr;
}

std::string AttemptPage(const AttemptReport& report) {
  const AttemptRecord& attempt = report.attempt;
  std::string html = fmt::format(
      "{}<html lang=\"en\"><head><meta charset=\"utf-8\"><title>{} – {}</title>\n"
      "<style>\n{}</style></head>\n<body>\n<h1>Report of an attempt</h1>\n",
      kAttemptPageHead, XmlText(HasExercise(report) ? report.exercise.id : "Recorded hands"),
      XmlText(report.trainee.empty() ? attempt.scene : report.trainee), kStyle);
  html += HeadOf(report);
  if (HasExercise(report)) {
    html += fmt::format("<p class=\"outcome\">{}</p>\n", XmlText(OutcomeWords(attempt)));
    html += Heading("Criteria") + CriteriaOf(report);
  }
  if (const std::string steps = StepsSvg(report); !steps.empty()) html += Heading("Steps") + steps;
  if (!report.pictures.empty())
    html += Heading("Pictures of the scope") + PicturesHtml(report.pictures, !report.track.empty());
  if (!report.frames.empty()) {
    html += Heading("Force") + ForceSvg(report);
    if (!report.targets.empty()) html += Heading("Centring") + CentringSvg(report);
    html += Heading("Paths") + PathSvg(report, false) + PathSvg(report, true);
  }
  if (!attempt.metrics.empty()) html += Heading("Metrics") + MetricsOf(report);
  if (!attempt.events.empty()) html += Heading("Events") + EventsOf(report);
  html += fmt::format("<p class=\"small\">{}. Metrics of version {}.", XmlText(report.program),
                      attempt.metrics_version);
  if (!attempt.id.empty()) html += fmt::format(" Attempt {}.", XmlText(attempt.id));
  if (HasExercise(report)) html += fmt::format(" Exercise {}.", XmlText(report.exercise.hash));
  if (!report.group.empty())
    html +=
        " z counts standard deviations from the mean of the group, of logarithms for times, paths "
        "and areas; positive is better.";
  html +=
      " Forces are those of the simulation. The limits come from the sources that stand beside "
      "them; the numbers do not show that somebody can operate.</p>\n";
  return html + "</body></html>\n";
}

std::string MetricTable(const AttemptReport& report) {
  std::string text = fmt::format("{}unit,better,min,max,met,source,z,why_none\n", kMetricTableHead);
  for (const MetricRow& row : report.attempt.metrics) {
    const auto& criteria = report.attempt.criteria;
    const auto own = std::find_if(criteria.begin(), criteria.end(), [&](const auto& criterion) {
      return criterion.metric == row.name && criterion.part == row.part;
    });
    const auto number = [](const std::optional<double>& value) {
      return value ? fmt::format("{}", *value) : std::string();
    };
    const bool has_criterion = own != criteria.end();
    const GroupStanding* standing = StandingIn(report, row.name, row.part);
    text += fmt::format(
        "{},{},{},{},{},{},{},{},{},{},{}\n", CsvField(row.name), CsvField(row.part),
        number(row.value), CsvField(row.unit), BetterWord(row.name),
        has_criterion ? number(own->low) : "", has_criterion ? number(own->high) : "",
        has_criterion ? (own->passed ? "1" : "0") : "", has_criterion ? CsvField(own->source) : "",
        standing != nullptr ? number(standing->z) : "", CsvField(row.why_none));
  }
  return text;
}

}  // namespace arthro::app
