// Survey of plugged-in devices and their usability, and a test of one device without force.
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
  DeviceCaps caps;  // empty where its geometry is not given
  int hands = 1;
  std::string sentence;  // ready, or the obstacle and what to do
};

struct DeviceSurvey {
  int nodes = 0;  // number of plugged-in HID nodes of any kind
  std::vector<SurveyedDevice> devices;
};

// Surveys all devices. `model` is that of each WoodenHaptics. Opens each device briefly unless
// another program has it; writes nothing to it.
DeviceSurvey SurveyDevices(HidBus& bus, std::string_view model,
                           const std::filesystem::path& lock_folder = {});

struct DeviceTrial {
  double seconds = 0;  // s, duration of the ticks once it was open
  double rate = 0;     // Hz, rate of accepted reports
  long taken = 0, rejected = 0, full_rings = 0, written = 0;
  double age_p50 = 0, age_p99 = 0;  // s, age of samples when read; steady devices only
  double spread = 0;  // m, largest distance from the first position; 0 where none was known
  bool has_passed = false;
  std::string sentence;
};

// Counters of a device under test.
struct TriedDevice {
  std::function<bool()> is_open;
  std::function<LinkCounts()> counts;
};

// Ticks an open device at 1 kHz without force. A steady device passes when it sends at least four
// fifths of its rate, loses no report, and at most one report in a hundred is rejected. `clock` is
// that of the device.
DeviceTrial TryHand(Device& device, const TriedDevice& tried, double seconds,
                    double (*clock)() noexcept, const std::atomic<bool>* stop = nullptr);

// Finds, opens and tests a device; it fails where it does not open.
DeviceTrial TryDevice(HidBus& bus, const DeviceRequest& request, double seconds,
                      const LiveOptions& options = {}, const std::atomic<bool>* stop = nullptr);

}  // namespace arthro::simulation
