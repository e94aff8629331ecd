// A WoodenHaptics arm on the fake bus, with the published board: it answers each report and sets
// its counters on request. Time is that of the test: a tick is 1 ms, independent of machine time.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <mutex>

#include "simulation/device/live/live_device.h"
#include "tests/support/fake_hidapi.h"
#include "tests/support/temp_folder.h"

namespace arthro::test {

// Waits until `is_true`, at most ten seconds of machine time.
bool WaitUntil(const std::function<bool()>& is_true);

double BenchSeconds() noexcept;  // clock of a bench; one bench at a time
void AdvanceBench(double seconds) noexcept;

FakeHid WoodenArm(const std::wstring& serial, const std::string& path);

class Board {
 public:
  explicit Board(FakeUsb& usb, const std::string& path);
  ~Board();
  void SetCounters(const std::array<int, 6>& counters);
  void SetMute(bool is_mute);
  void SendNow();

 private:
  Bytes Report();
  FakeUsb& usb_;
  std::string path_;
  std::mutex mutex_;
  std::array<int, 6> counters_{};
  bool is_mute_ = false;
};

// Currents of the newest report written to `path`, mA.
std::array<int, 3> CurrentsAt(FakeUsb& usb, const std::string& path);

struct ArmBench {
  explicit ArmBench(const std::string& serial = "A", double list_every = 0.02);
  // Runs one servo tick, after waiting for a sample of this tick.
  simulation::DeviceSample Tick(const glm::dvec3& force, bool is_held);
  // Runs one servo tick without waiting for a sample.
  simulation::DeviceSample TickNow(const glm::dvec3& force, bool is_held);
  void Arm();  // ticks until it is armed, without force

  TempFolder folder;
  FakeUsb usb;
  std::unique_ptr<simulation::HidBus> bus = simulation::MachineHidBus();
  std::shared_ptr<simulation::LiveLink> link;
  std::unique_ptr<simulation::LiveDevice> device;
};

}  // namespace arthro::test
