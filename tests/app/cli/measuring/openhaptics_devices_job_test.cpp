// The job `devices` where OpenHaptics is installed: a fake library, whose scheduler is a thread
// here.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <thread>

#include <CLI/CLI.hpp>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "app/cli/jobs.h"
#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"
#include "simulation/device/live/live_link.h"
#include "simulation/device/log/log_format.h"
#include "tests/support/fake_hidapi.h"
#include "tests/support/fake_openhaptics.h"
#include "tests/support/temp_folder.h"

namespace arthro::app {
namespace {

using test::OpenHaptics;

class ListedTouches : public testing::Test {
 protected:
  ListedTouches() {
    OpenHaptics().Reset();
    OpenHaptics().devices.resize(2);
    OpenHaptics().devices[0].name = "left";
    OpenHaptics().devices[1].name = "right";
    OpenHaptics().devices[1].serial = "T2";
  }
  ~ListedTouches() override {
    stop_ = true;
    scheduler_.join();
  }
  // Returns its output; `refusal` is empty when it did all.
  std::string Devices(std::vector<std::string> flags) {
    CLI::App program;
    AddDevicesJob(program);
    flags.insert(flags.begin(), "devices");
    std::reverse(flags.begin(), flags.end());
    refusal.clear();
    testing::internal::CaptureStdout();
    try {
      program.parse(flags);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), Code::kDevice);
      refusal = error.what();
    }
    std::fflush(stdout);
    return testing::internal::GetCapturedStdout();
  }
  nlohmann::json Json(std::vector<std::string> flags) {
    flags.insert(flags.end(), {"--json", (folder / "d.json").string()});
    Devices(flags);
    return nlohmann::json::parse(ReadWholeFile(folder / "d.json"));
  }

  test::TempFolder folder;
  test::FakeUsb usb;  // nothing is plugged in
  std::string refusal;

 private:
  std::atomic<bool> stop_{false};
  // A tick a millisecond, all of them, however late.
  std::thread scheduler_{[this] {
    const double begin = simulation::SteadySeconds();
    for (long ticks = 0; !stop_; std::this_thread::sleep_for(std::chrono::milliseconds(1)))
      for (; static_cast<double>(ticks) < 1e3 * (simulation::SteadySeconds() - begin); ++ticks)
        OpenHaptics().Tick();
  }};
};

TEST_F(ListedTouches, TheDefaultIsListedWithWhatItCanDo) {
  const std::string text = Devices({});
  EXPECT_EQ(refusal, "");
  for (const char* part : {"Touch (OpenHaptics)", "the setup tool's default, maker's number T1",
                           "force to 3.3 N (0.88 N for long) and 400 N/m, 2 buttons", "is open"})
    EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
  const auto json = Json({});
  EXPECT_EQ(json["openhaptics"]["built"], true);
  ASSERT_EQ(json["devices"].size(), 1u);
  EXPECT_EQ(json["devices"][0]["family"], "openhaptics");
  EXPECT_EQ(json["devices"][0]["serial"], "") << "as a rig names it";
  EXPECT_EQ(json["devices"][0]["caps"]["feedback"], "force");
  EXPECT_EQ(OpenHaptics().wrong_calls, 0);
  EXPECT_FALSE(OpenHaptics().devices[0].is_open) << "closed again";
}

TEST_F(ListedTouches, OthersAreListedByTheirNamesAndOneThatIsNotThereSaysSo) {
  OpenHaptics().devices[0].opens = false;
  const auto json = Json({"--openhaptics", "left", "--openhaptics", "right"});
  EXPECT_EQ(refusal, "");
  ASSERT_EQ(json["devices"].size(), 2u);
  EXPECT_EQ(json["devices"][0]["serial"], "left");
  EXPECT_EQ(json["devices"][0]["can_be_used"], false);
  EXPECT_EQ(json["devices"][1]["serial"], "right");
  EXPECT_EQ(json["devices"][1]["can_be_used"], true);
  EXPECT_NE(json["devices"][0]["sentence"].get<std::string>().find("could not be opened"),
            std::string::npos);
}

TEST_F(ListedTouches, WhereTheDefaultIsNotThereItIsAmongWhatWasLookedFor) {
  OpenHaptics().devices[0].opens = false;
  const std::string text = Devices({});
  EXPECT_EQ(refusal, "");
  EXPECT_NE(text.find("Touch and its kin: the default OpenHaptics device could not be opened"),
            std::string::npos)
      << text;
  Devices({"--self-test"});
  EXPECT_EQ(refusal, "there is no device to test; plug one in");
}

TEST_F(ListedTouches, TheSelfTestHearsItPassesGivesNoForceAndLogsItsTicks) {
  const std::string log = (folder / "d.log").string();
  const auto json = Json({"--self-test", "--seconds", "1", "--log", log});
  EXPECT_EQ(refusal, "");
  EXPECT_EQ(json["devices"][0]["self_test"]["passed"], true) << json.dump(2);
  for (const auto& force : OpenHaptics().devices[0].forces)
    EXPECT_EQ(force, (std::array<double, 3>{}));
  const auto content = simulation::ReadDeviceLog(log);
  ASSERT_FALSE(content.records.empty());
  EXPECT_EQ(content.records.back().kind, simulation::LogKind::kTick);
}

TEST_F(ListedTouches, TheSelfTestOfOneThatIsLostFails) {
  OpenHaptics().devices[0].errors = {0, 0, 0, 7};  // a broken line, at the fourth frame
  const auto json = Json({"--self-test", "--seconds", "0.2"});
  EXPECT_NE(refusal.find("1 of 1 devices failed"), std::string::npos) << refusal;
  EXPECT_EQ(json["devices"][0]["self_test"]["passed"], false);
}

}  // namespace
}  // namespace arthro::app
