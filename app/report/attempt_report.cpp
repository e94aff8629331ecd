#include "app/report/attempt_report.h"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

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
  row("Exercise",
      fmt::format("{} (version {})",
                  report.exercise.title.empty() ? report.exercise.id : report.exercise.title,
                  report.exercise.version));
  row("Goal", report.goal);
  row("Scene", attempt.scene);
  row("Mode", AttemptModes().words[static_cast<std::size_t>(attempt.mode)].second);
  row("Begin", attempt.started);
  row("Duration", attempt.duration ? ValueWords(attempt.duration, "s") + ", without pauses" : "");
  row("Station",
      report.rig.empty() ? report.station : fmt::format("{}, {}", report.station, report.rig));
  return html + "</tbody></table>\n";
}

std::string CriteriaOf(const AttemptRecord& attempt) {
  if (attempt.criteria.empty()) return "<p>This exercise has no criteria.</p>\n";
  std::vector<Cells> rows;
  for (const CriterionRow& criterion : attempt.criteria) {
    const std::string unit = UnitOf(attempt, criterion.metric, criterion.part);
    rows.push_back({MetricWords(criterion.metric, criterion.part),
                    ValueWords(criterion.value, unit), LimitWords(criterion, unit),
                    criterion.passed  ? "✓ met"
                    : criterion.value ? "✗ not met"
                                      : "✗ not measured, so not met",
                    criterion.source});
  }
  return Table({"Criterion", "Value", "Limit", "Result", "Source of the limit"}, rows);
}

std::string MetricsOf(const AttemptRecord& attempt) {
  std::vector<Cells> rows;
  for (const MetricRow& metric : attempt.metrics)
    rows.push_back({MetricWords(metric.name, metric.part), ValueWords(metric.value, metric.unit),
                    metric.why_none});
  return Table({"Metric", "Value", "Reason for a missing value"}, rows);
}

std::string EventsOf(const AttemptRecord& attempt) {
  std::vector<Cells> rows;
  for (const EventRow& event : attempt.events) {
    std::string words = event.kind;
    std::replace(words.begin(), words.end(), '_', ' ');
    // Forces are the one value that a reader knows without its unit.
    const bool is_force = event.kind == "force_over" || event.kind == "probed";
    rows.push_back({fmt::format("{:.2f} s", event.t), words, event.step, event.target,
                    is_force ? ValueWords(event.value, "N") : "", event.note});
  }
  return Table({"Time", "Event", "Step", "Target", "Force", "Note"}, rows);
}

}  // namespace

std::string AttemptPage(const AttemptReport& report) {
  const AttemptRecord& attempt = report.attempt;
  std::string html = fmt::format(
      "{}<html lang=\"en\"><head><meta charset=\"utf-8\"><title>{} – {}</title>\n"
      "<style>\n{}</style></head>\n<body>\n<h1>Report of an attempt</h1>\n",
      kAttemptPageHead, XmlText(report.exercise.id), XmlText(report.trainee), kStyle);
  html += HeadOf(report);
  html += fmt::format("<p class=\"outcome\">{}</p>\n", XmlText(OutcomeWords(attempt)));
  html += Heading("Criteria") + CriteriaOf(attempt);
  if (const std::string steps = StepsSvg(report); !steps.empty()) html += Heading("Steps") + steps;
  if (!report.frames.empty()) {
    html += Heading("Force") + ForceSvg(report);
    if (!report.targets.empty()) html += Heading("Centring") + CentringSvg(report);
    html += Heading("Paths") + PathSvg(report, false) + PathSvg(report, true);
  }
  if (!attempt.metrics.empty()) html += Heading("Metrics") + MetricsOf(attempt);
  if (!attempt.events.empty()) html += Heading("Events") + EventsOf(attempt);
  html += fmt::format(
      "<p class=\"small\">{}. Metrics of version {}. Attempt {}. Exercise {}. Forces are those of "
      "the simulation. The limits come from the sources that stand beside them; the numbers do not "
      "show that somebody can operate.</p>\n",
      XmlText(report.program), attempt.metrics_version, XmlText(attempt.id),
      XmlText(report.exercise.hash));
  return html + "</body></html>\n";
}

std::string AttemptJson(const AttemptReport& report) {
  const AttemptRecord& attempt = report.attempt;
  using Json = nlohmann::ordered_json;
  const auto number = [](const std::optional<double>& value) {
    return value ? Json(*value) : Json();
  };
  Json json;
  json["schema"] = "arthroscene.assessment/1";
  json["attempt"] = attempt.id;
  json["trainee"] = report.trainee;
  json["exercise"] = {{"id", report.exercise.id},
                      {"version", report.exercise.version},
                      {"hash", report.exercise.hash},
                      {"title", report.exercise.title}};
  json["scene"] = attempt.scene;
  json["mode"] = AttemptModes().words[static_cast<std::size_t>(attempt.mode)].second;
  json["started"] = attempt.started;
  json["outcome"] = simulation::ToString(attempt.outcome);
  json["reason"] = attempt.reason;
  json["duration"] = number(attempt.duration);
  json["frames"] = report.frames.size();
  json["metrics_version"] = attempt.metrics_version;
  for (const char* list : {"criteria", "steps", "metrics", "events"}) json[list] = Json::array();
  for (const CriterionRow& row : attempt.criteria)
    json["criteria"].push_back({{"metric", row.metric},
                                {"part", row.part},
                                {"min", number(row.low)},
                                {"max", number(row.high)},
                                {"value", number(row.value)},
                                {"unit", UnitOf(attempt, row.metric, row.part)},
                                {"met", row.passed},
                                {"source", row.source}});
  for (const StepRow& row : attempt.steps)
    json["steps"].push_back({{"step", row.step},
                             {"began", row.began},
                             {"ended", number(row.ended)},
                             {"outcome", row.outcome}});
  for (const MetricRow& row : attempt.metrics) {
    Json& entry = json["metrics"].emplace_back();
    entry = {
        {"metric", row.name}, {"part", row.part}, {"value", number(row.value)}, {"unit", row.unit}};
    if (!row.value) entry["why_none"] = row.why_none;
  }
  for (const EventRow& row : attempt.events)
    json["events"].push_back({{"t", row.t},
                              {"kind", row.kind},
                              {"step", row.step},
                              {"target", row.target},
                              {"value", number(row.value)},
                              {"note", row.note}});
  return json.dump(2) + "\n";
}

std::string MetricTable(const AttemptReport& report) {
  std::string text = fmt::format("{}unit,min,max,met,source,why_none\n", kMetricTableHead);
  for (const MetricRow& row : report.attempt.metrics) {
    const auto& criteria = report.attempt.criteria;
    const auto own = std::find_if(criteria.begin(), criteria.end(), [&](const auto& criterion) {
      return criterion.metric == row.name && criterion.part == row.part;
    });
    const auto number = [](const std::optional<double>& value) {
      return value ? fmt::format("{}", *value) : std::string();
    };
    const bool has_criterion = own != criteria.end();
    text += fmt::format(
        "{},{},{},{},{},{},{},{},{}\n", CsvField(row.name), CsvField(row.part), number(row.value),
        CsvField(row.unit), has_criterion ? number(own->low) : "",
        has_criterion ? number(own->high) : "", has_criterion ? (own->passed ? "1" : "0") : "",
        has_criterion ? CsvField(own->source) : "", CsvField(row.why_none));
  }
  return text;
}

}  // namespace arthro::app
