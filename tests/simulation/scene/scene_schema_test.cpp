// The JSON Schema that other tools use against the reader of this program, held by a validator that
// is not ours.
#include "simulation/scene/json/scene_schema.h"

#include <filesystem>
#include <optional>
#include <rapidjson/document.h>
#include <rapidjson/schema.h>
#include <rapidjson/stringbuffer.h>
#include <string>

#include <gtest/gtest.h>

#include "simulation/core/atomic_file.h"
#include "simulation/scene/json/scene_json.h"
#include "tests/support/build_paths.h"
#include "tests/support/example_scene.h"

namespace arthro {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

class SceneSchema : public ::testing::Test {
 protected:
  void SetUp() override {
    rapidjson::Document text;
    text.Parse(ReadWholeFile(fs::path(ARTHRO_SOURCE_DIR) / "resources/schemas/scene-2.schema.json")
                   .c_str());
    ASSERT_FALSE(text.HasParseError());
    schema_.emplace(text);
  }

  // "" where the schema takes it; else the place and the rule.
  std::string FaultOf(const std::string& scene) const {
    rapidjson::Document text;
    text.Parse(scene.c_str());
    if (text.HasParseError()) return "not JSON";
    rapidjson::SchemaValidator validator(*schema_);
    if (text.Accept(validator)) return "";
    rapidjson::StringBuffer place;
    validator.GetInvalidDocumentPointer().StringifyUriFragment(place);
    return std::string(place.GetString()) + " " + validator.GetInvalidSchemaKeyword();
  }

  std::optional<rapidjson::SchemaDocument> schema_;
};

TEST_F(SceneSchema, TakesWhatTheReaderTakes) {
  EXPECT_EQ(FaultOf(test::FullSceneJson().dump()), "");
  for (const char* path : {"p.png", "a/b/c.png", "..a/b..c", ".hidden", "./p.png", "ü 1.png"}) {
    json scene = test::FullSceneJson();
    scene["backdrop"]["panorama"] = path;
    std::vector<JsonFault> faults;
    SceneFromJson(scene, faults);
    EXPECT_TRUE(faults.empty()) << path;
    EXPECT_EQ(FaultOf(scene.dump()), "") << path;
  }
}

TEST_F(SceneSchema, TakesWhatTheWriterWrites) {
  std::vector<JsonFault> faults;
  EXPECT_EQ(FaultOf(PrettyJson(JsonFromScene(SceneFromJson(test::FullSceneJson(), faults)))), "");
}

TEST_F(SceneSchema, RefusesWhatTheReaderRefuses) {
  int seen = 0;
  for (const test::SceneFault& fault : test::SceneFaults()) {
    json scene = test::FullSceneJson();
    scene[json::json_pointer(fault.pointer)] = fault.value;
    std::vector<JsonFault> faults;
    SceneFromJson(scene, faults);
    EXPECT_FALSE(faults.empty()) << fault.pointer << " " << fault.value;
    EXPECT_EQ(FaultOf(scene.dump()).empty(), !fault.schema_sees_it)
        << fault.pointer << " " << fault.value;
    seen += fault.schema_sees_it;
  }
  EXPECT_GT(seen, 40);
}

// Each required key, and each key of a wrong type.
TEST_F(SceneSchema, AndTheReaderRefuseTheSameOfManyMutations) {
  const json read = test::FullSceneJson().flatten();
  int mutations = 0, refused = 0;
  for (const auto& [pointer, value] : read.items()) {
    if (pointer.starts_with("/schema") || pointer.starts_with("/x-")) continue;
    for (const json& wrong : {json(nullptr), json(true), json(-7), json("x"), json::array(),
                              json::object(), json(1e9), json(0)}) {
      json scene = test::FullSceneJson();
      scene[json::json_pointer(pointer)] = wrong;
      std::vector<JsonFault> faults;
      SceneFromJson(scene, faults);
      // Two things that the schema has no words for (its description says so).
      bool only_reader = false;
      for (const JsonFault& fault : faults)
        only_reader |= fault.sentence.find("used twice") != std::string::npos ||
                       fault.sentence.find("all zeros") != std::string::npos;
      if (only_reader) continue;
      EXPECT_EQ(FaultOf(scene.dump()).empty(), faults.empty())
          << pointer << " " << wrong << " " << FaultOf(scene.dump());
      ++mutations;
      refused += faults.empty() ? 0 : 1;
    }
  }
  std::printf("%d mutations, %d refused by both\n", mutations, refused);
  EXPECT_GT(refused, 200);
}

TEST_F(SceneSchema, TheCopyForOtherToolsIsTheGeneratedOne) {
  const fs::path copy = fs::path(ARTHRO_SOURCE_DIR) / "resources/schemas/scene-2.schema.json";
  EXPECT_EQ(ReadWholeFile(copy), SceneSchemaText())
      << "a field of the scene has changed; write the schema anew: arthroscene check --schema > "
      << copy.string();
}

TEST_F(SceneSchema, TakesTheDemoScene) {
  const fs::path demo = fs::path(ARTHRO_SOURCE_DIR) / "resources/demo/scene.json";
  if (!fs::exists(demo)) GTEST_SKIP() << "SKIPPED: there is no demo scene in this checkout";
  EXPECT_EQ(FaultOf(ReadWholeFile(demo)), "");
}

}  // namespace
}  // namespace arthro
