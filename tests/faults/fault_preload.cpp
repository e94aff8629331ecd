// A library that is loaded before the program under trial (LD_PRELOAD). It moves the wall clock by
// the offset of the fault page, and puts a WoodenHaptics arm in place of libhidapi's devices. The
// arm answers each report, as the published board does, and notes each write in the page.
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <dlfcn.h>
#include <fcntl.h>
#include <memory>
#include <sys/mman.h>
#include <sys/time.h>
#include <thread>
#include <unistd.h>

#include "simulation/device/codec/report_bytes.h"
#include "tests/faults/fault_page.h"
#include "tests/support/fake_hidapi.h"

namespace {

using arthro::simulation::PutSigned;
using arthro::simulation::SignedAt;
using arthro::test::ArmWrite;
using arthro::test::Bytes;
using arthro::test::FakeUsb;
using arthro::test::FaultPage;

constexpr std::int64_t kSecond = 1'000'000'000;  // ns
constexpr const char* kPath = "/dev/fake0";
constexpr double kTremor = 12;  // counts of the first two joints, some 2 mm at the hand

FaultPage* page = nullptr;

using ClockGetTime = int (*)(clockid_t, timespec*);
ClockGetTime RealClock() {
  static const auto real = reinterpret_cast<ClockGetTime>(::dlsym(RTLD_NEXT, "clock_gettime"));
  return real;
}

std::int64_t Nanoseconds(clockid_t clock) {
  timespec now{};
  RealClock()(clock, &now);
  return now.tv_sec * kSecond + now.tv_nsec;
}

std::int64_t WallClock() {
  return Nanoseconds(CLOCK_REALTIME) + (page != nullptr ? page->wall_clock_offset.load() : 0);
}

arthro::test::FakeHid Node() {
  return {0x1234, 0x0006, 0xff00, 1, 0, false, L"A", L"WoodenHaptics", kPath};
}

// The arm lives as long as the program: its threads may write in the last moment.
class Arm {
 public:
  explicit Arm(FakeUsb& usb) : usb_(usb) {
    usb_.Plug(Node());
    usb_.OnWrite(kPath, [this](const Bytes& report) { Take(report); });
    std::thread([this] { Live(); }).detach();
  }

 private:
  void Take(const Bytes& report) {
    if (report.size() < 15) return;
    ArmWrite& write = page->write[page->writes.fetch_add(1) % arthro::test::kArmWrites];
    write = {Nanoseconds(CLOCK_MONOTONIC),
             {SignedAt(report, 1), SignedAt(report, 3), SignedAt(report, 5)},
             SignedAt(report, 7)};
    if (write.command == 1) {
      for (std::size_t i = 0; i < 3; ++i) {
        home_[i] = SignedAt(report, 9 + 2 * i);
        home_[3 + i] = SignedAt(report, 1 + 2 * i);
      }
      is_homed_ = true;
    }
    Answer();
  }

  void Answer() {
    Bytes report(14);
    for (std::size_t i = 0; i < 6; ++i) PutSigned(report, 2 * i, home_[i]);
    if (is_homed_ && page->is_hand_moving != 0)
      for (std::size_t i = 0; i < 2; ++i)
        PutSigned(report, 2 * i, static_cast<std::int16_t>(home_[i] + offset_[i].load()));
    if (!is_homed_) PutSigned(report, 12, 1);  // the calibration button is pressed until then
    usb_.Send(kPath, report);
  }

  // Moves the hand, follows the cable, and forgets what was written, of which a long run has much.
  void Live() {
    bool is_plugged = true;
    const std::uint32_t seed = page->seed;
    for (std::int64_t tick = 0;; ++tick) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      const double t = 1e-3 * static_cast<double>(tick) + 0.1 * (seed % 1000);
      offset_[0] = static_cast<int>(kTremor * std::sin(2.1 * t) + kTremor * std::sin(5.3 * t));
      offset_[1] = static_cast<int>(kTremor * std::sin(1.7 * t + 1) + kTremor * std::sin(4.1 * t));
      const bool is_pulled = page->is_arm_pulled != 0;
      if (is_pulled && is_plugged) usb_.Unplug(kPath);
      if (!is_pulled && !is_plugged) {
        is_homed_ = false;
        usb_.Plug(Node());
      }
      is_plugged = !is_pulled;
      const std::scoped_lock lock(usb_.mutex_);
      auto& written = usb_.ports_[kPath].written;
      if (written.size() > 4096) written.clear();
    }
  }

  FakeUsb& usb_;
  std::array<std::int16_t, 6> home_{};
  std::array<std::atomic<int>, 2> offset_{};
  std::atomic<bool> is_homed_{false};
};

// Child processes inherit the environment, but find no arm.
[[gnu::constructor]] void Begin() {
  auto* const usb = new FakeUsb;  // without devices; it lives as long as the program
  const char* file = std::getenv(arthro::test::kFaultPageVariable);
  const int descriptor = file != nullptr ? ::open(file, O_RDWR | O_CLOEXEC) : -1;
  if (descriptor < 0) return;
  void* memory =
      ::mmap(nullptr, sizeof(FaultPage), PROT_READ | PROT_WRITE, MAP_SHARED, descriptor, 0);
  ::close(descriptor);
  if (memory == MAP_FAILED) return;
  page = static_cast<FaultPage*>(memory);
  if (page->has_arm.exchange(0) != 0) new Arm(*usb);
}

}  // namespace

extern "C" {

int clock_gettime(clockid_t clock, timespec* now) noexcept {
  const int result = RealClock()(clock, now);
  if (result != 0 || clock != CLOCK_REALTIME || page == nullptr) return result;
  const std::int64_t moved = WallClock();
  now->tv_sec = moved / kSecond;
  now->tv_nsec = moved % kSecond;
  return 0;
}

time_t time(time_t* seconds) noexcept {
  const time_t now = WallClock() / kSecond;
  if (seconds != nullptr) *seconds = now;
  return now;
}

int gettimeofday(timeval* now, void*) noexcept {
  const std::int64_t moved = WallClock();
  now->tv_sec = moved / kSecond;
  now->tv_usec = moved % kSecond / 1000;
  return 0;
}

}  // extern "C"
