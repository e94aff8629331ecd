#include "simulation/scene/json/rig_io.h"

#include <functional>
#include <limits>
#include <rapidjson/document.h>
#include <rapidjson/schema.h>
#include <set>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"
#include "simulation/device/driver/wooden_model.h"
#include "simulation/device/hid/hid_node.h"
#include "simulation/device/openhaptics/openhaptics_devices.h"
#include "tests/support/build_paths.h"
#include "tests/support/temp_folder.h"

namespace arthro {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

json Whole() {
  return json::parse(R"({"schema": "arthroscene.rig/1", "title": "Two arms",
    "scope": {"device": {"family": "wooden_haptics", "serial": "A", "model": "polhem_v1"},
              "rod_length": 0.25, "hand_to_incision": 0.15, "pivot": [0.1, -0.2, 0.3],
              "portal_from_device": [0, 0, 2, 0], "max_force": 2, "max_stiffness": 400,
              "buttons": {"dead_man": 0}},
    "instrument": {"device": {"family": "wooden_haptics", "serial": "B",
                              "model": "woodenhaptics_2015"}, "rod_length": 0.2},
    "pedals": {"device": {"family": "dual_sense"},
               "buttons": {"dead_man": 6, "close_jaws": 7, "next_instrument": 0}},
    "x-room": "3.14"})");
}

json Changed(const std::function<void(json&)>& change) {
  json rig = Whole();
  change(rig);
  return rig;
}

// Message of ParseRig; empty when it accepts the text.
std::string Refusal(const std::string& text) {
  try {
    ParseRig(text, "rig.json");
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), Code::kBadData);
    return error.what();
  }
  return "";
}

bool FitsSchema(const json& rig) {
  static const rapidjson::SchemaDocument schema = [] {
    rapidjson::Document text;
    text.Parse(
        ReadWholeFile(fs::path(ARTHRO_SOURCE_DIR) / "resources/schemas/rig-1.schema.json").c_str());
    EXPECT_FALSE(text.HasParseError());
    return rapidjson::SchemaDocument(text);
  }();
  rapidjson::Document document;
  document.Parse(rig.dump().c_str());
  rapidjson::SchemaValidator validator(schema);
  return document.Accept(validator);
}

TEST(RigIo, ReadsAWholeRig) {
  const RigFile rig = ParseRig(Whole().dump());
  EXPECT_EQ(rig.title, "Two arms");
  ASSERT_TRUE(rig.scope && rig.instrument && rig.pedals);
  EXPECT_EQ(rig.scope->device.serial, "A");
  EXPECT_EQ(rig.scope->device.model, "polhem_v1");
  EXPECT_EQ(rig.scope->mount.rod_length, 0.25);
  EXPECT_EQ(rig.scope->mount.pivot, glm::dvec3(0.1, -0.2, 0.3));
  EXPECT_EQ(rig.scope->mount.portal_from_device, glm::dquat(0, 0, 1, 0)) << "made unit";
  EXPECT_EQ(rig.scope->max_force, 2);
  EXPECT_EQ(rig.scope->max_stiffness, 400);
  EXPECT_EQ(rig.scope->buttons, (RigButtons{0, -1, -1}));
  EXPECT_EQ(rig.instrument->device.serial, "B");
  EXPECT_EQ(rig.instrument->max_force, 0) << "what the device bears";
  EXPECT_EQ(rig.pedals->buttons, (RigButtons{6, 7, 0}));
  EXPECT_TRUE(FitsSchema(Whole()));
}

TEST(RigIo, RefusesInASentence) {
  struct Case {
    std::function<void(json&)> change;
    const char* part;
    bool fits_schema = false;
  };
  const std::vector<Case> cases{
      {[](json& j) { j["schema"] = "arthroscene.rig/2"; }, "this program reads"},
      {[](json& j) { j.erase("title"); }, "title"},
      {[](json& j) { j["sccope"] = 1; }, "sccope"},
      {[](json& j) { j["scope"]["device"]["family"] = "touch"; }, "it must be one of"},
      {[](json& j) { j["scope"]["device"].erase("family"); }, "family"},
      {[](json& j) { j["scope"]["device"].erase("model"); }, "pushes the wrong way", true},
      {[](json& j) { j["scope"]["device"]["model"] = "polhem_v3"; }, "it must be one of"},
      {[](json& j) { j["scope"]["device"]["hand"] = 1; }, "has one hand", true},
      {[](json& j) { j["scope"]["device"]["hand"] = 0.5; }, "whole number"},
      {[](json& j) {
         j["scope"]["device"] = {{"family", "dual_sense"}};
       },
       "does not know where a hand is", true},
      {[](json& j) {
         j["pedals"]["device"] = {{"family", "openhaptics"}};
       },
       "is no pedal", true},
      {[](json& j) {
         j["scope"]["device"] = j["instrument"]["device"] = {{"family", "openhaptics"}};
       },
       "the name in the maker's setup tool", true},
      {[](json& j) { j["scope"]["rod_length"] = 250; }, "between 0.05 and 0.6 metres"},
      {[](json& j) { j["scope"]["rod_length"] = 0.02; }, "between 0.05 and 0.6 metres"},
      {[](json& j) { j["scope"].erase("rod_length"); }, "rod_length"},
      {[](json& j) {
         j["scope"]["rod_length"] = 0.15;
         j["scope"]["hand_to_incision"] = 0.25;
       },
       "were the two lengths swapped?", true},
      {[](json& j) {
         j["scope"]["pivot"] = {1, 2};
       },
       "pivot"},
      {[](json& j) {
         j["scope"]["portal_from_device"] = {0, 0, 0, 0};
       },
       "portal_from_device"},
      {[](json& j) { j["scope"]["max_force"] = 25; }, "max_force"},
      {[](json& j) { j["scope"]["buttons"]["dead_man"] = 32; }, "dead_man"},
      {[](json& j) { j["scope"]["buttons"]["close_jaws"] = 0; }, "give each its own", true},
      {[](json& j) { j["scope"]["buttons"]["fire"] = 1; }, "fire"},
      {[](json& j) { j["instrument"]["device"]["serial"] = "A"; }, "is the scope's", true},
      {[](json& j) { j["instrument"]["device"].erase("serial"); }, "change with the ports", true},
      {[](json& j) { j.erase("scope"), j.erase("instrument"); }, "at least one device"},
      {[](json& j) { j["scope"]["tip_offsets"]["probe"] = 0.01; }, "belongs to an instrument",
       true},
      {[](json& j) { j["instrument"]["tip_offsets"]["probe"] = 0.2; }, "between -0.1 and 0.1"},
      {[](json& j) { j["instrument"]["tip_offsets"]["hook"] = 0.01; }, "hook"},
      {[](json& j) {
         j["instrument"]["rod_length"] = 0.1;
         j["instrument"]["tip_offsets"]["punch"] = -0.06;
       },
       "makes the rod 0.04 m long", true},
      {[](json& j) {
         j["instrument"]["hand_to_incision"] = 0.19;
         j["instrument"]["tip_offsets"]["shaver"] = -0.02;
       },
       "would not reach the incision", true},
  };
  for (const Case& own : cases) {
    const json rig = Changed(own.change);
    EXPECT_NE(Refusal(rig.dump()).find(own.part), std::string::npos)
        << own.part << ": " << Refusal(rig.dump());
    EXPECT_EQ(FitsSchema(rig), own.fits_schema) << own.part;
  }
  EXPECT_NE(Refusal("{").find("not JSON"), std::string::npos);
  EXPECT_NE(Refusal("[]").find("object"), std::string::npos);
  EXPECT_EQ(
      Refusal("{\"schema\": \"arthroscene.rig/1\",\n\"scope\": {\"rod_length\": -1e999}}"),
      "rig.json: the number -1e999 at line 2, column 25 is larger than any that is read; mend "
      "it");
  EXPECT_NE(Refusal("{\"title\": \"a\", \"title\": \"b\"}").find("\"title\" comes twice"),
            std::string::npos);
  // Thousands of digits are not said again.
  EXPECT_LT(Refusal("{\"title\": " + std::string(5000, '9') + "e5}").size(), 140u);
}

TEST(RigIo, TipOffsetsComeBackFromTheFile) {
  const json given = Changed([](json& j) {
    j["instrument"]["tip_offsets"] = {{"punch", 0.012}, {"grasper", -0.005}};
  });
  EXPECT_TRUE(FitsSchema(given));
  const RigFile rig = ParseRig(given.dump());
  EXPECT_EQ(rig.instrument->tip_offsets.beyond_rod, (std::array{0.0, 0.012, 0.0, -0.005}));
  const RigFile again = ParseRig(RigText(rig));
  EXPECT_EQ(again.instrument->tip_offsets, rig.instrument->tip_offsets);
  EXPECT_FALSE(json::parse(RigText(rig))["scope"].contains("tip_offsets")) << "left out where 0";
}

TEST(RigIo, TheSchemaForOtherToolsIsTheGeneratedOne) {
  const fs::path copy = fs::path(ARTHRO_SOURCE_DIR) / "resources/schemas/rig-1.schema.json";
  EXPECT_EQ(ReadWholeFile(copy), RigSchemaText())
      << "a field of the rig has changed; write the schema anew: arthroscene check --rig-schema > "
      << copy.string();
}

TEST(RigIo, TwoHandsOfOneHydraNeedNoSerial) {
  json rig = {{"schema", "arthroscene.rig/1"}, {"title", "Hydra"}};
  for (const char* role : {"scope", "instrument"})
    rig[role] = {{"device", {{"family", "razer_hydra"}, {"hand", *role == 's' ? 0 : 1}}},
                 {"rod_length", 0.2}};
  EXPECT_EQ(Refusal(rig.dump()), "");
  rig["instrument"]["device"]["hand"] = 0;
  EXPECT_NE(Refusal(rig.dump()).find("or by hand"), std::string::npos) << Refusal(rig.dump());
}

TEST(RigIo, KnowsTheFamiliesAndModelsThatThereAre) {
  const auto families = simulation::AllFamilies();
  std::set<std::string> words{simulation::kOpenHapticsWord};
  for (const simulation::DeviceFamily family : families) words.insert(ToString(family));
  EXPECT_EQ(words, std::set<std::string>(RigFamilies().begin(), RigFamilies().end()));
  for (const auto& model : simulation::WoodenModels())
    EXPECT_TRUE(FitsSchema(Changed([&](json& j) { j["scope"]["device"]["model"] = model.word; })))
        << model.word;
}

TEST(RigIo, ShippedRigsReadAndPointIntoTheJoint) {
  int count = 0;
  for (const auto& entry :
       fs::directory_iterator(fs::path(ARTHRO_SOURCE_DIR) / "resources/presets/rigs")) {
    SCOPED_TRACE(entry.path());
    const RigFile rig = ReadRig(entry.path());
    EXPECT_TRUE(FitsSchema(json::parse(ReadWholeFile(entry.path()))));
    ++count;
    for (const auto& role : {rig.scope, rig.instrument}) {
      if (!role) continue;
      const DeviceRig& mount = role->mount;
      const bool is_mouse = role->device.family == "space_mouse";
      const bool is_touch = role->device.family == "openhaptics";
      // A person in front of the device pushes away to go in, and up is up. An arm's x points
      // towards the person and its z is up; a knob's y does, and z is down; a Touch's z, and y is
      // up.
      const glm::dvec3 away = is_touch   ? glm::dvec3(0, 0, -1)
                              : is_mouse ? glm::dvec3(0, -1, 0)
                                         : glm::dvec3(-1, 0, 0);
      const glm::dvec3 up = is_touch   ? glm::dvec3(0, 1, 0)
                            : is_mouse ? glm::dvec3(0, 0, -1)
                                       : glm::dvec3(0, 0, 1);
      EXPECT_LT(glm::distance(mount.portal_from_device * away, glm::dvec3(0, 0, 1)), 1e-12);
      EXPECT_LT(glm::distance(mount.portal_from_device * up, glm::dvec3(0, -1, 0)), 1e-12);
      const glm::dvec3 rest = RestingHip(mount, 0.05);
      EXPECT_NEAR(glm::distance(rest, mount.pivot), 0.15, 1e-12);
      EXPECT_GT(glm::dot(mount.pivot - rest, away), 0.15 - 1e-12);
    }
  }
  EXPECT_EQ(count, 4);
}

// All of it but the pivot, also what ParseRig passes over, and in its order.
TEST(RigIo, APivotIsWrittenAndAllElseStaysAsItIs) {
  const glm::dvec3 pivot(0.1 + 1e-17, -1.0 / 3.0, 2.5e-5);
  const std::string with = RigTextWith({pivot, {}}, Whole().dump());
  EXPECT_EQ(ParseRig(with).scope->mount.pivot, pivot) << "to the last bit";
  json expected = Whole();
  expected["scope"]["pivot"] = {pivot.x, pivot.y, pivot.z};
  EXPECT_EQ(json::parse(with), expected);
  EXPECT_TRUE(FitsSchema(json::parse(with)));
  EXPECT_EQ(RigTextWith({pivot, {}}, with), with);
  const std::string ordered = RigTextWith({{}, pivot}, R"({"title": "t",
    "schema": "arthroscene.rig/1",
    "instrument": {"rod_length": 0.2, "device": {"family": "space_mouse"}}})");
  EXPECT_LT(ordered.find("title"), ordered.find("schema"));
  EXPECT_EQ(ParseRig(ordered).instrument->mount.pivot, pivot) << "it had none";
}

TEST(RigIo, APivotThatCannotBeWrittenLeavesTheFileAsItIs) {
  const test::TempFolder folder;
  const fs::path file = folder / "rig.json";
  const std::string text = Changed([](json& rig) { rig.erase("pedals"); }).dump();
  WriteAtomically(file, text);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(WriteRigWith({glm::dvec3(nan), {}}, file, file), Error);
  EXPECT_THROW(WriteRigWith({glm::dvec3(1e9), {}}, file, file), Error);
  EXPECT_THROW(WriteRigWith({glm::dvec3(0), {}}, file, folder / "nowhere" / "rig.json"), Error);
  EXPECT_EQ(ReadWholeFile(file), text);
  EXPECT_THROW(RigTextWith({glm::dvec3(0), {}}, R"({"schema": "arthroscene.rig/1", "title": "t",
    "instrument": {"rod_length": 0.2, "device": {"family": "space_mouse"}}})"),
               Error);
  WriteRigWith({glm::dvec3(0.01, 0, 0), {}}, file, folder / "copy.json");
  EXPECT_EQ(ReadRig(folder / "copy.json").scope->mount.pivot.x, 0.01);
  EXPECT_EQ(ReadWholeFile(file), text) << "a copy elsewhere";
}

}  // namespace
}  // namespace arthro
