#include "app/bench/report/bench_report.h"

#include <fmt/format.h>

#include "app/about/about.h"
#include "app/plot/svg_text.h"
#include "simulation/core/atomic_file.h"

namespace arthro::app {
namespace {

constexpr const char* kStyle =
    "body{font:15px/1.45 'DejaVu Sans',sans-serif;color:#111;max-width:1160px;margin:2em auto;"
    "padding:0 1em}\n"
    "pre{font:12px/1.35 'DejaVu Sans Mono',monospace;background:#f6f6f6;padding:.8em;"
    "overflow-x:auto}\n"
    "svg{max-width:100%;height:auto;border:1px solid #ddd;margin:.8em 0}\n"
    "table{border-collapse:collapse}th,td{text-align:left;padding:.15em 1.2em .15em 0;"
    "vertical-align:top}\n"
    ".fault{color:#a00000}\n";

}  // namespace

std::string HtmlOf(const BenchReport& report) {
  std::string html = fmt::format(
      "{}<html lang=\"en\"><head><meta charset=\"utf-8\"><title>Arthroscene benchmarks</title>\n"
      "<style>\n{}</style></head>\n<body>\n<h1>Arthroscene benchmarks</h1>\n<table>\n",
      kReportHead, kStyle);
  const auto row = [&](const char* name, const std::string& text) {
    html += fmt::format("<tr><th>{}</th><td>{}</td></tr>\n", name, XmlText(text));
  };
  row("Program", std::string("arthroscene ") + app::Version());
  row("Machine and build", report.machine);
  row("System", report.system);
  row("Date", report.date);
  row("Duration", fmt::format("{:.0f} s", report.seconds));
  if (report.quick) row("Kind", "Quick: every benchmark ran, but its times mean nothing.");
  html += "</table>\n<p>";
  for (const BenchSection& section : report.sections)
    html += fmt::format("<a href=\"#{}\">{}</a>{}", section.name, XmlText(section.title),
                        &section == &report.sections.back() ? "" : " · ");
  html += "</p>\n";
  for (const BenchSection& section : report.sections) {
    html += fmt::format("<h2 id=\"{}\">{}</h2>\n", section.name, XmlText(section.title));
    if (!section.fault.empty())
      html += fmt::format("<p class=\"fault\">Not measured: {}</p>\n", XmlText(section.fault));
    for (const BenchPlot& plot : section.plots) html += plot.svg;
    if (!section.table.empty()) html += "<pre>" + XmlText(section.table) + "</pre>\n";
  }
  return html + "</body></html>\n";
}

nlohmann::json JsonOf(const BenchReport& report) {
  nlohmann::json sections = nlohmann::json::object();
  for (const BenchSection& section : report.sections)
    sections[section.name] =
        section.fault.empty() ? section.json : nlohmann::json{{"fault", section.fault}};
  return {{"schema", "arthroscene.bench.all/1"},
          {"version", app::Version()},
          {"machine", report.machine},
          {"system", report.system},
          {"date", report.date},
          {"quick", report.quick},
          {"seconds", report.seconds},
          {"benchmarks", sections}};
}

void WriteReport(const BenchReport& report, const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  for (const BenchSection& section : report.sections)
    for (const BenchPlot& plot : section.plots)
      WriteAtomically(folder / (plot.name + ".svg"), plot.svg);
  WriteAtomically(folder / "report.json", JsonOf(report).dump(2) + "\n");
  WriteAtomically(folder / "report.html", HtmlOf(report));
}

}  // namespace arthro::app
