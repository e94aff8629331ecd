// Devices behind a fake library of the maker, whose scheduler is ticked by the test on the clock of
// the test.
#include "simulation/device/openhaptics/openhaptics_devices.h"

#include <HD/hd.h>
#include <array>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <filesystem>
#include <limits>
#include <memory>
#include <thread>
#include <unistd.h>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "simulation/core/atomic_file.h"
#include "simulation/device/live/release_on_crash.h"
#include "tests/support/allocation_counter.h"
#include "tests/support/fake_openhaptics.h"
#include "tests/support/temp_folder.h"

namespace arthro::simulation {
namespace {

using test::FakeTouch;
using test::OpenHaptics;

double now = 0;  // s
double Now() noexcept { return now; }

const std::array<double, 3> kNoForce{};
const glm::dvec3 kForce{0.5, -0.25, 1.0};

class OpenHapticsTest : public testing::Test {
 protected:
  OpenHapticsTest() {
    OpenHaptics().Reset();
    now = 100;
    OpenHaptics().devices.resize(2);
    OpenHaptics().devices[0].name = "left";
    OpenHaptics().devices[1].name = "right";
    OpenHaptics().devices[1].serial = "T2";
  }
  void Open() {
    devices = std::make_unique<OpenHapticsDevices>(std::vector<std::string>{"left", "right"}, Now);
    Hold();
  }
  // Makes the hands as a beginning practice does.
  void Hold() {
    hands.clear();
    devices->OpenMissing();
    for (std::size_t i = 0; i < devices->size(); ++i) hands.push_back(devices->Hand(i));
  }
  void End() {
    hands.clear();
    devices.reset();
  }
  // Ticks the thread of the library and the servo, one after the other.
  DeviceSample Tick(int ticks = 1, const glm::dvec3& force = {}) {
    DeviceSample sample;
    for (int i = 0; i < ticks; ++i) {
      now += 1e-3;
      OpenHaptics().Tick();
      for (std::size_t k = 0; k < hands.size(); ++k) {
        const DeviceSample read = hands[k]->Read(now);
        if (k == 0) sample = read;
        hands[k]->HoldDeadMan(is_held);
        hands[k]->Command(force);
      }
    }
    return sample;
  }
  void Arm() {
    Open();
    Tick(10);
    is_held = true;
    Tick(10);
    ASSERT_EQ(hands[0]->state(), DeviceState::kArmed);
  }
  static FakeTouch& Left() { return OpenHaptics().devices[0]; }
  static FakeTouch& Right() { return OpenHaptics().devices[1]; }
  static glm::dvec3 LastForce(const FakeTouch& touch) {
    const auto& f = touch.forces.back();
    return {f[0], f[1], f[2]};
  }
  std::unique_ptr<OpenHapticsDevices> devices;
  std::vector<std::unique_ptr<Device>> hands;
  bool is_held = false;
};

TEST_F(OpenHapticsTest, ReportsPositionAndOrientation) {
  Left().position_mm = {10, -20, 30};
  // A quarter turn about z maps x to y.
  Left().transform = {0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 10, -20, 30, 1};
  Left().buttons = 3;
  Open();
  const DeviceSample sample = Tick(5);
  EXPECT_TRUE(sample.valid);
  EXPECT_LT(glm::length(sample.hip_in_device - glm::dvec3(0.01, -0.02, 0.03)), 1e-15);
  EXPECT_LT(glm::length(sample.handle_in_device * glm::dvec3(1, 0, 0) - glm::dvec3(0, 1, 0)),
            1e-15);
  EXPECT_EQ(sample.buttons, 3u);
  EXPECT_EQ(sample.t, now);
  EXPECT_EQ(hands[1]->serial(), "T2");
}

TEST_F(OpenHapticsTest, ReportsItsCapabilities) {
  Open();
  const DeviceCaps& caps = hands[0]->caps();
  EXPECT_TRUE(HasForce(caps));
  EXPECT_TRUE(IsSteady(caps));
  EXPECT_EQ(caps.sensed_dof, 6);
  EXPECT_DOUBLE_EQ(caps.peak_force, 3.3);
  EXPECT_DOUBLE_EQ(caps.max_stiffness, 400);
  EXPECT_DOUBLE_EQ(caps.damping, 0.2);
  EXPECT_DOUBLE_EQ(caps.min_hip.x, -0.08);
  EXPECT_TRUE(Left().has_force_output);
}

TEST_F(OpenHapticsTest, PushesOnlyTheArmedHand) {
  Open();
  Tick(10, kForce);
  EXPECT_EQ(LastForce(Left()), glm::dvec3(0.0)) << "nobody holds the dead-man";
  is_held = true;
  Tick(3, kForce);
  EXPECT_EQ(LastForce(Left()), kForce);
  hands[1]->Command(2.0 * kForce);
  now += 1e-3;
  OpenHaptics().Tick();
  EXPECT_EQ(LastForce(Left()), kForce);
  EXPECT_EQ(LastForce(Right()), 2.0 * kForce);
  is_held = false;
  Tick(3, kForce);
  EXPECT_EQ(LastForce(Left()), glm::dvec3(0.0));
  EXPECT_EQ(OpenHaptics().wrong_calls, 0);
}

// 9 and 11 ms: a tick is not a whole number of binary fractions of a second.
TEST_F(OpenHapticsTest, ASilentServoLeavesNoForce) {
  Arm();
  Tick(3, kForce);
  for (int i = 1; i <= 20; ++i) {
    now += 1e-3;
    OpenHaptics().Tick();
    if (i != 10) {
      EXPECT_EQ(LastForce(Left()), i < 10 ? kForce : glm::dvec3(0.0)) << i;
    }
  }
}

TEST_F(OpenHapticsTest, EndsWithFiveZeroForcesAndCloses) {
  Arm();
  Tick(3, kForce);
  const std::size_t before = Left().forces.size();
  End();
  ASSERT_EQ(Left().forces.size(), before + 5);
  for (std::size_t i = before; i < Left().forces.size(); ++i) {
    EXPECT_EQ(Left().forces[i], kNoForce);
    EXPECT_EQ(Right().forces[i], kNoForce);
  }
  EXPECT_FALSE(Left().is_open);
  EXPECT_FALSE(Right().is_open);
  EXPECT_FALSE(OpenHaptics().is_running);
  EXPECT_FALSE(OpenHaptics().Tick()) << "nothing is scheduled any more";
  EXPECT_EQ(OpenHaptics().wrong_calls, 0);
}

TEST_F(OpenHapticsTest, ReleaseGivesNoForceFromTheNextFrameOn) {
  Arm();
  Tick(3, kForce);
  devices->Release();
  Tick(3, kForce);
  EXPECT_EQ(LastForce(Left()), glm::dvec3(0.0));
}

TEST_F(OpenHapticsTest, WarmMotorsAreAFaultUntilTheDeadManIsReleased) {
  Arm();
  Tick(3, kForce);
  Left().errors = {HD_WARM_MOTORS};
  Tick(2, kForce);
  EXPECT_EQ(hands[0]->state(), DeviceState::kFault);
  EXPECT_EQ(hands[0]->status().reason, DeviceTrouble::kProtected);
  EXPECT_EQ(hands[1]->state(), DeviceState::kArmed) << "the other one goes on";
  Tick(20, kForce);
  EXPECT_EQ(hands[0]->state(), DeviceState::kFault) << "the dead-man is still held";
  EXPECT_EQ(LastForce(Left()), glm::dvec3(0.0));
  EXPECT_EQ(LastForce(Right()), kForce);
  is_held = false;
  Tick(10);
  is_held = true;
  Tick(10, kForce);
  EXPECT_EQ(hands[0]->state(), DeviceState::kArmed);
  EXPECT_EQ(LastForce(Left()), kForce);
}

TEST_F(OpenHapticsTest, ALostLinkStaysLost) {
  Arm();
  Tick(3, kForce);
  Left().errors = {HD_COMM_ERROR};
  const DeviceSample sample = Tick(1, kForce);
  EXPECT_EQ(hands[0]->state(), DeviceState::kLost);
  EXPECT_FALSE(sample.valid);
  Tick(1, kForce);
  EXPECT_EQ(LastForce(Left()), glm::dvec3(0.0));
  is_held = false;
  Tick(50);
  EXPECT_EQ(hands[0]->state(), DeviceState::kLost);
}

// Case of a hanging library thread.
TEST_F(OpenHapticsTest, ADeviceThatIsSilentFor20MillisecondsIsLost) {
  Arm();
  Tick(3, kForce);
  Device& left = *hands[0];
  for (int i = 1; i <= 21; ++i) {
    now += 1e-3;
    left.Read(now);
    left.HoldDeadMan(true);
    left.Command(kForce);
    if (i < 20) {
      EXPECT_EQ(left.state(), DeviceState::kArmed) << i;
    }
  }
  EXPECT_EQ(left.state(), DeviceState::kLost);
  EXPECT_EQ(left.status().reason, DeviceTrouble::kSilent);
}

TEST_F(OpenHapticsTest, HardCase6NaNGivesZeroAndAFault) {
  Arm();
  Tick(1, glm::dvec3(std::numeric_limits<double>::quiet_NaN(), 0, 0));
  Tick(1, kForce);
  EXPECT_EQ(hands[0]->state(), DeviceState::kFault);
  Tick(1);
  for (const auto& force : Left().forces) EXPECT_EQ(force, kNoForce);
}

TEST_F(OpenHapticsTest, IsHomedByTheLibraryOrWaitsForTheUser) {
  Left().calibration = HD_CALIBRATION_NEEDS_UPDATE;
  Right().calibration = HD_CALIBRATION_NEEDS_MANUAL_INPUT;
  Open();
  Tick(10);
  EXPECT_EQ(Left().calibrated, 1);
  EXPECT_EQ(hands[0]->state(), DeviceState::kReady);
  EXPECT_EQ(hands[1]->state(), DeviceState::kHoming);
  Right().calibration = HD_CALIBRATION_OK;  // the user put it into its rest
  Tick(110);
  EXPECT_EQ(hands[1]->state(), DeviceState::kReady);
}

TEST_F(OpenHapticsTest, NamesADeviceThatDoesNotOpenAndUsesTheOther) {
  Right().opens = false;
  Open();
  Tick(10);
  EXPECT_EQ(hands[0]->state(), DeviceState::kReady);
  EXPECT_EQ(hands[1]->state(), DeviceState::kAbsent);
  EXPECT_EQ(devices->Look(1).state, DeviceState::kAbsent);
  EXPECT_EQ(devices->detail(0), "");
  EXPECT_EQ(devices->detail(1),
            "the OpenHaptics device \"right\" could not be opened (no answer); check its power and "
            "cable, and its name in the maker's setup tool; it is tried again when a practice "
            "begins");
  EXPECT_FALSE(HasForce(hands[1]->caps())) << "nobody knows what it bears";

  // Switched on later: it is not opened while a servo runs, but for the next one.
  Right().opens = true;
  Tick(10);
  EXPECT_EQ(hands[1]->state(), DeviceState::kAbsent);
  Hold();
  Tick(10);
  EXPECT_EQ(hands[1]->state(), DeviceState::kReady);
  EXPECT_TRUE(HasForce(hands[1]->caps()));
  EXPECT_EQ(hands[1]->serial(), "T2");
  EXPECT_EQ(devices->detail(1), "");
  EXPECT_EQ(OpenHaptics().wrong_calls, 0);
}

TEST_F(OpenHapticsTest, SchedulesNothingWhereNoDeviceOpens) {
  Left().opens = Right().opens = false;
  Open();
  EXPECT_FALSE(OpenHaptics().is_running);
  Tick(3, kForce);
  EXPECT_TRUE(Left().forces.empty());
  End();
  EXPECT_EQ(OpenHaptics().wrong_calls, 0);
}

TEST_F(OpenHapticsTest, ReportsASchedulerThatDoesNotStartAndClosesTheDevices) {
  OpenHaptics().starts = false;
  Open();
  EXPECT_NE(devices->detail(0).find("scheduler of OpenHaptics did not start"), std::string::npos);
  EXPECT_EQ(hands[0]->state(), DeviceState::kAbsent);
  EXPECT_FALSE(Left().is_open);
  OpenHaptics().starts = true;
  Hold();
  Tick(10);
  EXPECT_EQ(hands[0]->state(), DeviceState::kReady);
  EXPECT_EQ(OpenHaptics().wrong_calls, 0);
}

TEST_F(OpenHapticsTest, TheNextServoNeedsAReleasedDeadMan) {
  Arm();
  Tick(3, kForce);
  Hold();
  Tick(20, kForce);
  EXPECT_EQ(hands[0]->state(), DeviceState::kReady);
  EXPECT_EQ(LastForce(Left()), glm::dvec3(0.0));
  is_held = false;
  Tick(5);
  is_held = true;
  Tick(5, kForce);
  EXPECT_EQ(LastForce(Left()), kForce);
}

TEST_F(OpenHapticsTest, OpensALostDeviceAgainForTheNextServo) {
  Arm();
  Left().errors = {HD_COMM_ERROR};
  Tick(3, kForce);
  EXPECT_EQ(hands[0]->state(), DeviceState::kLost);
  EXPECT_EQ(LastForce(Right()), kForce);
  EXPECT_EQ(devices->Look(0).state, DeviceState::kLost);
  EXPECT_NE(devices->detail(0).find("begin the practice again"), std::string::npos);
  is_held = false;
  const std::size_t before = Right().forces.size();
  Hold();
  ASSERT_EQ(Right().forces.size(), before + 5) << "without force while it is opened";
  for (std::size_t i = before; i < Right().forces.size(); ++i)
    EXPECT_EQ(Right().forces[i], kNoForce);
  Tick(10);
  is_held = true;
  Tick(10, kForce);
  EXPECT_EQ(LastForce(Left()), kForce);
  EXPECT_EQ(LastForce(Right()), kForce);
  EXPECT_EQ(devices->detail(0), "");
  EXPECT_EQ(OpenHaptics().wrong_calls, 0);
}

using OpenHapticsDeathTest = OpenHapticsTest;

TEST_F(OpenHapticsDeathTest, ACrashingProgramWritesZeroFirst) {
  test::TempFolder folder;
  const auto file = folder / "forces";
  const auto crash = [&] {
    Arm();
    Tick(3, kForce);
    const std::shared_ptr<OpenHapticsDevices> shared = std::move(devices);
    const ReleaseOnCrash guard({shared});
    const int out = ::open(file.c_str(), O_CREAT | O_WRONLY | O_APPEND, 0600);
    // Thread of the library; `now` is constant, so that the servo does not count as silent.
    std::thread scheduler([&] {
      for (;;) {
        OpenHaptics().Tick();
        const char said = LastForce(Left()) == kForce ? '1' : '0';
        if (::write(out, &said, 1) != 1) std::_Exit(3);
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      }
    });
    // Waits for ticks, at any rate.
    for (int i = 0; i < 300000 && std::filesystem::file_size(file) < 5; ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    std::abort();
  };
  EXPECT_EXIT(crash(), testing::KilledBySignal(SIGABRT), "");
  const std::string said = ReadWholeFile(file);
  EXPECT_EQ(said.front(), '1') << "it was pushed";
  EXPECT_EQ(said.back(), '0');
  EXPECT_EQ(said.find("01"), std::string::npos) << "and never again";
}

TEST_F(OpenHapticsTest, AFrameAndATickAllocateNothing) {
  Arm();
  Left().forces.reserve(1000);
  Right().forces.reserve(1000);
  const long before = test::Allocations();
  Tick(100, kForce);
  EXPECT_EQ(test::Allocations(), before);
}

}  // namespace
}  // namespace arthro::simulation
