// A live force device gets zero force when the servo is silent, and first on every way out.
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <fstream>
#include <iterator>
#include <memory>
#include <stdexcept>
#include <thread>
#include <unistd.h>

#include "simulation/device/live/release_on_crash.h"
#include "tests/simulation/device/live/plugged_arm.h"

namespace arthro::simulation {
namespace {

TEST(LiveArm, WritesZeroWhileTheServoIsSilent) {
  Plugged bench;
  bench.Arm();
  for (int i = 0; i < 3; ++i) bench.Tick(kPush, true);
  ASSERT_EQ(bench.device->force(), kPush);
  // The servo has stopped.
  EXPECT_TRUE(WaitUntil([&] { return CurrentsAt(bench.usb, kPath) == kNoCurrents; }));
}

// The program is stopped (by a debugger or a sleeping machine) between the command of the servo and
// its writing.
TEST(LiveArm, WritesZeroInPlaceOfAnOutdatedForce) {
  Plugged bench;
  bench.Arm();
  for (int i = 0; i < 3; ++i) bench.Tick(kPush, true);
  bench.usb.SetWriteTime(kPath, 50);
  bench.TickNow(kPush, true);
  ASSERT_TRUE(WaitUntil([&] { return bench.link->write_began() > 0; }));
  bench.usb.SetWriteTime(kPath, 0);
  bench.TickNow(kPush, true);
  ASSERT_EQ(bench.device->force(), kPush) << "or there is nothing to hold back";
  const std::size_t written = bench.usb.Written(kPath).size();
  test::AdvanceBench(0.02);
  ASSERT_TRUE(WaitUntil([&] { return bench.usb.Written(kPath).size() > written + 1; }));
  const auto reports = bench.usb.Written(kPath);
  EXPECT_TRUE(AreZeros({reports.begin() + static_cast<std::ptrdiff_t>(written) + 1, reports.end()}))
      << "after the one that was being written";
}

TEST(LiveArm, WritesZeroFiveTimesOnEveryWayOut) {
  for (const bool throws : {false, true}) {
    std::vector<Bytes> written;
    test::TempFolder folder;
    try {
      Plugged bench;
      bench.Arm();
      for (int i = 0; i < 3; ++i) bench.Tick(kPush, true);
      ASSERT_NE(CurrentsAt(bench.usb, kPath), kNoCurrents);
      const std::size_t before = bench.usb.Written(kPath).size();
      struct Look {  // destroyed after the link and before the bus
        test::FakeUsb& usb;
        std::vector<Bytes>& written;
        std::size_t before;
        std::shared_ptr<LiveLink> link;
        std::unique_ptr<LiveDevice> device;
        ~Look() {
          device.reset();
          link.reset();
          const auto all = usb.Written(kPath);
          written.assign(all.begin() + static_cast<std::ptrdiff_t>(before), all.end());
        }
      } look{bench.usb, written, before, std::move(bench.link), std::move(bench.device)};
      if (throws) throw std::runtime_error("anything");
    } catch (const std::runtime_error&) {
    }
    ASSERT_GE(written.size(), 5u);
    EXPECT_TRUE(AreZeros({written.end() - 5, written.end()}));
  }
}

TEST(LiveArm, GivesNoForceAfterRelease) {
  Plugged bench;
  bench.Arm();
  for (int i = 0; i < 3; ++i) bench.Tick(kPush, true);
  bench.link->Release();
  EXPECT_TRUE(WaitUntil([&] { return CurrentsAt(bench.usb, kPath) == kNoCurrents; }));
  for (int i = 0; i < 50; ++i) {
    bench.Tick(kPush, true);
    ASSERT_EQ(CurrentsAt(bench.usb, kPath), kNoCurrents);
  }
}

// Crashes while it pushes; the currents written to its board go to `file`, one report per line.
void Crash(const std::filesystem::path& file, int signal) {
  Plugged bench;
  bench.Arm();
  for (int i = 0; i < 3; ++i) bench.Tick(kPush, true);
  const ReleaseOnCrash crash({bench.link});
  const int out = ::open(file.c_str(), O_CREAT | O_WRONLY | O_APPEND, 0600);
  bench.usb.OnWrite(kPath, [&](const Bytes& report) {
    const char line[2] = {report == Bytes(15) ? '0' : '1', '\n'};
    if (::write(out, line, 2) != 2) std::_Exit(3);
    bench.board.SendNow();
  });
  bench.Tick(kPush, true);
  std::atomic<bool> is_over{false};
  std::thread servo([&] {
    while (!is_over) bench.Tick(kPush, true);
  });
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  signal == 0 ? std::exit(4) : std::abort();
}

TEST(LiveArmDeathTest, ACrashOrExitWritesZeroFirst) {
  test::TempFolder folder;
  const auto last = [&](const std::string& name) {
    std::ifstream lines(folder / name);
    std::string all((std::istreambuf_iterator<char>(lines)), {});
    EXPECT_NE(all.find('1'), std::string::npos) << "it was pushed";
    return all.size() < 4 ? std::string() : all.substr(all.size() - 2);
  };
  EXPECT_EXIT(Crash(folder / "abort", SIGABRT), testing::KilledBySignal(SIGABRT), "");
  EXPECT_EQ(last("abort"), "0\n");
  EXPECT_EXIT(Crash(folder / "exit", 0), testing::ExitedWithCode(4), "");
  EXPECT_EQ(last("exit"), "0\n");
}

}  // namespace
}  // namespace arthro::simulation
