#include "app/bench/report/bench_report.h"

#include <filesystem>

#include <gtest/gtest.h>

#include "simulation/core/atomic_file.h"
#include "tests/support/temp_folder.h"

namespace arthro::app {
namespace {

BenchReport TwoSections() {
  BenchReport report;
  report.machine = "machine <1>";
  BenchSection measured{"view", "Arthroscopic view", "a table\n", "", {{"rows", 3}}, {}};
  measured.plots.push_back({"view", "<svg>a plot</svg>\n"});
  report.sections = {measured, {"panorama", "Registration", "", "no renderer", {}, {}}};
  return report;
}

TEST(BenchReport, PageHoldsEveryTableAndPlotAndNeedsNoOtherFile) {
  const std::string html = HtmlOf(TwoSections());
  EXPECT_TRUE(html.starts_with(kReportHead));
  for (const char* part :
       {"a table\n", "<svg>a plot</svg>", "machine &lt;1&gt;", "Not measured: no renderer"})
    EXPECT_NE(html.find(part), std::string::npos) << part;
  for (const char* other : {"src=", "url(", "http://", "https://"})
    EXPECT_EQ(html.find(other), std::string::npos) << other;
}

TEST(BenchReport, JsonHoldsEachBenchmarkOrWhyItIsMissing) {
  const auto json = JsonOf(TwoSections());
  EXPECT_EQ(json.at("schema"), "arthroscene.bench.all/1");
  EXPECT_EQ(json.at("benchmarks").at("view").at("rows"), 3);
  EXPECT_EQ(json.at("benchmarks").at("panorama").at("fault"), "no renderer");
}

TEST(BenchReport, IsWrittenWithItsPlotsIntoANewFolder) {
  test::TempFolder folder;
  WriteReport(TwoSections(), folder / "new");
  EXPECT_EQ(ReadWholeFile(folder / "new/view.svg"), "<svg>a plot</svg>\n");
  EXPECT_TRUE(std::filesystem::exists(folder / "new/report.html"));
  EXPECT_TRUE(std::filesystem::exists(folder / "new/report.json"));
  EXPECT_FALSE(std::filesystem::exists(folder / "new/panorama.svg"));
}

}  // namespace
}  // namespace arthro::app
