// Claims about the benchmarks, run as a user runs it, on clips small enough.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "simulation/core/atomic_file.h"
#include "simulation/scene/image_io.h"
#include "tests/support/build_paths.h"
#include "tests/support/knee_picture.h"
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
  const auto result =
      test::RunProgram("bench haptics --ticks 200 --rounds 1 --hands 5 --cycles 10 --json " + json +
                       " --plot " + plot);
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

// The bounds of tests/app/view: of every searched ray at most 2 % end elsewhere with cells of up to
// 4 pixels (a small picture's cells of 8 are too wide to say), and a line of the grid is at most
// half a pixel off. Models add their outlines, 0.1 px wide on average: of some 1300 px of outline
// of two instruments and a ring in a picture of 256 px that is 0.3 % of it; 2 % leaves room for
// slopes so steep that a tenth of a pixel is a tenth of a millimetre.
TEST(BenchJob, HoldsThePictureAgainstTheTracer) {
  test::TempFolder folder;
  const std::string json = (folder / "v.json").string(), plot = (folder / "v.svg").string();
  const auto result = test::RunProgram(
      "bench view --timed-frames 2 --size 256 --panorama 1024 --triangles 2000 --pixels 1500 "
      "--json " +
          json + " --plot " + plot,
      "env -u DISPLAY -u WAYLAND_DISPLAY");
  if (result.err.find("no picture can be drawn") != std::string::npos)
    GTEST_SKIP() << "NOT TESTED, NOTHING WAS DRAWN: " << result.err;
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto bench = nlohmann::json::parse(ReadWholeFile(json));
  EXPECT_EQ(bench.at("schema"), "arthroscene.bench.view/1");
  EXPECT_FALSE(bench.at("machine").get<std::string>().empty());
  EXPECT_NE(bench.at("drawn_by").get<std::string>().find("OpenGL"), std::string::npos);
  EXPECT_NE(result.out.find(bench.at("drawn_by").get<std::string>()), std::string::npos);

  std::map<std::string, int> parts;
  std::map<std::pair<int, int>, double> sphere;  // keyed by size and panorama
  std::set<int> triangles;
  std::map<int, std::vector<double>> off_still;  // keyed by size: one per feature of the camera
  std::map<std::string, int> features;           // rows per feature
  for (const auto& row : bench.at("rows")) {
    const std::string part = row.at("part");
    const int cell = row.at("relief_cell");
    ++parts[part];
    for (const char* time : {"wall_ms", "cpu_ms"}) {
      const double median = row.at(std::string(time) + "_median");
      EXPECT_GT(median, 0.0) << row;
      EXPECT_LE(median, row.at(std::string(time) + "_p99")) << row;
    }
    EXPECT_GT(row.at("compared"), 100) << row;
    if (part == "samples") {
      EXPECT_LE(row.at("lines_rms_px"), row.at("lines_max_px")) << row;
      EXPECT_LT(row.at("lines_max_px"), 0.5) << row;
      EXPECT_TRUE(row.at("ends_off").is_null()) << row;
      continue;
    }
    EXPECT_TRUE(row.at("lines_max_px").is_null()) << row;
    const double off = row.at("ends_off");
    EXPECT_LT(row.at("others_rms"), 1e-4) << row;
    if (part == "scene") {
      triangles.insert(row.at("triangles").get<int>());
      EXPECT_LT(off, 0.02 + 0.02) << row;
      EXPECT_TRUE(row.at("colour_off").is_null()) << row;
      continue;
    }
    if (part == "stairs") {
      EXPECT_LT(off, 0.04) << row;
      continue;
    }
    // Colours vary so slowly that one from elsewhere is often the same.
    EXPECT_LE(row.at("colour_off"), off) << row;
    double& bare = sphere[{row.at("size"), row.at("panorama")}];
    if (row.at("relief_steps") == 0) {
      bare = off;
      continue;
    }
    EXPECT_LT(off, 0.5 * bare) << row;
    if (cell <= 4) {
      EXPECT_LT(off, 0.02) << row;
    }
  }
  EXPECT_EQ(parts, (std::map<std::string, int>{
                       {"relief", 18}, {"samples", 8}, {"stairs", 3}, {"scene", 14}}));
  EXPECT_EQ(sphere.size(), 3u);
  for (const auto& row : bench.at("costs")) {
    ++features[row.at("feature")];
    EXPECT_GT(row.at("picture").at("cpu_ms_median"), 0.0) << row;
    EXPECT_LE(row.at("two_cores_ms"), row.at("picture").at("cpu_ms_p99")) << row;
    EXPECT_TRUE(row.at("share").at("cpu_ms_median").is_number()) << row;
    if (!row.at("ends_off").is_null() && row.at("feature") != "backdrop on a bare sphere") {
      EXPECT_LT(row.at("ends_off"), 0.02 + 0.02) << row;
    }
    if (!row.at("off_still").is_null())
      off_still[row.at("size")].push_back(row.at("off_still").get<double>());
  }
  EXPECT_EQ(features.size(), 13u);
  for (const auto& [feature, rows] : features) EXPECT_EQ(rows, 2) << feature;
  EXPECT_EQ(features.count("occlusion"), 1u);
  // The last row with a camera adds occlusion, the one before smooths edges.
  ASSERT_EQ(off_still.size(), 2u);
  for (const auto& [size, off] : off_still) {
    ASSERT_EQ(off.size(), 6u);
    EXPECT_LT(off[4], off[3]) << size;
  }
  EXPECT_EQ(triangles, (std::set<int>{0, 392, 2048}));
  const std::string svg = ReadWholeFile(plot);
  EXPECT_TRUE(svg.starts_with("<svg"));
  EXPECT_EQ(svg.find("nan"), std::string::npos);
}

// The demo is drawn at 24 poses, and the frames of a folder are measured beside it.
TEST(BenchJob, PrintsTheLookOfASceneBesideThatOfFrames) {
  test::TempFolder folder;
  std::filesystem::create_directory(folder / "frames");
  const ColourImage knee = test::KneePicture(320, 240);
  WriteColourImage(folder / "frames/a.png", knee);
  WriteColourImage(folder / "frames/b.png", knee);
  const std::string json = (folder / "look.json").string();
  const auto result =
      test::RunProgram("bench view --look " ARTHRO_SOURCE_DIR "/resources/demo" +
                           (" --frames " + (folder / "frames").string()) + " --json " + json,
                       "env -u DISPLAY -u WAYLAND_DISPLAY");
  if (result.err.find("no picture can be drawn") != std::string::npos)
    GTEST_SKIP() << "NOT TESTED, NOTHING WAS DRAWN: " << result.err;
  ASSERT_EQ(result.exit_code, 0) << result.err;
  std::printf("%s", result.out.c_str());
  const auto look = nlohmann::json::parse(ReadWholeFile(json));
  EXPECT_EQ(look.at("schema"), "arthroscene.bench.look/1");
  ASSERT_EQ(look.at("poses").size(), 24u);
  ASSERT_EQ(look.at("rows").size(), 2u);
  EXPECT_EQ(look.at("rows")[0].at("pictures").size(), 24u);
  EXPECT_EQ(look.at("rows")[1].at("pictures").size(), 2u);
  EXPECT_EQ(look.at("rows")[1].at("pictures")[0], look.at("rows")[1].at("pictures")[1]);
  // Goals of the demo at its default.
  const auto& demo = look.at("rows")[0].at("mean");
  EXPECT_LE(demo.at("p1"), 25);
  EXPECT_GE(demo.at("p99"), 240);
  EXPECT_GE(demo.at("clipped"), 0.01);
  EXPECT_LE(demo.at("clipped"), 0.06);
  EXPECT_GE(demo.at("gradient"), 2.5);
  EXPECT_LE(demo.at("flat"), 0.3);
}

TEST(BenchJob, LookWithoutASceneOrFramesIsRefused) {
  test::TempFolder folder;
  const auto none = test::RunProgram("bench view --look " + (folder / "none").string());
  EXPECT_EQ(none.exit_code, 1);
  EXPECT_NE(none.err.find("none"), std::string::npos) << none.err;
  const auto alone = test::RunProgram("bench view --frames " + folder.path().string());
  EXPECT_NE(alone.exit_code, 0) << "--frames belongs to --look";
}

TEST(BenchJob, APictureThatNothingCanDrawIsRefused) {
  test::TempFolder folder;
  const std::string json = (folder / "v.json").string();
  const auto result = test::RunProgram("bench view --json " + json,
                                       "env -u DISPLAY -u WAYLAND_DISPLAY "
                                       "__EGL_VENDOR_LIBRARY_FILENAMES=/nonexistent");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_NE(result.err.find("no picture can be drawn"), std::string::npos) << result.err;
  EXPECT_FALSE(std::filesystem::exists(json));
}

// Measuring would take minutes, and more than a test may.
TEST(BenchJob, AReportThatCannotBeWrittenIsRefusedBeforeAnythingIsMeasured) {
  test::TempFolder folder;
  const std::string nowhere = (folder / "nowhere" / "b.json").string();
  for (const std::string words :
       {"view --timed-frames 100000", "tissue --frames 100000", "panorama --frames 120", "haptics"})
    for (const std::string to : {"--json ", "--plot "}) {
      const auto result = test::RunProgram("bench " + words + " " + to + nowhere);
      EXPECT_EQ(result.exit_code, 1) << words;
      EXPECT_NE(result.err.find("create it first"), std::string::npos) << words << result.err;
      EXPECT_EQ(result.out, "") << words;
    }
}

// 30 s of processor time.
TEST(BenchJob, AllWritesOneReportOverEveryBenchmark) {
  test::TempFolder folder;
  const auto result = test::RunProgram("bench all --quick -o " + (folder / "report").string(),
                                       "env -u DISPLAY -u WAYLAND_DISPLAY");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("report.html"), std::string::npos) << result.out;
  const std::string html = ReadWholeFile(folder / "report/report.html");
  const auto report = nlohmann::json::parse(ReadWholeFile(folder / "report/report.json"));
  EXPECT_EQ(report.at("schema"), "arthroscene.bench.all/1");
  for (const char* name : {"panorama", "tissue", "haptics", "view", "micro"}) {
    const auto& bench = report.at("benchmarks").at(name);
    if (bench.contains("fault")) {
      EXPECT_STREQ(name, "view") << bench;  // no renderer
      continue;
    }
    EXPECT_EQ(bench.at("schema"), "arthroscene.bench." + std::string(name) + "/1");
    EXPECT_NE(html.find(std::string("# ") + name), std::string::npos) << "no table of " << name;
    const std::string plot =
        name == std::string("micro") ? "micro-lens.svg" : name + std::string(".svg");
    const std::string svg = ReadWholeFile(folder / ("report/" + plot));
    EXPECT_NE(svg.find("reference: "), std::string::npos) << plot;
    EXPECT_EQ(svg.find("nan"), std::string::npos) << plot;
    EXPECT_NE(html.find(svg), std::string::npos) << plot;
  }
}

// Beside a copy of the program there are no benchmarks.
TEST(BenchJob, WithoutItsProgramIsRefusedInOneSentence) {
  test::TempFolder folder;
  std::filesystem::copy_file(ARTHRO_PROGRAM, folder / "arthroscene");
  const std::string err = (folder / "err").string();
  const int status =
      std::system(((folder / "arthroscene").string() + " bench view 2>" + err).c_str());
  EXPECT_EQ(WEXITSTATUS(status), 1);
  const std::string said = ReadWholeFile(err);
  EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1) << said;
  for (const char* word : {"arthroscene: ", "arthroscene-bench", "not installed"})
    EXPECT_NE(said.find(word), std::string::npos) << said;
}

TEST(BenchJob, LeavesNothingOfThePeerInTheProgram) {
  const std::string program = ReadWholeFile(ARTHRO_PROGRAM);
  for (const char* word : {"libopencv_stitching", "stitcher-worker"})
    EXPECT_EQ(program.find(word), std::string::npos) << word;
}

TEST(BenchJob, TwoThingsToStandardOutputAreRefused) {
  const auto result = test::RunProgram("bench panorama --json - --plot -");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_NE(result.err.find("cannot both"), std::string::npos) << result.err;
  EXPECT_EQ(test::RunProgram("bench").exit_code, 2);
}

}  // namespace
}  // namespace arthro
