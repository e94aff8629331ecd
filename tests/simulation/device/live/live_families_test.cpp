// Live devices without force.
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "tests/simulation/device/live/arm_bench.h"

namespace arthro::simulation {
namespace {

const std::string kArmPath = "/dev/fake0";

using test::Bytes;
using test::FakeUsb;
using test::WaitUntil;

struct Bench {
  Bench(DeviceFamily family, const test::FakeHid& hid) {
    usb.Plug(hid);
    LiveOptions options;
    options.clock = test::BenchSeconds;
    options.list_every = 0.02;
    options.lock_folder = folder.path();
    link = std::make_shared<LiveLink>(*bus, DeviceRequest{family, "", ""}, options);
    for (int hand = 0; hand < link->hands(); ++hand)
      devices.push_back(std::make_unique<LiveDevice>(link, hand));
    WaitUntil([&] { return link->opening() != 0; });
  }
  ~Bench() {
    devices.clear();
    link.reset();
    EXPECT_EQ(usb.misuses(), 0);
  }
  void Send(const Bytes& report) {
    const LinkCounts was = link->counts();
    usb.Send(kArmPath, report);
    ASSERT_TRUE(WaitUntil([&] { return link->counts().taken > was.taken; }));
  }
  DeviceSample Tick(int hand = 0, bool is_held = false, const glm::dvec3& force = {}) {
    LiveDevice& device = *devices[static_cast<std::size_t>(hand)];
    test::AdvanceBench(1e-3);
    const DeviceSample sample = device.Read(test::BenchSeconds());
    device.HoldDeadMan(is_held);
    device.Command(force);
    return sample;
  }
  test::TempFolder folder;
  FakeUsb usb;
  std::unique_ptr<HidBus> bus = MachineHidBus();
  std::shared_ptr<LiveLink> link;
  std::vector<std::unique_ptr<LiveDevice>> devices;
};

TEST(LiveSpaceMouse, LeadsAHandAndRestsWhenSilent) {
  Bench bench(DeviceFamily::kSpaceMouse, {0x256f, 0xc635, 1, 8, 0, false, L"7", L"", kArmPath});
  for (int i = 0; i < 5; ++i) bench.Tick();
  EXPECT_EQ(bench.devices[0]->state(), DeviceState::kReady) << "it speaks only when it is pushed";
  EXPECT_EQ(bench.Tick().hip_in_device, glm::dvec3(0.0));
  bench.Send({1, 0x5e, 1, 0, 0, 0, 0});
  for (int i = 0; i < 100; ++i) bench.Tick();
  EXPECT_NEAR(bench.Tick().hip_in_device.x, 0.101 * RateOptions().speed, 2e-4)
      << "0.1 s at full push";
  for (int i = 0; i < 500; ++i) bench.Tick();
  const DeviceSample rest = bench.Tick();
  EXPECT_NEAR(rest.hip_in_device.x, 0.25 * RateOptions().speed, 2e-4) << "it fell silent";
  EXPECT_TRUE(rest.valid);
  bench.Send({1, 0, 0, 0, 0, 0, 0});
  EXPECT_EQ(bench.Tick().hip_in_device, rest.hip_in_device);
  bench.usb.Unplug(kArmPath);
  ASSERT_TRUE(WaitUntil([&] { return !bench.link->is_present(); }));
  EXPECT_FALSE(bench.Tick().valid);
}

TEST(LiveHydra, StartsAfterRetriesAndHasTwoHands) {
  FakeUsb* usb = nullptr;
  {
    test::TempFolder folder;
    FakeUsb ports;
    usb = &ports;
    ports.Plug({0x1532, 0x0300, 0, 0, 0, false, L"", L"Hydra", kArmPath});
    ports.FailFeatures(kArmPath, 3);
    LiveOptions options;
    options.clock = test::BenchSeconds;
    options.lock_folder = folder.path();
    const auto bus = MachineHidBus();
    auto link =
        std::make_shared<LiveLink>(*bus, DeviceRequest{DeviceFamily::kHydra, "", ""}, options);
    ASSERT_EQ(link->hands(), 2);
    LiveDevice left(link, 0), right(link, 1);
    ASSERT_TRUE(WaitUntil([&] { return link->opening() != 0; }));
    EXPECT_EQ(usb->Features(kArmPath).size(), 1u) << "three failed";
    Bytes report(52);
    report[8] = 10, report[15] = 0x7f, report[14] = 0xff;
    report[30] = 20, report[37] = 0x7f, report[36] = 0xff;
    DeviceSample first, second;
    for (int i = 0; i < 5; ++i) {
      const long taken = link->counts().taken;
      usb->Send(kArmPath, report);
      ASSERT_TRUE(WaitUntil([&] { return link->counts().taken > taken; }));
      test::AdvanceBench(4e-3);
      first = left.Read(test::BenchSeconds());
      second = right.Read(test::BenchSeconds());
    }
    EXPECT_TRUE(first.valid && second.valid);
    EXPECT_EQ(first.hip_in_device, glm::dvec3(0.010, 0, 0));
    EXPECT_EQ(second.hip_in_device, glm::dvec3(0.020, 0, 0));
    EXPECT_EQ(left.name(), "Razer Hydra, first hand");
  }
}

TEST(LiveHydra, IsStoppedAtTheEnd) {
  Bench bench(DeviceFamily::kHydra, {0x1532, 0x0300, 0, 0, 0, false, L"", L"Hydra", kArmPath});
  bench.devices.clear();
  bench.link.reset();
  const auto features = bench.usb.Features(kArmPath);
  ASSERT_EQ(features.size(), 2u);
  EXPECT_EQ(features[0][9], 3);
  EXPECT_EQ(features[1][9], 0);
}

TEST(LivePad, RumblesAtMost60TimesPerSecondAndStopsAtOnce) {
  Bench bench(DeviceFamily::kDualSense, {0x054c, 0x0ce6, 1, 5, 3, false, L"", L"", kArmPath});
  Bytes report(64);
  report[0] = 1, report[8] = 0x28;
  bench.Send(report);
  for (int i = 0; i < 5; ++i) bench.Tick();
  EXPECT_FALSE(bench.Tick().valid);
  EXPECT_EQ(bench.Tick().buttons, 1u) << "of a device without a hand the buttons still count";
  const auto rumbles = [&] {
    long count = 0;
    for (const Bytes& written : bench.usb.Written(kArmPath)) count += written[4] > 0;
    return count;
  };
  // One second of bench time, independent of machine time.
  for (int i = 0; i < 1000; ++i) {
    bench.Tick(0, true, {0, 0, 3.3});
    std::this_thread::sleep_for(std::chrono::microseconds(50));
  }
  EXPECT_GT(rumbles(), 1);
  EXPECT_LE(rumbles(), 61);
  bench.Tick();
  EXPECT_TRUE(WaitUntil([&] {
    const auto written = bench.usb.Written(kArmPath);
    return !written.empty() && written.back()[4] == 0;
  }));
}

TEST(LiveLink, OpensAFreeDeviceOfTheFamily) {
  Bench bench(DeviceFamily::kSpaceMouse, {0x256f, 0xc635, 1, 8, 0, false, L"7", L"", kArmPath});
  bench.usb.Plug({0x256f, 0xc635, 1, 8, 0, false, L"8", L"", "/dev/fake1"});
  LiveOptions options;
  options.list_every = 0.02;
  options.lock_folder = bench.folder.path();
  LiveLink second(*bench.bus, DeviceRequest{DeviceFamily::kSpaceMouse, "", ""}, options);
  ASSERT_TRUE(WaitUntil([&] { return second.opening() != 0; }));
  EXPECT_EQ(bench.usb.opened(kArmPath), 1);
  EXPECT_EQ(bench.usb.opened("/dev/fake1"), 1);
}

}  // namespace
}  // namespace arthro::simulation
