// The job `devices`, as the program runs it, on an arm behind the kernel's own HID [inside the
// guest]. How fast the guest is is the host's affair: the self-test may find the arm too slow, and
// must then say so.
#include <algorithm>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "app/cli/jobs.h"
#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"
#include "simulation/device/log/log_replay.h"
#include "tests/device_vm/arm_process.h"
#include "tests/device_vm/when_listed.h"
#include "tests/support/temp_folder.h"

namespace arthro::test {
namespace {

using namespace simulation;

// Sentence of the refusal; empty after exit 0.
std::string Devices(std::vector<std::string> flags) {
  CLI::App program;
  app::AddDevicesJob(program);
  flags.insert(flags.begin(), "devices");
  std::reverse(flags.begin(), flags.end());  // CLI11 takes them in reverse
  try {
    program.parse(flags);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(DevicesJobVm, ListsTriesAndLogsAnArmAndTheLogIsTheSameWhenItIsPlayed) {
  ArmProcess board("WH-A");
  ASSERT_EQ(WhenListed(1).size(), 1u);
  TempFolder folder;
  const std::string file = (folder / "d.json").string(), log_file = (folder / "d.log").string();
  const std::string model = "woodenhaptics_2015";

  EXPECT_EQ(Devices({"--model", model, "--json", file}), "");
  auto json = nlohmann::json::parse(ReadWholeFile(file));
  ASSERT_EQ(json["devices"].size(), 1u);
  EXPECT_EQ(json["devices"][0]["serial"], "WH-A");
  EXPECT_EQ(json["devices"][0]["number"], "1234:0006");
  EXPECT_EQ(json["devices"][0]["can_be_used"], true) << json.dump(2);

  board.Do("move 1");
  const std::string refusal = Devices(
      {"--self-test", "--seconds", "1", "--model", model, "--json", file, "--log", log_file});
  json = nlohmann::json::parse(ReadWholeFile(file));
  const auto& trial = json["devices"][0]["self_test"];
  fmt::print("self-test: {} at {:.0f} reports a second\n", trial["sentence"].get<std::string>(),
             trial["rate"].get<double>());
  EXPECT_EQ(refusal.empty(), trial["passed"].get<bool>()) << refusal;
  EXPECT_GT(trial["taken"].get<long>(), 0);
  EXPECT_EQ(trial["rejected"].get<long>(), 0);
  const bool is_fast = trial["rate"].get<double>() >= 800 && trial["full_rings"].get<long>() == 0;
  EXPECT_EQ(trial["passed"].get<bool>(), is_fast) << trial.dump(2);
  for (const ArmRecord& record : board.Records())
    if (record.event == ArmEvent::kTold) {
      EXPECT_EQ(record.currents, (std::array<std::int16_t, 3>{})) << "a self-test gives no force";
    }

  const DeviceLogContent log = ReadDeviceLog(log_file);
  EXPECT_EQ(log.torn, "");
  EXPECT_EQ(log.missing, 0);
  ASSERT_EQ(log.sources.size(), 1u);
  EXPECT_EQ(log.sources[0].serial, "WH-A");
  const ReportReplay replay = ReplayReports(log, 0);
  EXPECT_GE(replay.reports, trial["taken"].get<long>());
  EXPECT_EQ(replay.different, 0) << "first at " << replay.first_different << " s";
}

}  // namespace
}  // namespace arthro::test
