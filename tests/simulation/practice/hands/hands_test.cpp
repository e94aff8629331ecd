// Devices that hold the hands of a practice (simulation/practice/hands/hands.h), on a fake bus.
// Plugged-in devices are read by the servo thread, so those tests wait for their result.
#include "simulation/practice/hands/hands.h"

#include <atomic>
#include <chrono>
#include <cmath>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "simulation/core/error.h"
#include "simulation/device/log/log_replay.h"
#include "simulation/practice/hands/practice.h"
#include "simulation/scope/rod_pose.h"
#include "tests/support/small_scene.h"
#include "tests/support/temp_folder.h"
#include "tests/support/ticks.h"

namespace arthro::simulation {
namespace {

using Bytes = std::vector<std::uint8_t>;

using test::kFrame;

// Socket of the bus: its device, the reports of the device and those written to it.
struct Socket {
  HidNode node;
  std::atomic<bool> is_plugged{false};
  std::mutex mutex;
  std::deque<Bytes> says;
  Bytes told;
  void Say(Bytes report) {
    const std::scoped_lock lock(mutex);
    says.push_back(std::move(report));
  }
  Bytes Told() {
    const std::scoped_lock lock(mutex);
    return told;
  }
};

class SocketLink final : public HidLink {
 public:
  explicit SocketLink(Socket& socket) : socket_(socket) {}
  int Read(std::span<std::uint8_t> report, int timeout_ms) noexcept override {
    if (!socket_.is_plugged) return kLinkIsDead;
    {
      const std::scoped_lock lock(socket_.mutex);
      if (!socket_.says.empty()) {
        const Bytes bytes = socket_.says.front();
        socket_.says.pop_front();
        std::copy(bytes.begin(), bytes.end(), report.begin());
        return static_cast<int>(bytes.size());
      }
    }
    if (timeout_ms > 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    return 0;
  }
  int Write(ReportBytes report) noexcept override {
    if (!socket_.is_plugged) return kLinkIsDead;
    const std::scoped_lock lock(socket_.mutex);
    socket_.told.assign(report.begin(), report.end());
    return static_cast<int>(report.size());
  }
  int SendFeature(ReportBytes report) noexcept override { return static_cast<int>(report.size()); }
  int GetFeature(std::span<std::uint8_t>) noexcept override { return 0; }

 private:
  Socket& socket_;
};

class SocketBus final : public HidBus {
 public:
  explicit SocketBus(std::deque<Socket>& sockets) : sockets_(sockets) {}
  std::vector<HidNode> List() override {
    std::vector<HidNode> nodes;
    for (Socket& socket : sockets_)
      if (socket.is_plugged) nodes.push_back(socket.node);
    return nodes;
  }
  std::unique_ptr<HidLink> Open(const HidNode& node, OpenFault& fault) override {
    for (Socket& socket : sockets_)
      if (socket.is_plugged && socket.node.path == node.path)
        return std::make_unique<SocketLink>(socket);
    fault = OpenFault::kGone;
    return nullptr;
  }

 private:
  std::deque<Socket>& sockets_;
};

// Push of a SpaceMouse, 350 counts at most.
Bytes Push(int x, int y, int z) {
  Bytes report(13, 0);
  report[0] = 1;
  int at = 1;
  for (const int value : {x, y, z}) {
    report[static_cast<std::size_t>(at++)] = static_cast<std::uint8_t>(value & 0xff);
    report[static_cast<std::size_t>(at++)] = static_cast<std::uint8_t>(value >> 8 & 0xff);
  }
  return report;
}

Bytes PadButtons(bool is_cross_down) {
  Bytes report(64, 0);
  report[0] = 1;
  report[5] = is_cross_down ? 0x28 : 0x08;  // no direction; cross
  return report;
}

class PractisedHands : public testing::Test {
 protected:
  void SetUp() override {
    loaded = LoadScene(test::WriteSmallScene(folder / "knee", false));
    auto& mouse = sockets.emplace_back();
    mouse.node = {0x256f, 0xc635, 1, 8, 0, false, "M1", "SpaceMouse", "socket-0"};
    auto& pad = sockets.emplace_back();
    pad.node = {0x054c, 0x09cc, 1, 5, 0, false, "P1", "DualShock 4", "socket-1"};
  }
  Hands& Make(HandsChoice choice) {
    LiveOptions options;
    options.list_every = 0.02;
    options.lock_folder = folder.path();
    hands =
        std::make_unique<Hands>(std::move(choice), std::make_unique<SocketBus>(sockets), options);
    hands->Mount(loaded.scene);
    practice.emplace(std::make_unique<Session>(loaded), loaded);
    return *hands;
  }
  void Frame() {
    hands->Look();
    practice->Advance(kFrame, hands.get());
  }
  // Shows frames until the condition holds, for at least five minutes as a bound against a hang.
  bool FramesUntil(const std::function<bool()>& is_so) {
    for (int i = 0; i < 60000 && !is_so(); ++i) {
      if (practice) Frame();
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return is_so();
  }
  static RigFile Rig() {
    RigFile rig;
    rig.scope.emplace().device.family = "space_mouse";
    rig.pedals.emplace().device.family = "dual_shock_4";
    rig.pedals->buttons = {-1, 0, -1};  // cross closes the jaws
    return rig;
  }

  test::TempFolder folder;
  LoadedScene loaded;
  std::deque<Socket> sockets;
  std::unique_ptr<Hands> hands;
  std::optional<Practice> practice;
};

TEST_F(PractisedHands, APluggedInDeviceTakesItsHandAndMouseAndKeysContinueAfterIt) {
  HandsChoice choice;
  choice.rig = Rig();
  Make(choice);
  Frame();
  EXPECT_FALSE(hands->Leads(DeviceRole::kScope));
  EXPECT_EQ(hands->Missing(DeviceRole::kScope), "No SpaceMouse: mouse and keys hold the scope.");
  EXPECT_EQ(hands->Missing(DeviceRole::kInstrument), "") << "the rig names none";
  const auto depth = [&] { return practice->snapshot().scope.pose.depth; };
  double meant = depth() + 0.002;
  practice->scope().Advance({0, 0, 0, 0.002});
  EXPECT_TRUE(FramesUntil([&] { return std::abs(depth() - meant) < 1e-9; })) << "mouse and keys";

  // Plugs it in and pushes it to the right.
  sockets[0].is_plugged = true;
  ASSERT_TRUE(FramesUntil([&] { return hands->Leads(DeviceRole::kScope); }));
  EXPECT_EQ(hands->Missing(DeviceRole::kScope), "");
  const glm::dvec3 tip = practice->snapshot().scope.tip_in_portal;
  ASSERT_TRUE(FramesUntil([&] {
    sockets[0].Say(Push(300, 0, 0));
    return glm::distance(practice->snapshot().scope.tip_in_portal, tip) > 1e-3;
  }));
  EXPECT_LT(practice->snapshot().scope.tip_in_portal.x, tip.x)
      << "a rod turns about its incision: hand right, tip left";

  // Unplugs it: the hand stays where it is, and keys move it further.
  sockets[0].is_plugged = false;
  ASSERT_TRUE(FramesUntil([&] { return !hands->Leads(DeviceRole::kScope); }));
  const glm::dvec3 left = practice->snapshot().scope.tip_in_portal;
  for (int i = 0; i < 20; ++i) {
    Frame();
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    ASSERT_LT(glm::distance(practice->snapshot().scope.tip_in_portal, left), 1e-4) << i;
  }
  meant = depth() + 0.002;
  practice->scope().Advance({0, 0, 0, 0.002});
  EXPECT_TRUE(FramesUntil([&] { return std::abs(depth() - meant) < 1e-6; })) << depth() - meant;
  EXPECT_NE(hands->Now(DeviceRole::kScope).last_fault.find("unplugged"), std::string::npos);

  // Plugs it in again.
  sockets[0].is_plugged = true;
  EXPECT_TRUE(FramesUntil([&] { return hands->Leads(DeviceRole::kScope); }));
}

TEST_F(PractisedHands, APadClosesTheJawsByItsButtonAndRumblesWithTheForce) {
  HandsChoice choice;
  choice.rig = Rig();
  Make(choice);
  sockets[1].is_plugged = true;
  sockets[1].Say(PadButtons(false));
  ASSERT_TRUE(FramesUntil([&] { return !sockets[1].Told().empty(); })) << "zero is written first";
  EXPECT_EQ(sockets[1].Told()[4], 0);
  ASSERT_TRUE(FramesUntil([&] {
    sockets[1].Say(PadButtons(true));
    return practice->snapshot().instrument.opening < 0.5;
  }));
  ASSERT_TRUE(FramesUntil([&] {
    sockets[1].Say(PadButtons(false));
    return practice->snapshot().instrument.opening > 0.9;
  }));

  // Moves into the wall and rests.
  practice->instrument().Advance({0, 0, 0, 0.1});
  const auto force = [&] { return glm::length(practice->snapshot().instrument.hand_force); };
  ASSERT_TRUE(FramesUntil([&] { return force() > 0.1; }));
  const auto amplitude = [&] { return std::lround(255 * std::min(1.0, force() / 3.3)); };
  EXPECT_TRUE(FramesUntil([&] { return std::abs(sockets[1].Told()[4] - amplitude()) <= 1; }))
      << int(sockets[1].Told()[4]) << " for " << amplitude();
  hands->SetZeroForce(true);
  EXPECT_TRUE(FramesUntil([&] { return sockets[1].Told()[4] == 0; }));
  EXPECT_GT(force(), 0.1) << "it is shown on";
  hands->SetZeroForce(false);
  ASSERT_TRUE(FramesUntil([&] { return sockets[1].Told()[4] > 0; }));
  practice.reset();
  EXPECT_TRUE(FramesUntil([&] { return sockets[1].Told()[4] == 0; }));
}

TEST_F(PractisedHands, ASimulatedHandIsPushedOnlyWhileArmed) {
  HandsChoice choice;
  choice.is_simulated = true;
  Make(choice);
  const auto frames = [&](int count) {
    for (int i = 0; i < count; ++i) Frame();
  };
  // Moves some millimetres into the wall.
  const auto pressed = [&] { return glm::length(practice->snapshot().instrument.tip_force); };
  for (int i = 0; i < 200 && pressed() < 1.0; ++i) {
    practice->instrument().Advance({0, 0, 0, 0.0005});
    frames(2);
  }
  const auto instrument = [&] { return hands->Now(DeviceRole::kInstrument); };
  frames(90);
  EXPECT_GT(glm::length(practice->snapshot().instrument.tip_force), 0.1);
  EXPECT_EQ(instrument().given, 0);
  EXPECT_NE(std::string(WhyNoForce(instrument().situation)).find("dead-man"), std::string::npos);
  const double unheld = practice->snapshot().instrument.penetration;

  hands->HoldDeadMan(true);
  frames(180);
  EXPECT_STREQ(WhyNoForce(instrument().situation), "");
  EXPECT_NEAR(instrument().given, instrument().felt, 1e-9);
  EXPECT_LT(practice->snapshot().instrument.penetration, unheld);
  // In the mean over two seconds the force balances the spring of the hand, 300 N/m, and at most
  // 0.26 N of friction per axis. A count of 0.055 mm is 0.017 N of that spring.
  const DeviceRig& rig = loaded.scene.rig.instrument;
  glm::dvec3 left(0.0);
  constexpr int kFrames = 120;
  for (int i = 0; i < kFrames; ++i) {
    Frame();
    const glm::dvec3 meant = HipFromRodPose(practice->instrument().pose(), rig);
    const glm::dvec3 is = HipFromRodPose(practice->snapshot().instrument.pose, rig);
    left += (practice->snapshot().instrument.hand_force + 300.0 * (meant - is)) / (1.0 * kFrames);
  }
  for (int axis = 0; axis < 3; ++axis) EXPECT_LE(std::abs(left[axis]), 0.26 + 0.017) << axis;

  hands->SetZeroForce(true);
  frames(60);
  EXPECT_EQ(instrument().given, 0);
  EXPECT_GT(instrument().felt, 0.1);
  EXPECT_NE(std::string(WhyNoForce(instrument().situation)).find("Zero-force"), std::string::npos);
  hands->SetZeroForce(false);
  frames(60);
  EXPECT_GT(instrument().given, 0.1);
  hands->HoldDeadMan(false);
  frames(1);
  EXPECT_EQ(instrument().given, 0);
}

TEST_F(PractisedHands, MouseAndKeysContinueAfterARecordingEnds) {
  // Records 0.5 s of the scope moving in by 5 mm, without the instrument.
  const DeviceRig& rig = loaded.scene.rig.scope;
  HandsChoice choice;
  for (const double t : {7.0, 7.5}) {
    TraceRow& row = choice.trace.emplace_back();
    row.sample.t = t;
    row.sample.valid = true;
    row.sample.hip_in_device = HipFromRodPose({0, 0, 0, 0.010 + 0.010 * (t - 7)}, rig);
  }
  Make(choice);
  for (int i = 0; i < 15; ++i) Frame();
  EXPECT_TRUE(hands->Leads(DeviceRole::kScope));
  EXPECT_FALSE(hands->Leads(DeviceRole::kInstrument));
  EXPECT_NEAR(practice->snapshot().scope.pose.depth, 0.010 + 0.010 * 0.25, 2e-5)
      << "to a tick of 1 ms";
  for (int i = 0; i < 30; ++i) Frame();
  EXPECT_FALSE(hands->Leads(DeviceRole::kScope));
  EXPECT_NEAR(practice->snapshot().scope.pose.depth, 0.015, 2e-5) << "it stays where it ended";
  practice->scope().Advance({0, 0, 0, 0.002});
  Frame();
  EXPECT_NEAR(practice->snapshot().scope.pose.depth, 0.017, 2e-5);
}

TEST_F(PractisedHands, LogsSamplesAndCommandsOfBothHands) {
  HandsChoice choice;
  choice.is_simulated = true;
  choice.log = folder / "practice.log";
  Make(choice);
  practice->instrument().Advance({0, 0, 0, 0.1});
  for (int i = 0; i < 120; ++i) {
    if (i == 60) hands->HoldDeadMan(true);
    Frame();
  }
  const double t = practice->snapshot().t;
  practice.reset();
  EXPECT_EQ(hands->End(), "");
  const DeviceLogContent log = ReadDeviceLog(folder / "practice.log");
  EXPECT_EQ(log.torn, "");
  EXPECT_EQ(log.missing, 0);
  ASSERT_EQ(log.sources.size(), 2u);
  double pushed = 0;
  for (const LogRecord& record : log.records)
    if (record.source == 1) pushed = std::max(pushed, glm::length(record.command));
  EXPECT_GT(pushed, 0.1);
  const auto trace = RecordingOf(log).rows;
  EXPECT_NEAR(static_cast<double>(trace.size()), 2e3 * t, 4) << "each tick, each hand";
  EXPECT_NEAR(trace.back().sample.t, t, 3e-3);
}

TEST_F(PractisedHands, RefusesALogThatCannotBeWritten) {
  HandsChoice choice;
  choice.is_simulated = true;
  choice.log = folder / "no such folder" / "practice.log";
  EXPECT_THROW(Make(choice), Error);
}

TEST(HeldHands, AHandLeftByItsDeviceContinuesFromThePoseOfTheSession) {
  const DeviceRig rig;
  const auto sample_at = [&rig](double t, const RodPose& pose) {
    return DeviceSample{t, HipFromRodPose(pose, rig), HandleFromRodPose(pose, rig), 0, true};
  };
  const std::vector<TraceRow> rows{{DeviceRole::kScope, sample_at(0, {0.1, 0, 0, 0.02})},
                                   {DeviceRole::kScope, sample_at(1, {0.1, 0, 0, 0.02})}};
  const auto by_mouse = [&rig](HandKind kind) {
    return HandParts{kind, ScriptedDevice(rig), {}, {}, {}, {}, 0, kNoButtons};
  };
  std::array parts{by_mouse(HandKind::kRecorded), by_mouse(HandKind::kMouse)};
  parts[0].recorded = std::make_unique<RecordedDevice>(rows, DeviceRole::kScope);
  HeldHands held(std::move(parts), PedalParts{});
  HandsRequest request;
  request.until = 1e12;  // s; mouse and keys move the hand by nothing meanwhile
  held.SetRequest(request);
  Device& scope = *held.Of(DeviceRole::kScope);
  EXPECT_EQ(scope.Read(5.0).hip_in_device, rows[0].sample.hip_in_device);
  // A pose that differs from that of the sample shows whose pose is kept.
  Snapshot snapshot;
  snapshot.scope.pose = {0, 0.2, 0.3, 0.04};
  held.AfterTick(snapshot, 1e-3);
  EXPECT_TRUE(held.ReadReport().hand[0].is_led_by_device);
  const DeviceSample left = scope.Read(7.0);
  held.AfterTick(snapshot, 1e-3);
  EXPECT_FALSE(held.ReadReport().hand[0].is_led_by_device);
  EXPECT_EQ(held.ReadReport().hand[0].episode, 1);
  EXPECT_TRUE(left.valid);
  EXPECT_LT(glm::distance(left.hip_in_device, HipFromRodPose(snapshot.scope.pose, rig)), 1e-9);
}

TEST(ForceHistory, KeepsTheLargestOfEachFiftiethAndForgetsAfterTenSeconds) {
  ForceHistory history;
  history.Feel(2);
  history.Feel(1);
  history.Pass(0.030, 0.004);
  const auto newest = [&](const auto& values, int back) {
    const int at =
        (history.oldest() - 1 - back + 2 * ForceHistory::kLength) % ForceHistory::kLength;
    return values[static_cast<std::size_t>(at)];
  };
  EXPECT_EQ(newest(history.forces(), 0), 2.0f);
  EXPECT_EQ(newest(history.ages(), 0), 4.0f);
  EXPECT_EQ(newest(history.forces(), 1), 0.0f);
  history.Pass(0.010, 0);
  EXPECT_EQ(newest(history.forces(), 0), 0.0f);
  EXPECT_EQ(newest(history.forces(), 1), 2.0f);
  for (int i = 0; i < 1000; ++i) history.Pass(0.010, 0);
  for (const float force : history.forces()) EXPECT_EQ(force, 0.0f);
}

}  // namespace
}  // namespace arthro::simulation
