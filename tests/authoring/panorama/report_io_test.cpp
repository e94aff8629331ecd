#include "authoring/panorama/report_io.h"

#include <filesystem>
#include <rapidjson/document.h>
#include <rapidjson/schema.h>
#include <rapidjson/stringbuffer.h>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include "authoring/panorama/clip/panorama_options.h"
#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"
#include "simulation/core/options_json.h"
#include "tests/support/build_paths.h"
#include "tests/support/temp_folder.h"

namespace arthro::authoring {
namespace {

namespace fs = std::filesystem;

// Validates by an independent implementation: "" for a valid document, otherwise the place and the
// rule.
std::string FaultOf(const std::string& report) {
  rapidjson::Document schema_text, text;
  schema_text.Parse(
      ReadWholeFile(fs::path(ARTHRO_SOURCE_DIR) / "resources/schemas/panorama-1.schema.json")
          .c_str());
  if (schema_text.HasParseError()) return "the schema is not JSON";
  const rapidjson::SchemaDocument schema(schema_text);
  text.Parse(report.c_str());
  if (text.HasParseError()) return "not JSON";
  rapidjson::SchemaValidator validator(schema);
  if (text.Accept(validator)) return "";
  rapidjson::StringBuffer place;
  validator.GetInvalidDocumentPointer().StringifyUriFragment(place);
  return std::string(place.GetString()) + " " + validator.GetInvalidSchemaKeyword();
}

PanoramaReport SampleReport() {
  PanoramaReport report;
  report.footage = "clip";
  report.summary = "partial: 1 of 3 usable frames are in the panorama";
  report.is_partial = true;
  report.lens.width = 800;
  report.lens.height = 640;
  report.lens.focal_px = 400;
  report.lens.circle = {400, 320, 300};
  report.rectified = {800, 640, 400, 399, 319};
  report.panorama = {2000, 1500, 380.5, 1010, 740};
  FrameReport placed;
  placed.source = "0000.png";
  placed.is_placed = placed.is_usable = true;
  placed.component = 0;
  placed.panorama_from_rectified = {1.01, 0.02, 300, -0.02, 0.99, 200, 1e-5, -2e-5, 1};
  placed.inliers = 120;
  placed.rms_px = 0.31234567;
  placed.expected_error_px = 0.5;
  FrameReport piece = placed;
  piece.index = 1;
  piece.is_placed = false;
  piece.component = 1;
  piece.reason = "it belongs to piece 2";
  FrameReport blank;
  blank.index = 2;
  blank.reason = "blank: it is black";
  report.frames = {placed, piece, blank};
  report.pieces = {{1, 1, "pano-2.png", {300, 200, 380, 150, 100}}};
  report.detector = "surf";
  report.stages = {{"read", 12.3456}, {"compose", 99}};
  report.peak_memory_mb = 123.4;
  report.warnings = {"no lens was given"};
  report.options = JsonFromOptions(PanoramaOptions()).dump();
  report.clips = {{"clip", 0, 3, 2, 1}};
  report.tied = {{1, 2, 0.75, 3.5, true}};
  report.text_boxes = {{10, 20, 30, 8}};
  return report;
}

TEST(PanoramaReport, FollowsItsSchema) {
  EXPECT_EQ(FaultOf(JsonFromReport(SampleReport())), "");
  // The schema would reject it otherwise.
  nlohmann::json json = nlohmann::json::parse(JsonFromReport(SampleReport()));
  json["frames"][0]["status"] = "good";
  EXPECT_NE(FaultOf(json.dump()), "");
  json = nlohmann::json::parse(JsonFromReport(SampleReport()));
  json["panorama"].erase("focal_px");
  EXPECT_NE(FaultOf(json.dump()), "");
}

TEST(PanoramaReport, FollowsItsSchemaOverARelief) {
  PanoramaReport report = SampleReport();
  report.rectified = {};
  report.panorama = {};
  report.panorama.width = 800;
  report.panorama.height = 600;
  report.over_relief = Projection{ProjectionType::kEquirectangular, {399.5, 299.5}, 1000, 8};
  report.relief_radius = 0.05;
  EXPECT_EQ(FaultOf(JsonFromReport(report)), "");
  const auto json = nlohmann::json::parse(JsonFromReport(report));
  EXPECT_EQ(json.at("way"), "relief");
  EXPECT_FALSE(json.contains("rectified"));
  EXPECT_TRUE(json.at("frames").at(0).at("panorama_from_rectified").is_null());
}

// Keys that other tools and the editor read [method.md, Command line].
TEST(PanoramaReport, HasTheKeysOfTheContract) {
  const auto json = nlohmann::json::parse(JsonFromReport(SampleReport()));
  EXPECT_EQ(json.at("schema"), "arthroscene.panorama/1");
  EXPECT_EQ(json.at("panorama").at("focal_px"), 380.5);
  EXPECT_EQ(json.at("panorama").at("cx"), 1010);
  EXPECT_EQ(json.at("rectified").at("width"), 800);
  EXPECT_EQ(json.at("lens").at("model"), "equisolid");
  const auto& frames = json.at("frames");
  EXPECT_EQ(frames.at(0).at("status"), "placed");
  EXPECT_EQ(frames.at(0).at("reason"), "");
  EXPECT_EQ(frames.at(0).at("panorama_from_rectified").at(6), 1e-5);  // not rounded
  EXPECT_EQ(frames.at(0).at("rms_px"), 0.312);
  EXPECT_EQ(frames.at(1).at("status"), "rejected");
  EXPECT_EQ(frames.at(1).at("component"), 1);
  EXPECT_EQ(frames.at(2).at("status"), "rejected");
  EXPECT_EQ(frames.at(2).at("reason"), "skipped: blank: it is black");
  EXPECT_TRUE(frames.at(2).at("panorama_from_rectified").is_null());
  EXPECT_EQ(json.at("status"), "partial");
  EXPECT_EQ(json.at("stages_ms").at("read"), 12.346);
}

struct Names {
  std::set<std::string> seen = {};
  int fields = 0;
  template <class T, class R>
  void operator()(const char* name, T&, const R&, const char*, const char*) {
    seen.insert(name);
    ++fields;
  }
};

TEST(PanoramaOptions, EveryNameIsUsedOnceAndComesBack) {
  Names names;
  PanoramaOptions options;
  options.Visit(names);
  EXPECT_EQ(names.seen.size(), static_cast<std::size_t>(names.fields));
  EXPECT_GT(names.fields, 30);
  options.compose.feather = 3;
  options.choose.every = 5;
  options.registration.direct.smallest_overlap = 0.123;
  const auto json = JsonFromOptions(options);
  EXPECT_EQ(JsonFromOptions(OptionsFromJson<PanoramaOptions>(json)), json);
  EXPECT_EQ(OptionsFromJson<PanoramaOptions>(json).registration.direct.smallest_overlap, 0.123);
  CheckOptions(PanoramaOptions());
}

class PanoramaPicture : public ::testing::Test {
 protected:
  void SetUp() override {
    picture_ = {4, 2, {}};
    for (int i = 0; i < 8; ++i)
      picture_.rgba.insert(picture_.rgba.end(),
                           {200, 100, 50, static_cast<std::uint8_t>(i < 4 ? 255 : 0)});
  }
  std::string Refusal(const std::string& name) {
    try {
      WritePanorama(folder_ / name, picture_);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }
  RgbaPicture picture_;
  test::TempFolder folder_;
};

TEST_F(PanoramaPicture, PngKeepsCoverageAsAlphaAndIsBlackBeyond) {
  WritePanorama(folder_ / "p.png", picture_);
  const cv::Mat read = cv::imread((folder_ / "p.png").string(), cv::IMREAD_UNCHANGED);
  ASSERT_EQ(read.type(), CV_8UC4);
  EXPECT_EQ(read.at<cv::Vec4b>(0, 1), cv::Vec4b(50, 100, 200, 255));  // BGRA
  EXPECT_EQ(read.at<cv::Vec4b>(1, 1), cv::Vec4b(0, 0, 0, 0));
}

TEST_F(PanoramaPicture, JpegIsAllowed) {
  WritePanorama(folder_ / "p.jpg", picture_);
  EXPECT_EQ(cv::imread((folder_ / "p.jpg").string(), cv::IMREAD_UNCHANGED).type(), CV_8UC3);
}

TEST_F(PanoramaPicture, RefusesWhatCannotBeWrittenAndLeavesTheOldFile) {
  EXPECT_NE(Refusal("p.bmp").find(".png"), std::string::npos);
  EXPECT_NE(Refusal("no/p.png").find("does not exist"), std::string::npos);
  fs::create_directories(folder_ / "q.png");
  EXPECT_NE(Refusal("q.png").find("folder"), std::string::npos);
  WriteAtomically(folder_ / "p.png", "old");
  picture_ = {};
  EXPECT_NE(Refusal("p.png").find("empty"), std::string::npos);
  EXPECT_EQ(ReadWholeFile(folder_ / "p.png"), "old");
}

TEST(StageClock, TimeLeftIsSaidWhenItCanBe) {
  EXPECT_EQ(TimeLeft(1.0, 0.5), "");
  EXPECT_EQ(TimeLeft(60.0, 0.01), "");
  EXPECT_EQ(TimeLeft(10.0, 0.5), "about 10 s left");
  EXPECT_EQ(TimeLeft(10.0, 0.2), "about 40 s left");
  EXPECT_EQ(TimeLeft(60.0, 0.2), "about 4 min left");
  EXPECT_EQ(TimeLeft(60.0, 1.0), "");
}

TEST(StageClock, StagesAreSharesOfOneJob) {
  std::vector<double> done;
  Progress whole;
  whole.report = [&](std::string_view, double share) { done.push_back(share); };
  StageClock clock(whole, {{"a", 1}, {"skipped", 0}, {"b", 3}});
  clock.Begin("a").Step("a", 1.0);
  const Progress b = clock.Begin("b");
  b.Step("b", 0.5);
  b.Step("b, its second part", 0.1);  // a stage of stages never steps back
  clock.End();
  EXPECT_EQ(done, (std::vector<double>{0.25, 0.625, 0.625}));
  ASSERT_EQ(clock.costs().size(), 2u);
  EXPECT_EQ(clock.costs()[1].name, "b");
  EXPECT_GE(clock.costs()[0].cpu_ms, 0);
}

TEST(PanoramaReport, WhatIsReadIsWrittenAgainByteByByte) {
  PanoramaReport plane = SampleReport();
  plane.lens.field_of_view = FieldOfViewOf(plane.lens).value();  // a reader works it out
  plane.stages = {{"compose", 99}, {"read", 12.346}};            // sorted by name, as they are read
  const std::string text = JsonFromReport(plane);
  EXPECT_EQ(JsonFromReport(ReportFromJson(text)), text);
  PanoramaReport over = plane;
  over.over_relief = Projection{ProjectionType::kEquirectangular, {100.5, 80}, 0, 9.5};
  over.relief_radius = 0.05;
  const std::string relief = JsonFromReport(over);
  EXPECT_EQ(JsonFromReport(ReportFromJson(relief)), relief);
  EXPECT_THROW(ReportFromJson("{}"), Error);
  EXPECT_THROW(ReportFromJson("[1"), Error);
}

// The sentence names the key in our words; the JSON library's own are for programmers.
TEST(PanoramaReport, ThatCannotBeReadIsRefusedByTheNameOfTheKey) {
  const auto whole = nlohmann::json::parse(JsonFromReport(SampleReport()));
  const auto refusal = [](const nlohmann::json& json) {
    try {
      ReportFromJson(json.dump());
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string("read");
  };
  EXPECT_EQ(refusal(whole), "read");
  const std::string end = "; choose the one that `arthroscene panorama --report` wrote";
  for (const auto& [path, value, words] :
       std::vector<std::tuple<const char*, nlohmann::json, std::string>>{
           {"/frames", 3, "\"frames\" is of the wrong kind"},
           {"/frames/0", 3, "\"index\" stands in no object"},
           {"/frames/0/index", "one", "\"index\" is of the wrong kind"},
           {"/clips", "a.mp4", "\"clips\" is no list"},
           {"/clips/0/usable", nullptr, "\"usable\" is of the wrong kind"},
           {"/seed", "x", "\"seed\" is of the wrong kind"},
           {"/stages_ms", {1, 2}, "\"stages_ms\" is of the wrong kind"},
           {"/panorama", nlohmann::json::object(), "\"width\" is missing"}}) {
    nlohmann::json broken = whole;
    broken[nlohmann::json::json_pointer(path)] = value;
    EXPECT_EQ(refusal(broken), "this is no report of a panorama: " + words + end) << path;
  }
}

}  // namespace
}  // namespace arthro::authoring
