// A Touch holds the instrument of a practice, behind a fake library with a scheduler thread: tests
// its pose in the scene and the force of the wall at its motors.
#include <HD/hd.h>
#include <atomic>
#include <chrono>
#include <functional>
#include <thread>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "simulation/core/units.h"
#include "simulation/device/log/log_replay.h"
#include "simulation/practice/hands/hands.h"
#include "simulation/practice/hands/practice.h"
#include "simulation/scene/json/rig_io.h"
#include "simulation/scope/rod_pose.h"
#include "tests/support/build_paths.h"
#include "tests/support/fake_openhaptics.h"
#include "tests/support/small_scene.h"
#include "tests/support/temp_folder.h"
#include "tests/support/ticks.h"

namespace arthro::simulation {
namespace {

using test::FakeTouch;
using test::OpenHaptics;

using test::kFrame;
constexpr DeviceRole kInstrument = DeviceRole::kInstrument;

// Scheduler thread of the library, about 1 kHz.
class SchedulerThread {
 public:
  ~SchedulerThread() {
    stop_ = true;
    thread_.join();
  }

 private:
  std::atomic<bool> stop_{false};
  std::thread thread_{[this] {
    while (!stop_) {
      OpenHaptics().Tick();
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }};
};

class PractisedTouch : public testing::Test {
 protected:
  PractisedTouch() {
    OpenHaptics().Reset();
    OpenHaptics().devices.resize(1);
    OpenHaptics().devices[0].name = "Default Device";
    loaded = LoadScene(test::WriteSmallScene(folder / "knee", false));
    rig = ReadRig(std::filesystem::path(ARTHRO_SOURCE_DIR) /
                  "resources/presets/rigs/touch_instrument.json");
    Place(kBehind);
  }
  void Make() {
    HandsChoice choice;
    choice.rig = rig;
    choice.log = log;
    hands = std::make_unique<Hands>(std::move(choice));
    hands->Mount(loaded.scene);
    Begin();
  }
  void Begin() { practice.emplace(std::make_unique<Session>(loaded), loaded); }
  // Moves the hand straight in until the tip is `behind` the wall, m.
  void Place(double behind) {
    const glm::dvec3 hip = RestingHip(rig.instrument->mount, loaded.scene.backdrop.radius + behind);
    const auto lock = test::HoldOpenHaptics();
    FakeTouch& touch = OpenHaptics().devices[0];
    for (int i = 0; i < 3; ++i)
      touch.position_mm[static_cast<std::size_t>(i)] = MmFromMetres(hip[i]);
  }
  template <class F>
  auto Touch(F&& use) {
    const auto lock = test::HoldOpenHaptics();
    return use(OpenHaptics().devices[0]);
  }
  glm::dvec3 LastForce() {
    return Touch([](FakeTouch& touch) {
      if (touch.forces.empty()) return glm::dvec3(0.0);
      const auto& f = touch.forces.back();
      return glm::dvec3(f[0], f[1], f[2]);
    });
  }
  bool IsPushed() { return LastForce() != glm::dvec3(0.0); }
  void HoldStylusButton(bool is_held) {
    Touch([&](FakeTouch& touch) { touch.buttons = is_held ? 1 : 0; });
  }
  DeviceState state() { return hands->Now(kInstrument).situation.status.state; }
  void Frame() {
    hands->Look();
    if (practice) practice->Advance(kFrame, hands.get());
  }
  // Waits at least five minutes, as a bound against a hang.
  bool FramesUntil(const std::function<bool()>& is_so) {
    for (int i = 0; i < 60000 && !is_so(); ++i) {
      Frame();
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return is_so();
  }
  bool Until(const std::function<bool()>& is_so) {
    for (int i = 0; i < 300000 && !is_so(); ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    return is_so();
  }
  // Holds the button that the rig binds, and releases it where the device asks for it, which
  // happens when this machine stalls.
  bool HeldUntil(const std::function<bool()>& is_so) {
    return FramesUntil([&] {
      HoldStylusButton(!hands->Now(kInstrument).situation.status.must_release);
      return is_so();
    });
  }
  bool Push() {
    return HeldUntil([&] { return IsPushed(); });
  }

  static constexpr double kBehind = 0.005;  // m
  test::TempFolder folder;
  LoadedScene loaded;
  RigFile rig;
  std::filesystem::path log;
  SchedulerThread scheduler;
  std::unique_ptr<Hands> hands;
  std::optional<Practice> practice;
};

TEST_F(PractisedTouch, PoseLeadsTheInstrumentAndTheMouseLeadsTheScope) {
  Make();
  ASSERT_TRUE(FramesUntil([&] { return hands->Leads(kInstrument); }));
  EXPECT_FALSE(hands->Leads(DeviceRole::kScope));
  EXPECT_EQ(hands->Now(kInstrument).name, "Touch");
  EXPECT_EQ(hands->Now(kInstrument).serial, "T1");
  EXPECT_EQ(hands->Missing(kInstrument), "");
  const double depth = loaded.scene.backdrop.radius + kBehind;
  const auto told = [&] { return practice->snapshot().instrument.pose; };
  EXPECT_TRUE(FramesUntil([&] { return std::abs(told().depth - depth) < 1e-9; })) << told().depth;
  // A hand moving right turns the rod about its incision, so the tip moves left.
  Touch([](FakeTouch& touch) { touch.position_mm[0] = 10; });
  const double turned = std::atan2(0.010, 0.2 - depth);
  EXPECT_TRUE(FramesUntil([&] { return std::abs(told().longitude + turned) < 1e-9; }))
      << told().longitude;
}

TEST_F(PractisedTouch, GetsForceWithinItsLimitsOnlyWhileTheBoundButtonIsHeld) {
  Make();
  const auto tip_force = [&] { return glm::length(practice->snapshot().instrument.tip_force); };
  ASSERT_TRUE(FramesUntil([&] { return hands->Leads(kInstrument) && tip_force() > 0.1; }))
      << "the wall is there";
  for (int i = 0; i < 20; ++i) Frame();
  Touch([](FakeTouch& touch) {
    for (const auto& force : touch.forces) EXPECT_EQ(force, (std::array<double, 3>{}));
  });
  EXPECT_NE(std::string(WhyNoForce(hands->Now(kInstrument).situation)).find("dead-man"),
            std::string::npos);

  ASSERT_TRUE(Push());
  // The force points out of the wall, towards the user.
  EXPECT_GT(LastForce().z, 0);
  EXPECT_TRUE(HeldUntil([&] { return glm::length(LastForce()) > 0.3; }));
  HoldStylusButton(false);
  EXPECT_TRUE(FramesUntil([&] { return !IsPushed(); }));
  ASSERT_TRUE(Push());
  hands->SetZeroForce(true);
  EXPECT_TRUE(FramesUntil([&] { return !IsPushed(); }));
  hands->SetZeroForce(false);
  ASSERT_TRUE(Push());
  // A hanging window shows no frames.
  EXPECT_TRUE(Until([&] { return !IsPushed(); }));
  Touch([](FakeTouch& touch) {
    for (const auto& f : touch.forces)
      EXPECT_LE(glm::length(glm::dvec3(f[0], f[1], f[2])), 3.3 + 1e-12);
  });
}

TEST_F(PractisedTouch, GetsNoForceAfterThePracticeAndTheProgramEnd) {
  Make();
  ASSERT_TRUE(Push());
  practice.reset();
  EXPECT_TRUE(Until([&] { return !IsPushed(); }));
  EXPECT_TRUE(Touch([](FakeTouch& touch) { return touch.is_open; })) << "kept for the next one";
  EXPECT_EQ(state(), DeviceState::kReady);
  Begin();
  ASSERT_TRUE(Push()) << "and in the next one again";
  practice.reset();
  EXPECT_EQ(hands->End(), "");
  Touch([](FakeTouch& touch) {
    EXPECT_FALSE(touch.is_open);
    ASSERT_GE(touch.forces.size(), 5u);
    for (std::size_t i = touch.forces.size() - 5; i < touch.forces.size(); ++i)
      EXPECT_EQ(touch.forces[i], (std::array<double, 3>{})) << i;
  });
  EXPECT_FALSE(OpenHaptics().is_running);
  EXPECT_EQ(OpenHaptics().wrong_calls, 0);
}

TEST_F(PractisedTouch, AfterALossTheMouseLeadsUntilTheNextPractice) {
  Make();
  ASSERT_TRUE(Push());
  Touch([](FakeTouch& touch) { touch.errors = {HD_COMM_ERROR}; });
  ASSERT_TRUE(FramesUntil([&] { return state() == DeviceState::kLost; }));
  EXPECT_FALSE(hands->Leads(kInstrument));
  EXPECT_TRUE(FramesUntil([&] { return !IsPushed(); }));
  EXPECT_EQ(hands->Missing(kInstrument), "Touch: lost (F4). Mouse and keys hold the instrument.");
  EXPECT_NE(hands->Now(kInstrument).sentence.find("begin the practice again"), std::string::npos)
      << hands->Now(kInstrument).sentence;
  practice.reset();
  Begin();
  EXPECT_TRUE(Push()) << "opened again";
  EXPECT_EQ(OpenHaptics().wrong_calls, 0);
}

TEST_F(PractisedTouch, AnAbsentDeviceLeavesItsHandToTheMouse) {
  Touch([](FakeTouch& touch) { touch.opens = false; });
  Make();
  for (int i = 0; i < 5; ++i) Frame();
  EXPECT_FALSE(hands->Leads(kInstrument));
  EXPECT_EQ(hands->Missing(kInstrument),
            "No OpenHaptics device: mouse and keys hold the instrument.");
  EXPECT_NE(hands->Now(kInstrument).sentence.find("could not be opened"), std::string::npos);
  practice->instrument().Advance({0, 0, 0, 0.002});
  const double depth = practice->instrument().pose().depth;
  EXPECT_TRUE(FramesUntil(
      [&] { return std::abs(practice->snapshot().instrument.pose.depth - depth) < 1e-9; }));
  Touch([](FakeTouch& touch) { touch.opens = true; });
  practice.reset();
  Begin();
  EXPECT_TRUE(FramesUntil([&] { return hands->Leads(kInstrument); }));
}

TEST_F(PractisedTouch, LogsEachTickOfThePractice) {
  log = folder / "practice.log";
  Make();
  ASSERT_TRUE(Push());
  ASSERT_TRUE(HeldUntil([&] { return glm::length(LastForce()) > 0.3; }));
  practice.reset();
  EXPECT_EQ(hands->End(), "");
  const DeviceLogContent content = ReadDeviceLog(log);
  double pushed = 0;
  for (const LogRecord& record : content.records)
    if (content.sources[record.source].roles[0] == kInstrument &&
        record.status.state == DeviceState::kArmed)
      pushed = std::max(pushed, glm::length(record.command));
  EXPECT_GT(pushed, 0.3);
  EXPECT_FALSE(RecordingOf(content).rows.empty());
}

TEST(OpenHapticsRig, IsAcceptedWhereTheLibraryIsInstalled) {
  EXPECT_NO_THROW(ReadHands(
      std::filesystem::path(ARTHRO_SOURCE_DIR) / "resources/presets/rigs/touch_instrument.json",
      ""));
}

}  // namespace
}  // namespace arthro::simulation
