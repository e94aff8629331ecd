#include "simulation/scene/json/lens_io.h"

#include <filesystem>
#include <fstream>
#include <functional>
#include <rapidjson/document.h>
#include <rapidjson/schema.h>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"
#include "simulation/core/units.h"
#include "tests/support/build_paths.h"

namespace arthro {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

json Good() {
  return json::parse(R"({"schema": "arthroscene.lens/1", "model": "equisolid", "width": 800,
    "height": 640, "focal_px": 466.65, "cx": 402.5, "cy": 317.5, "aspect": 1, "k": [],
    "fov_deg": 75, "circle": {"cx": 402.5, "cy": 317.5, "r": 300}, "rms_px": 0.15})");
}

std::string SentenceOf(const json& lens) {
  try {
    LensFromJson(lens.dump(), "lens.json");
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), Code::kBadData);
    return error.what();
  }
  return "";
}

TEST(LensIo, WhatIsWrittenIsRead) {
  Lens lens = LensFromJson(Good().dump(), "lens.json");
  EXPECT_EQ(lens.width, 800);
  EXPECT_EQ(lens.circle.r, 300);
  EXPECT_NEAR(lens.field_of_view, RadiansFromDegrees(75), 1e-15);
  lens.model = LensModel::kDoubleSphere;
  lens.k = {-0.25, 0.5625, 0, 0};
  lens.aspect = 1.0123456789;
  const std::string text = JsonFromLens(lens);
  const Lens again = LensFromJson(text, "lens.json");
  EXPECT_EQ(JsonFromLens(again), text);
  EXPECT_EQ(again.k, lens.k);
  EXPECT_EQ(again.model, lens.model);
  EXPECT_EQ(again.aspect, lens.aspect);
}

TEST(LensIo, CameraIsReadAndWrittenAndMayBeLeftOut) {
  Lens lens = LensFromJson(Good().dump(), "lens.json");
  EXPECT_EQ(lens.camera, LensCamera());
  EXPECT_EQ(JsonFromLens(lens).find("camera"), std::string::npos);
  lens.camera = {0.004, 0.25, 1.5, 3};
  EXPECT_EQ(LensFromJson(JsonFromLens(lens), "lens.json").camera, lens.camera);
  json part = Good();
  part["camera"] = {{"grain", 0}};
  EXPECT_EQ(LensFromJson(part.dump(), "lens.json").camera.grain, 0);
  EXPECT_EQ(LensFromJson(part.dump(), "lens.json").camera.fringe, LensCamera().fringe);
  part["camera"] = {{"grain", -1}};
  EXPECT_NE(SentenceOf(part).find("camera.grain"), std::string::npos) << SentenceOf(part);
  part["camera"] = {{"grian", 1}};
  EXPECT_NE(SentenceOf(part).find("camera.grian"), std::string::npos) << SentenceOf(part);
}

TEST(LensIo, AFileByHandMayLeaveOut) {
  const Lens lens = LensFromJson(
      R"({"model": "kannala_brandt", "width": 640, "height": 480, "focal_px": 300, "cx": 319.5,
          "cy": 239.5, "k": [0.01, -0.002], "x-note": "by hand"})",
      "lens.json");
  EXPECT_EQ(lens.aspect, 1);
  EXPECT_EQ(lens.k, (std::array<double, 4>{0.01, -0.002, 0, 0}));
  EXPECT_EQ(lens.circle.r, 0);
  EXPECT_GT(lens.field_of_view, 1.5);
}

TEST(LensIo, EveryFaultNamesItsKeyAndWhatMayStandThere) {
  struct Case {
    std::function<void(json&)> spoil;
    std::string says;
  };
  const Case cases[] = {
      {[](json& j) { j["model"] = "fisheye"; }, "model is \"fisheye\"; it must be"},
      {[](json& j) { j.erase("focal_px"); }, "focal_px is missing"},
      {[](json& j) { j["focal_px"] = 0; }, "focal_px is 0; it must be more than 0"},
      {[](json& j) { j["focal_px"] = "466"; }, "focal_px is \"466\""},
      {[](json& j) { j["width"] = 800.5; }, "width must be a whole number"},
      {[](json& j) { j["width"] = -1; }, "width is -1"},
      {[](json& j) { j["focal"] = 3; }, "did you mean \"focal_px\"?"},
      {[](json& j) { j["k"] = {0.1}; }, "k has 1 numbers; equisolid has 0"},
      {[](json& j) { j["k"] = "none"; }, "it must be a list of numbers"},
      {[](json& j) { j["model"] = "double_sphere"; }, "two numbers [xi, alpha]"},
      {[](json& j) {
         j["model"] = "double_sphere";
         j["k"] = {-2, 0.5};
       },
       "xi must be more than -1"},
      {[](json& j) { j["schema"] = "arthroscene.lens/2"; }, "this program reads"},
      {[](json& j) { j["circle"] = 3; }, "circle is 3; it must be an object"},
      {[](json& j) { j["circle"].erase("r"); }, "circle.r is missing"},
      {[](json& j) {
         j.erase("fov_deg");
         j["focal_px"] = 100;
       },
       "fov_deg is missing, and the model ends before"},
      {[](json& j) { j["width"] = 300; }, "lies outside of the picture of 300 x "},
  };
  for (const Case& c : cases) {
    json lens = Good();
    c.spoil(lens);
    const std::string sentence = SentenceOf(lens);
    EXPECT_NE(sentence.find(c.says), std::string::npos) << c.says << "\n" << sentence;
    EXPECT_NE(sentence.find("lens.json"), std::string::npos) << sentence;
  }
  EXPECT_THROW(LensFromJson("{", "lens.json"), Error);
  EXPECT_THROW(LensFromJson("[1]", "lens.json"), Error);
  EXPECT_THROW(ReadLens("/nowhere/lens.json"), Error);
}

TEST(LensIo, RefusesAFileOfAnotherKindInOneSentence) {
  const std::string scene =
      SentenceOf({{"schema", "arthroscene.scene/1"}, {"backdrop", 1}, {"tissues", 2}});
  EXPECT_NE(scene.find("this is no lens file, since its schema is \"arthroscene.scene/1\""),
            std::string::npos)
      << scene;
  EXPECT_EQ(scene.find("tissues"), std::string::npos)
      << "faults of another kind of file: " << scene;
  EXPECT_NE(SentenceOf({{"frames", 3}}).find("model is missing"), std::string::npos);
  const std::string many = SentenceOf({{"model", "pinhole"}});
  EXPECT_NE(many.find("(and 2 more)"), std::string::npos) << many;
}

TEST(LensIo, TheSchemaForOtherToolsIsTheGeneratedOne) {
  const fs::path copy = fs::path(ARTHRO_SOURCE_DIR) / "resources/schemas/lens-1.schema.json";
  EXPECT_EQ(ReadWholeFile(copy), LensSchemaText())
      << "a field of the lens has changed; write the schema anew: arthroscene check --lens-schema "
         "> "
      << copy.string();
}

// Degrees in the file are those that a person would write.
TEST(LensIo, TheFieldOfViewIsWrittenAsItWasRead) {
  const std::string text = JsonFromLens(LensFromJson(Good().dump(), "lens.json"));
  EXPECT_NE(text.find("\"fov_deg\": 75.0,"), std::string::npos) << text;
}

TEST(LensIo, TheSchemaTakesWhatTheWriterWrites) {
  rapidjson::Document text;
  text.Parse(
      ReadWholeFile(fs::path(ARTHRO_SOURCE_DIR) / "resources/schemas/lens-1.schema.json").c_str());
  ASSERT_FALSE(text.HasParseError());
  const rapidjson::SchemaDocument schema(text);
  const auto takes = [&](const std::string& lens) {
    rapidjson::Document document;
    document.Parse(lens.c_str());
    rapidjson::SchemaValidator validator(schema);
    return document.Accept(validator);
  };
  EXPECT_TRUE(takes(JsonFromLens(LensFromJson(Good().dump(), "lens.json"))));
  json bad = Good();
  bad["focal_px"] = -1;
  EXPECT_FALSE(takes(bad.dump()));
  bad = Good();
  bad["model"] = "fisheye";
  EXPECT_FALSE(takes(bad.dump()));
  bad = Good();
  bad["radius"] = 3;
  EXPECT_FALSE(takes(bad.dump()));
}

}  // namespace
}  // namespace arthro
