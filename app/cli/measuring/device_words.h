// A haptic device as the job `devices` tells of it, to a person and as JSON.
#pragma once

#include <optional>
#include <string>

#include <nlohmann/json.hpp>

#include "simulation/device/live/device_survey.h"
#include "simulation/device/openhaptics/openhaptics_devices.h"

namespace arthro::app {

struct ListedDevice {
  std::string family, name;  // a word of rig files; for a person
  std::string number;        // on the bus, as lsusb writes it; empty: it has none
  std::string serial;        // name of the device in rig files
  std::string path;          // or what else tells it apart
  bool is_bluetooth = false, can_be_used = false;
  int hands = 1;
  simulation::DeviceCaps caps;
  std::string sentence;  // ready, or what is in the way and what to do
};

ListedDevice ListedOf(const simulation::SurveyedDevice& own);
// `configured`: the name by which it was opened; empty: the default.
ListedDevice ListedOf(simulation::OpenHapticsDevices& devices, std::size_t i,
                      const std::string& configured);

std::string HeadOf(const ListedDevice& own);  // one line, without its end
std::string TextOf(const ListedDevice& own, const std::optional<simulation::DeviceTrial>& trial);
nlohmann::ordered_json JsonOf(const ListedDevice& own,
                              const std::optional<simulation::DeviceTrial>& trial);

// HID devices that are searched for, by family, and advice for a machine that has none.
nlohmann::ordered_json LookedForJson();
std::string Advice(int nodes, const std::string& openhaptics);

}  // namespace arthro::app
