// A force device that holds the scope in a practice: when it pushes and when it must not.
#include <array>
#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "simulation/practice/hands/hands.h"
#include "simulation/practice/hands/practice.h"
#include "tests/simulation/device/live/arm_bench.h"
#include "tests/support/fake_hidapi.h"
#include "tests/support/small_scene.h"
#include "tests/support/temp_folder.h"
#include "tests/support/ticks.h"

namespace arthro::simulation {
namespace {

using test::kFrame;

// A force device holds the scope 20 mm behind the wall, on the clock of the machine.
class PractisedArm : public testing::Test {
 protected:
  static constexpr const char* kPath = "/dev/fake0";
  void SetUp() override {
    loaded = LoadScene(test::WriteSmallScene(folder / "knee", false));
    HandsChoice choice;
    RigRole& scope = choice.rig.emplace().scope.emplace();
    scope.device.family = "wooden_haptics";
    scope.device.serial = "A";
    scope.device.model = "woodenhaptics_2015";
    scope.mount.rod_length = 0.3;
    // Pivot straight in from the home position of the arm.
    const double to_incision = 0.3 - loaded.scene.backdrop.radius - 0.02;
    scope.mount.pivot = glm::dvec3(0.025, 0, 0.205 + to_incision);
    LiveOptions options;
    options.list_every = 0.02;
    options.lock_folder = folder.path();
    hands = std::make_unique<Hands>(std::move(choice), nullptr, options);
    hands->Mount(loaded.scene);
    usb.Plug(test::WoodenArm(L"A", kPath));
    ASSERT_TRUE(test::WaitUntil([&] { return usb.opened(kPath) == 1; }));
    hands->AskHome(DeviceRole::kScope);
  }
  void Frame() {
    hands->Look();
    if (practice) practice->Advance(kFrame, hands.get());
  }
  bool FramesUntil(const std::function<bool()>& is_so) {
    return test::WaitUntil([&] {
      Frame();
      return is_so();
    });
  }
  bool IsPushed() { return test::CurrentsAt(usb, kPath) != std::array<int, 3>{}; }
  // Begins a practice and waits until the wall pushes it.
  bool Begin() {
    practice.emplace(std::make_unique<Session>(loaded), loaded);
    hands->HoldDeadMan(false);
    const auto state = [&] { return hands->Now(DeviceRole::kScope).situation.status.state; };
    if (!FramesUntil([&] { return state() == DeviceState::kReady; })) return false;
    hands->HoldDeadMan(true);
    return FramesUntil([&] { return IsPushed(); });
  }
  bool IsLetGo() {
    return test::WaitUntil([&] { return !IsPushed(); });
  }

  test::TempFolder folder;
  LoadedScene loaded;
  test::FakeUsb usb;
  test::Board board{usb, kPath};
  std::unique_ptr<Hands> hands;
  std::optional<Practice> practice;
};

TEST_F(PractisedArm, IsPushedOnlyWhileAPracticeRuns) {
  FramesUntil(
      [&] { return hands->Now(DeviceRole::kScope).situation.status.state == DeviceState::kReady; });
  hands->HoldDeadMan(true);
  EXPECT_STREQ(WhyNoForce(hands->Now(DeviceRole::kScope).situation),
               "Devices push only in a practice; F5 begins one.")
      << hands->Now(DeviceRole::kScope).sentence;
  ASSERT_TRUE(Begin());
  EXPECT_TRUE(hands->Leads(DeviceRole::kScope));
  // Limits of the device: a viscous spring is stable to 781 N/m, at 3.3 N.
  EXPECT_LE(hands->Now(DeviceRole::kScope).given, hands->Now(DeviceRole::kScope).peak);

  // Esc.
  practice.reset();
  EXPECT_TRUE(IsLetGo());
  EXPECT_FALSE(hands->Leads(DeviceRole::kScope));
  for (int i = 0; i < 50; ++i) {
    Frame();
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    ASSERT_FALSE(IsPushed()) << i;
  }
  EXPECT_TRUE(Begin()) << "and in the next one again";
}

TEST_F(PractisedArm, GetsNoForceWithoutDeadManInZeroForceModeOrWithAHangingWindow) {
  ASSERT_TRUE(Begin());
  hands->HoldDeadMan(false);
  EXPECT_TRUE(FramesUntil([&] { return !IsPushed(); }));
  hands->HoldDeadMan(true);
  const auto felt = [&] { return hands->Now(DeviceRole::kScope).felt; };
  ASSERT_TRUE(FramesUntil([&] { return felt() > 0.3; }));
  EXPECT_GT(hands->Now(DeviceRole::kScope).given, 0.1);
  hands->SetZeroForce(true);
  EXPECT_TRUE(FramesUntil([&] { return !IsPushed(); }));
  ASSERT_TRUE(FramesUntil([&] { return felt() > 0.3; })) << "it is shown on";
  EXPECT_FALSE(IsPushed());
  EXPECT_EQ(hands->Now(DeviceRole::kScope).given, 0);
  hands->SetZeroForce(false);
  ASSERT_TRUE(FramesUntil([&] { return IsPushed(); }));
  // A window that hangs shows no frames; the dead-man may long be let go.
  EXPECT_TRUE(IsLetGo());
}

// However the dead-man is held; and it comes back by a ramp, where the incision then is.
TEST_F(PractisedArm, GetsNoForceDuringACalibrationAndARampAfterIt) {
  ASSERT_TRUE(Begin());
  hands->Calibrate(DeviceRole::kInstrument);
  ASSERT_TRUE(FramesUntil([&] { return !IsPushed(); })) << "whichever hand it is";
  for (int i = 0; i < 60; ++i) {
    Frame();
    ASSERT_FALSE(IsPushed()) << i;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  const auto state = [&] { return hands->Now(DeviceRole::kScope).situation.status.state; };
  EXPECT_EQ(state(), DeviceState::kReady) << "not armed";
  EXPECT_NE(std::string(WhyNoForce(hands->Now(DeviceRole::kScope).situation)).find("calibrated"),
            std::string::npos);
  EXPECT_GT(glm::length(practice->snapshot().scope.tip_force), 0.1) << "it is deep in the wall";

  DeviceRig mount = hands->MountOf(DeviceRole::kScope, loaded.scene);
  mount.pivot += glm::dvec3(0, 0, -0.001);
  practice->SetMount(DeviceRole::kScope, mount);
  hands->Calibrate({});
  EXPECT_TRUE(FramesUntil([&] { return IsPushed(); }));
  EXPECT_EQ(state(), DeviceState::kArmed);
}

TEST_F(PractisedArm, GetsNoForceAfterAnException) {
  ASSERT_TRUE(Begin());
  try {
    const std::unique_ptr<Hands> own = std::move(hands);
    const std::optional<Practice> running = std::move(practice);
    practice.reset();
    throw std::runtime_error("anything");
  } catch (const std::runtime_error&) {
  }
  EXPECT_EQ(usb.opened(kPath), 0);
  const auto written = usb.Written(kPath);
  ASSERT_GE(written.size(), 5u);
  for (std::size_t i = written.size() - 5; i < written.size(); ++i)
    EXPECT_EQ(written[i], test::Bytes(15)) << i;
}

}  // namespace
}  // namespace arthro::simulation
