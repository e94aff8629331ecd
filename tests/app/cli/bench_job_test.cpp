// Claims about the benchmark of the registration, run as a user runs it, on clips small enough.
#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "simulation/core/atomic_file.h"
#include "tests/support/run_program.h"

namespace arthro {
namespace {

TEST(BenchJob, HoldsEveryChainAgainstTruthAndThePeer) {
  test::TempFolder folder;
  const std::string json = (folder / "b.json").string(), plot = (folder / "b.svg").string();
  const auto result =
      test::RunProgram("bench panorama --frames 3 --width 200 --height 160 --peer-limit 5 --json " +
                       json + " --plot " + plot);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("cv::Stitcher"), std::string::npos);
  const auto bench = nlohmann::json::parse(ReadWholeFile(json));
  EXPECT_EQ(bench.at("schema"), "arthroscene.bench.panorama/1");
  std::set<std::string> clips, chains;
  for (const auto& row : bench.at("rows")) {
    clips.insert(row.at("clip"));
    chains.insert(row.at("chain"));
    EXPECT_EQ(row.at("frames"), 3);
    EXPECT_LE(row.at("right"), row.at("placed"));
    EXPECT_FALSE(row.at("outcome").get<std::string>().empty());
    EXPECT_GT(row.at("cpu_ms_per_frame"), 0.0);
    // Nothing right: there is no error to tell, rather than one of 0.
    EXPECT_EQ(row.at("mean_px").is_null(), row.at("right") == 0) << row;
  }
  EXPECT_EQ(clips, (std::set<std::string>{"easy", "hard", "medium"}));
  for (const char* chain : {"SURF 1/2 all", "SURF 1/2 loops", "SURF 1/2 pairs", "SURF 1/4 all",
                            "SIFT 1/2 all", "AKAZE 1/2 all", "ORB 1/2 all", "SURF 1/2 alone",
                            "direct 1/2 all", "cv::Stitcher scans", "cv::Stitcher panorama"})
    EXPECT_TRUE(chains.contains(chain)) << chain;
  const std::string svg = ReadWholeFile(plot);
  EXPECT_TRUE(svg.starts_with("<svg"));
  EXPECT_EQ(svg.find("nan"), std::string::npos);
}

TEST(BenchJob, HoldsTissueAgainstTheContinuum) {
  test::TempFolder folder;
  const std::string json = (folder / "t.json").string(), plot = (folder / "t.svg").string();
  const auto result =
      test::RunProgram("bench tissue --only meniscus_load --max-elements 200 --frames 9 --json " +
                       json + " --plot " + plot);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("mesh budget"), std::string::npos);
  const auto bench = nlohmann::json::parse(ReadWholeFile(json));
  EXPECT_EQ(bench.at("schema"), "arthroscene.bench.tissue/1");
  std::set<std::string> courses, laws;
  double error = 1;
  for (const auto& row : bench.at("rows")) {
    courses.insert(row.at("course"));
    laws.insert(row.at("law"));
    EXPECT_LE(row.at("elements"), 200);
    EXPECT_TRUE(row.at("converged").get<bool>()) << row;
    // A mesh of more elements is nearer: rows go from coarse to fine.
    const double now = std::abs(row.at("model_error").get<double>());
    EXPECT_LT(now, error + 1e-3) << row;
    error = now;
  }
  EXPECT_EQ(courses, (std::set<std::string>{"frames", "static"}));
  EXPECT_EQ(laws, (std::set<std::string>{"cor", "snh"}));
  const std::string svg = ReadWholeFile(plot);
  EXPECT_TRUE(svg.starts_with("<svg"));
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  const auto refused = test::RunProgram("bench tissue --only elbow");
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_NE(refused.err.find("meniscus_load"), std::string::npos) << refused.err;
}

TEST(BenchJob, HoldsTouchAgainstClosedFormsAndTheRule) {
  test::TempFolder folder;
  const std::string json = (folder / "h.json").string(), plot = (folder / "h.svg").string();
  const auto result = test::RunProgram("bench haptics --ticks 200 --rounds 1 --hands 5 --json " +
                                       json + " --plot " + plot);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  for (const char* words : {"paper 3x3", "(b + B)/(T/2 + t_d)", "random hands"})
    EXPECT_NE(result.out.find(words), std::string::npos) << words;
  const auto bench = nlohmann::json::parse(ReadWholeFile(json));
  EXPECT_EQ(bench.at("schema"), "arthroscene.bench.haptics/1");
  EXPECT_FALSE(bench.at("machine").get<std::string>().empty());
  for (const auto& row : bench.at("times"))
    for (const char* time : {"us_p50", "us_p99", "us_p999", "us_calm_p50", "us_calm_p99"})
      EXPECT_GT(row.at(time), 0.0) << row;
  for (const auto& row : bench.at("forces"))
    for (const char* error : {"rms", "angle_p99_deg", "angle_max_deg", "excess_step", "us"})
      EXPECT_TRUE(row.at(error).is_number()) << row;
  for (const auto& row : bench.at("stability")) EXPECT_GT(row.at("rule"), 0.0) << row;
  EXPECT_EQ(bench.at("hands").at("tried"), 5);
  const std::string svg = ReadWholeFile(plot);
  EXPECT_TRUE(svg.starts_with("<svg"));
  EXPECT_EQ(svg.find("nan"), std::string::npos);
}

TEST(BenchJob, TwoThingsToStandardOutputAreRefused) {
  const auto result = test::RunProgram("bench panorama --json - --plot -");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_NE(result.err.find("cannot both"), std::string::npos) << result.err;
  EXPECT_EQ(test::RunProgram("bench").exit_code, 2);
}

}  // namespace
}  // namespace arthro
