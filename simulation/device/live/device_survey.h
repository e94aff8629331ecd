// What devices there are and whether they can be used; and one of them tried, without force.
#pragma once

#include <atomic>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "simulation/device/live/live_device.h"

namespace arthro::simulation {

struct SurveyedDevice {
  KnownDevice device;
  bool can_be_used = false;
  DeviceCaps caps;  // nothing where its geometry is not named
  int hands = 1;
  std::string sentence;  // ready, or what is in the way and what to do
};

struct DeviceSurvey {
  int nodes = 0;  // of HID that are plugged in, ours or not
  std::vector<SurveyedDevice> devices;
};

// `model`: of each WoodenHaptics. Opens each for a moment unless another program has it; writes
// nothing to it.
DeviceSurvey SurveyDevices(HidBus& bus, std::string_view model,
                           const std::filesystem::path& lock_folder = {});

struct DeviceTrial {
  double seconds = 0;  // that it was ticked, once it was open
  double rate = 0;     // Hz, of reports that it took
  long taken = 0, rejected = 0, full_rings = 0, written = 0;
  double age_p50 = 0, age_p99 = 0;  // s, of samples when they were read; of steady devices
  double spread = 0;                // m, farthest from the first hand; 0 where none was known
  bool has_passed = false;
  std::string sentence;
};

// What somebody counts of a device that is tried.
struct TriedDevice {
  std::function<bool()> is_open;
  std::function<LinkCounts()> counts;
};

// Ticks an open one at 1 kHz with no force. Passed: one that sends all the time sends at four
// fifths of its rate at least, with no report lost and one in a hundred rejected at most. `clock`:
// the device's.
DeviceTrial TryHand(Device& device, const TriedDevice& tried, double seconds,
                    double (*clock)() noexcept, const std::atomic<bool>* stop = nullptr);

// Finds, opens and tries it; where it does not open it has not passed.
DeviceTrial TryDevice(HidBus& bus, const DeviceRequest& request, double seconds,
                      const LiveOptions& options = {}, const std::atomic<bool>* stop = nullptr);

}  // namespace arthro::simulation
