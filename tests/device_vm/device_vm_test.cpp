// Live devices over the real hidapi and the kernel's own HID [inside the guest]. Times are the
// guest's; since a busy host may hold it up at any place, nothing here demands that something be
// quick, only that what was late had no force.
#include <algorithm>
#include <array>
#include <map>
#include <span>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "simulation/device/live/arrival.h"
#include "tests/device_vm/arm_process.h"
#include "tests/device_vm/live_arm.h"
#include "tests/device_vm/when_listed.h"

namespace arthro::test {
namespace {

using namespace simulation;

const glm::dvec3 kNone(0.0), kPush(0, 0, 1);  // N
constexpr std::array<std::int16_t, 3> kNoCurrents{};

// A sample is believed when it is 5 ms old by our count. That count can be too young by 3 ms
// (kArrivalSlack) and by two reports, since one may be late by up to a report and the next on time.
constexpr double kOldest = kFreshFor + kArrivalSlack + 0.002;
constexpr double kSurelyLost = kLostAfter + kArrivalSlack + 0.002;  // 25 ms

std::map<std::string, std::string> PathsBySerial() {
  std::map<std::string, std::string> paths;
  for (const KnownDevice& device : WhenListed(2)) paths[device.node.serial] = device.node.path;
  return paths;
}

// Whatever else happened: force was only given while armed, on a report that was sent just before.
void ExpectForceOnlyOnFreshReports(const LiveArm& arm, std::span<const ArmRecord> records) {
  std::map<int, double> sent_at;  // each moving report has a counter of its own
  for (const ArmRecord& record : records)
    if (record.event == ArmEvent::kSent) sent_at[record.counter] = Seconds(record.t_ns);
  double oldest = 0;
  for (const ServoTick& tick : arm.ticks()) {
    const bool has_force = tick.force != kNone;
    if (has_force || tick.is_valid) {
      ASSERT_TRUE(sent_at.contains(tick.counter)) << "no such report: " << tick.counter;
    }
    if (!has_force) continue;
    EXPECT_EQ(tick.status.state, DeviceState::kArmed);
    EXPECT_TRUE(tick.is_valid);
    EXPECT_LE(tick.now - tick.sample_t, kFreshFor);
    const double age = tick.now - sent_at[tick.counter];
    oldest = std::max(oldest, age);
    EXPECT_LE(age, kOldest) << "at " << tick.now;
  }
  fmt::print("oldest report that got force: {:.2f} ms\n", 1e3 * oldest);
}

TEST(DeviceVm, FindsTwoArmsBySerialNumber) {
  ArmProcess a("WH-A"), b("WH-B");
  const auto known = WhenListed(2);
  ASSERT_EQ(known.size(), 2u);
  for (const KnownDevice& device : known) {
    EXPECT_EQ(device.family, DeviceFamily::kWoodenHaptics);
    EXPECT_EQ(device.node.vendor, 0x1234);
    EXPECT_EQ(device.node.product, 0x0006);
    EXPECT_EQ(device.node.usage_page, 0xff00);
    EXPECT_EQ(device.node.usage, 1);
    EXPECT_EQ(device.node.product_name, "WoodenHaptics");
    EXPECT_TRUE(device.node.path.starts_with("/dev/hidraw")) << device.node.path;
    EXPECT_FALSE(device.node.is_bluetooth);
  }
  EXPECT_EQ(known[0].node.serial, "WH-A");
  EXPECT_EQ(known[1].node.serial, "WH-B");
}

TEST(DeviceVm, StreamsAThousandReportsASecondBothWays) {
  ArmProcess board("WH-A");
  LiveArm arm("WH-A");
  ASSERT_TRUE(arm.Home());
  ASSERT_TRUE(arm.Push(kPush));
  board.Do("move 1");
  arm.Run(kPush, true, 0.1);
  constexpr long kReports = 1000;
  const LinkCounts before = arm.link().counts();
  const std::size_t first = board.Records().size();
  const double begin = SteadySeconds();
  ASSERT_TRUE(arm.RunUntil(kPush, true, [&] {
    return arm.link().counts().taken >= before.taken + kReports;
  })) << "the stream is no stream";
  const double seconds = SteadySeconds() - begin;
  const LinkCounts after = arm.link().counts();
  const auto records = board.Records();

  long sent = 0, told = 0, pushes = 0;
  for (std::size_t i = first; i < records.size(); ++i) {
    sent += records[i].event == ArmEvent::kSent;
    if (records[i].event != ArmEvent::kTold) continue;
    ++told;
    EXPECT_EQ(records[i].size, 15);
    EXPECT_EQ(records[i].command, 0);
    // 1 N up: the lower link's motor alone, 1 N x 0.245 m / 12 / 0.0259 N m/A = 788 mA.
    const bool is_push = records[i].currents == std::array<std::int16_t, 3>{0, 0, 788};
    EXPECT_TRUE(is_push || records[i].currents == kNoCurrents);
    pushes += is_push;
  }
  const long taken = after.taken - before.taken, written = after.written - before.written;
  fmt::print("{:.2f} s: {} reports sent, {} taken; {} written, {} arrived, {} with force\n",
             seconds, sent, taken, written, told, pushes);
  EXPECT_EQ(after.rejected, before.rejected);
  // Reading and counting are not one moment: what is under way then may be on either side.
  if (after.full_rings == before.full_rings) {
    EXPECT_NEAR(static_cast<double>(taken), static_cast<double>(sent), 63.0);
  }
  EXPECT_GT(pushes, 0);
  // The kernel keeps 32 reports for an arm that is held up, and drops the rest.
  EXPECT_GT(static_cast<double>(told), 0.5 * static_cast<double>(written));
  ExpectForceOnlyOnFreshReports(arm, records);
}

TEST(DeviceVm, NothingThatWaitedDuringAStallGetsForce) {
  constexpr int kStall = 300;  // reports, of which the kernel keeps the first 63
  ArmProcess board("WH-A");
  LiveArm arm("WH-A");
  ASSERT_TRUE(arm.Home());
  board.Do("move 1");
  ASSERT_TRUE(arm.Push(kPush));
  arm.Run(kPush, true, 0.2);
  const LinkCounts before = arm.link().counts();
  const std::size_t begin = arm.ticks().size();
  board.Begin(fmt::format("freeze {}", kStall));
  const auto gap = [&] {  // the first tick after the stall
    for (std::size_t i = begin; i < arm.ticks().size(); ++i)
      if (arm.ticks()[i].now - arm.ticks()[i - 1].now > 0.9e-3 * kStall) return i;
    return std::size_t{0};
  };
  ASSERT_TRUE(arm.RunUntil(kPush, true, [&] { return gap() > 0; })) << "nothing stood still";
  const std::size_t resumed = gap();
  arm.Run(kPush, true, 0.1);
  EXPECT_GT(arm.link().counts().full_rings, before.full_rings) << "the ring was not full";
  const double thawed = board.TimeOf(ArmEvent::kThawed);
  const auto records = board.Records();

  // From the stall to the first fresh sample nothing; a command that was under way when we were
  // stopped may still go out.
  std::size_t first_push = resumed;
  while (first_push < arm.ticks().size() && arm.ticks()[first_push].force == kNone) ++first_push;
  const double until =
      first_push < arm.ticks().size() ? arm.ticks()[first_push].now : SteadySeconds();
  int stale_pushes = 0;
  for (const ArmRecord& record : records) {
    const double t = Seconds(record.t_ns);
    stale_pushes += record.event == ArmEvent::kTold && t > thawed && t < until &&
                    record.currents != kNoCurrents;
  }
  EXPECT_LE(stale_pushes, 1);
  fmt::print("first force {:.1f} ms after a stall of {:.0f} ms\n", 1e3 * (until - thawed),
             1e3 * (arm.ticks()[resumed].now - arm.ticks()[resumed - 1].now));

  ASSERT_TRUE(arm.Push(kPush)) << "it does not come back";
  arm.Run(kPush, true, 0.1);
  ExpectForceOnlyOnFreshReports(arm, board.Records());
  EXPECT_EQ(arm.link().counts().opened, before.opened) << "it was not closed for that";
}

TEST(DeviceVm, UnpluggedUnderForceItIsLostAndFoundAgain) {
  ArmProcess board("WH-A");
  LiveArm arm("WH-A");
  ASSERT_TRUE(arm.Home());
  board.Do("move 1");
  ASSERT_TRUE(arm.Push(kPush));
  const std::size_t begin = arm.ticks().size() - 1;
  board.Begin("unplug");
  ASSERT_TRUE(arm.RunUntil(kPush, true, [&] { return arm.link().opening() == 0; }))
      << "the read error was not seen";
  arm.Run(kPush, true, 0.05);
  const double unplugged = board.TimeOf(ArmEvent::kUnplugged);
  double lost = -1, last_push = -1;
  for (std::size_t i = begin; i < arm.ticks().size(); ++i) {
    const ServoTick& tick = arm.ticks()[i];
    const bool runs =
        tick.status.state == DeviceState::kArmed || tick.status.state == DeviceState::kReady;
    if (tick.now > unplugged && tick.status.state == DeviceState::kLost && lost < 0)
      lost = tick.now;
    if (tick.force != kNone) {
      last_push = tick.now;
      EXPECT_LT(lost, 0) << "force after it was lost";
    }
    // Each tick knows by then, even when the message of the end is late.
    if (tick.now > unplugged + kSurelyLost) {
      EXPECT_FALSE(runs) << 1e3 * (tick.now - unplugged) << " ms after";
    }
    if (tick.now > unplugged + kOldest) {
      EXPECT_EQ(tick.force, kNone);
    }
  }
  ASSERT_GT(lost, 0);
  fmt::print("unplugged: the last force was commanded at {:+.2f} ms, it was lost at {:+.2f} ms\n",
             1e3 * (last_push - unplugged), 1e3 * (lost - unplugged));

  board.Do("move 0");
  board.Do("plug");
  ASSERT_TRUE(arm.RunUntil(kPush, true, [&] { return arm.link().opening() != 0; }));
  fmt::print("open again {:.0f} ms after it was plugged in\n",
             1e3 * (SteadySeconds() - board.TimeOf(ArmEvent::kPlugged)));
  const std::size_t again = arm.ticks().size();
  arm.Run(kPush, true, 0.1);
  EXPECT_EQ(arm.state(), DeviceState::kHoming) << "nobody knows where it is";
  for (std::size_t i = again; i < arm.ticks().size(); ++i) EXPECT_EQ(arm.ticks()[i].force, kNone);
  ASSERT_TRUE(arm.Home());
  EXPECT_TRUE(arm.Push(kPush));
}

TEST(DeviceVm, RolesFollowSerialNumbersWhenPortsAreSwapped) {
  ArmProcess a("WH-A"), b("WH-B");
  LiveArm scope("WH-A"), instrument("WH-B");
  ASSERT_TRUE(scope.Home());
  ASSERT_TRUE(instrument.Home());
  const auto before = PathsBySerial();
  ASSERT_EQ(before.size(), 2u);
  a.Do("unplug");
  b.Do("unplug");
  const auto both = [&](bool are_open) {
    return scope.RunUntil(kNone, false, [&] {
      instrument.Tick(kNone, false);
      return (scope.link().opening() != 0) == are_open &&
             (instrument.link().opening() != 0) == are_open;
    });
  };
  ASSERT_TRUE(both(false));
  // The kernel gives a node its number some time after it was asked to: b is to be first.
  b.Do("plug");
  ASSERT_EQ(WhenListed(1).size(), 1u);
  a.Do("plug");
  ASSERT_TRUE(both(true));
  const auto after = PathsBySerial();
  EXPECT_EQ(after.at("WH-A"), before.at("WH-B")) << "they were not swapped";
  EXPECT_EQ(after.at("WH-B"), before.at("WH-A"));
  ASSERT_TRUE(scope.Home());
  ASSERT_TRUE(instrument.Home());
  // Within a step that a hand can make in a millisecond.
  a.Do("place 20");
  b.Do("place -20");
  const auto is_at = [](LiveArm& arm, int counter) {
    return arm.RunUntil(kNone, false, [&] {
      return arm.ticks().back().is_valid && arm.ticks().back().counter == counter;
    });
  };
  EXPECT_TRUE(is_at(scope, 20));
  EXPECT_TRUE(is_at(instrument, -20));
}

}  // namespace
}  // namespace arthro::test
