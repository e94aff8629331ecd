// One report over all benchmarks: an HTML page that needs no other file, the same as JSON, and each
// plot as SVG.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "simulation/core/options.h"
#include "simulation/core/progress.h"

namespace arthro::app {

struct BenchAllOptions {
  bool quick = false;
  template <class V>
  void Visit(V&& v) {
    v("quick", quick, Any{}, "",
      "Small inputs and few samples, done in less than 3 minutes: shows that every benchmark "
      "runs, not how fast.");
  }
};

struct BenchPlot {
  std::string name;  // file name without .svg
  std::string svg;
};

// One benchmark: its table, JSON and plots, or why there are none.
struct BenchSection {
  std::string name;   // "panorama"
  std::string title;  // "Registration of video frames"
  std::string table, fault;
  nlohmann::json json;
  std::vector<BenchPlot> plots;
};

struct BenchReport {
  std::string machine, system, date;  // date in UTC
  bool quick = false;
  double seconds = 0;  // wall clock of all sections
  std::vector<BenchSection> sections;
};

// Runs every benchmark. One that this machine cannot run, such as a picture without a renderer, is
// a section with the reason.
BenchReport RunEveryBench(const BenchAllOptions& options, const Progress& progress);

// First characters of an HTML report: a job replaces no other page.
inline constexpr const char* kReportHead = "<!doctype html>\n<!-- arthroscene bench all -->\n";
std::string HtmlOf(const BenchReport& report);
nlohmann::json JsonOf(const BenchReport& report);

// Writes report.html, report.json and the plots; makes the folder.
void WriteReport(const BenchReport& report, const std::filesystem::path& folder);

}  // namespace arthro::app
