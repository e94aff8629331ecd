#include "tests/simulation/device/live/arm_bench.h"

#include <atomic>
#include <chrono>
#include <thread>

namespace arthro::test {
namespace {

std::atomic<double> bench_now{100};

}  // namespace

using namespace simulation;

bool WaitUntil(const std::function<bool()>& is_true) {
  for (int i = 0; i < 1500000; ++i) {
    if (is_true()) return true;
    std::this_thread::sleep_for(std::chrono::microseconds(200));
  }
  return false;
}

double BenchSeconds() noexcept { return bench_now; }
void AdvanceBench(double seconds) noexcept { bench_now = bench_now + seconds; }

FakeHid WoodenArm(const std::wstring& serial, const std::string& path) {
  return {0x1234, 0x0006, 0xff00, 1, 0, false, serial, L"WoodenHaptics", path};
}

Board::Board(FakeUsb& usb, const std::string& path) : usb_(usb), path_(path) {
  usb.OnWrite(path, [this](const Bytes& report) {
    if (report.size() == 15 && SignedAt(report, 7) == 1) {
      const std::scoped_lock lock(mutex_);
      for (std::size_t i = 0; i < 3; ++i) {
        counters_[i] = SignedAt(report, 9 + 2 * i);
        counters_[3 + i] = SignedAt(report, 1 + 2 * i);
      }
    }
    SendNow();
  });
}

Board::~Board() { usb_.OnWrite(path_, nullptr); }

void Board::SetCounters(const std::array<int, 6>& counters) {
  const std::scoped_lock lock(mutex_);
  counters_ = counters;
}
void Board::SetMute(bool is_mute) {
  const std::scoped_lock lock(mutex_);
  is_mute_ = is_mute;
}
Bytes Board::Report() {
  const std::scoped_lock lock(mutex_);
  Bytes report(14);
  if (is_mute_) return {};
  for (std::size_t i = 0; i < 6; ++i)
    PutSigned(report, 2 * i, static_cast<std::int16_t>(counters_[i]));
  return report;
}
void Board::SendNow() {
  const Bytes report = Report();
  if (!report.empty()) usb_.Send(path_, report);
}

std::array<int, 3> CurrentsAt(FakeUsb& usb, const std::string& path) {
  const auto written = usb.Written(path);
  if (written.empty()) return {};
  return {SignedAt(written.back(), 1), SignedAt(written.back(), 3), SignedAt(written.back(), 5)};
}

ArmBench::ArmBench(const std::string& serial, double list_every) {
  LiveOptions options;
  options.clock = BenchSeconds;
  options.list_every = list_every;
  options.lock_folder = folder.path();
  link = std::make_shared<LiveLink>(
      *bus, DeviceRequest{DeviceFamily::kWoodenHaptics, serial, "woodenhaptics_2015"}, options);
  device = std::make_unique<LiveDevice>(link, 0);
}

DeviceSample ArmBench::TickNow(const glm::dvec3& force, bool is_held) {
  AdvanceBench(1e-3);
  const DeviceSample sample = device->Read(BenchSeconds());
  device->HoldDeadMan(is_held);
  device->Command(force);
  return sample;
}

DeviceSample ArmBench::Tick(const glm::dvec3& force, bool is_held) {
  const long taken = link->counts().taken;
  const DeviceSample sample = TickNow(force, is_held);
  WaitUntil([&] { return link->counts().taken > taken || link->opening() == 0; });
  return sample;
}

void ArmBench::Arm() {
  link->AskHome();
  WaitUntil([&] {
    Tick(glm::dvec3(0.0), false);
    return device->state() == DeviceState::kReady;
  });
  WaitUntil([&] {
    Tick(glm::dvec3(0.0), true);
    return device->state() == DeviceState::kArmed;
  });
}

}  // namespace arthro::test
