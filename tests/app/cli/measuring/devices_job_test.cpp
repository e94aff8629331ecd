// On any machine: whether it has devices or not is not the test's affair.
#include <filesystem>
#include <set>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "simulation/device/hid/hid_node.h"
#include "tests/support/run_program.h"
#include "tests/support/temp_folder.h"

namespace arthro::test {
namespace {

TEST(DevicesJob, ListsAsJsonWhatItLookedForAndFound) {
  const ProgramResult run = RunProgram("devices --json -");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto json = nlohmann::json::parse(run.out);
  EXPECT_EQ(json["schema"], "arthroscene.devices/1");
  std::set<std::string> families;
  std::size_t numbers = 0;
  for (const auto& entry : json["looked_for"]) {
    families.insert(entry["family"]);
    numbers += entry["numbers"].size();
  }
  EXPECT_EQ(families.size(), simulation::AllFamilies().size());
  EXPECT_EQ(numbers, simulation::KnownNumbers().size());
  EXPECT_GE(json["hid_devices"].get<std::size_t>(), json["devices"].size());
}

TEST(DevicesJob, WhereThereIsNoneSaysWhatItLookedForAndWhatToTry) {
  const auto json = nlohmann::json::parse(RunProgram("devices --json -").out);
  if (!json["devices"].empty()) GTEST_SKIP() << "SKIPPED: a haptic device is plugged in here";
  const ProgramResult run = RunProgram("devices");
  EXPECT_EQ(run.exit_code, 0);
  for (const char* part :
       {"No haptic device", "WoodenHaptics", "256f:c635", "--watch", "mouse", "Touch and its kin"})
    EXPECT_NE(run.out.find(part), std::string::npos) << part << "\n" << run.out;
  const ProgramResult test = RunProgram("devices --self-test");
  EXPECT_EQ(test.exit_code, 1);
  EXPECT_NE(test.err.find("no device to test"), std::string::npos) << test.err;
  EXPECT_EQ(RunProgram("devices --watch --seconds 0.1").exit_code, 0);
}

TEST(DevicesJob, WithoutTheMakersLibrarySaysWhatATouchNeeds) {
  const auto json = nlohmann::json::parse(RunProgram("devices --json -").out);
  if (json["openhaptics"]["built"]) GTEST_SKIP() << "SKIPPED: OpenHaptics is installed here";
  EXPECT_EQ(json["openhaptics"]["sentence"],
            "this program was built without OpenHaptics, through which a Touch and its kin speak; "
            "install it (HD/hd.h, libHD) and build this program again");
  for (const char* words :
       {"devices --openhaptics left", "devices --first-hour --openhaptics left"}) {
    const ProgramResult named = RunProgram(words);
    EXPECT_EQ(named.exit_code, 1);
    EXPECT_NE(named.err.find("--openhaptics left: this program was built without OpenHaptics"),
              std::string::npos)
        << named.err;
  }
}

TEST(DevicesJob, TheFirstHourWithoutAForceDeviceIsRefusedAndWritesNothing) {
  const TempFolder temp;
  const auto page = temp / "page.txt";
  const ProgramResult run =
      RunProgram("devices --first-hour --serial nobody --record " + page.string());
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_NE(run.err.find("--serial nobody"), std::string::npos) << run.err;
  EXPECT_FALSE(std::filesystem::exists(page));
}

TEST(DevicesJob, RefusesFlagsThatContradict) {
  EXPECT_EQ(RunProgram("devices --first-hour --self-test").exit_code, 2);
  EXPECT_EQ(RunProgram("devices --record page.txt").exit_code, 2);
  EXPECT_EQ(RunProgram("devices --serial 7").exit_code, 2);
  EXPECT_EQ(RunProgram("devices --watch --self-test").exit_code, 2);
  EXPECT_EQ(RunProgram("devices --seconds -1").exit_code, 2);
}

TEST(DevicesJob, RefusesAModelThatItDoesNotKnowWithThoseThatItDoes) {
  for (const auto& [model, says] :
       {std::pair("word", "there is no arm"), std::pair("polhem_v3", "not published"),
        std::pair("Polhem_v1", "there is no arm")})
    for (const std::string how : {"", " --self-test", " --watch --seconds 0.1"}) {
      const ProgramResult run = RunProgram(std::string("devices --model ") + model + how);
      EXPECT_EQ(run.exit_code, 1) << model << how;
      EXPECT_NE(run.err.find(says), std::string::npos) << run.err;
      EXPECT_NE(run.err.find("woodenhaptics_2015 or polhem_v1"), std::string::npos) << run.err;
      EXPECT_EQ(run.out, "") << how;
    }
  EXPECT_EQ(RunProgram("devices --model polhem_v1").exit_code, 0);
}

}  // namespace
}  // namespace arthro::test
