// Choice of the user for the two hands of a practice: devices of a rig, a recording, simulated
// devices, or mouse and keys. SI units.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "simulation/device/trace_io.h"
#include "simulation/scene/json/rig_file.h"

namespace arthro::simulation {

struct HandsChoice {
  std::optional<RigFile> rig;
  std::filesystem::path rig_file;  // file of the rig
  std::vector<TraceRow> trace;     // recorded hands; may be empty
  bool is_simulated = false;
  bool is_zero_force = false;
  std::filesystem::path log;  // log of the practice; may be empty
  std::string notice;         // a sentence where the recording is incomplete
};

// Reads the choice: `rig` is a rig file or empty; `hands` is TRACE.csv, a device log, "plant" or
// empty. With both, the recording or the simulated devices replace those of the rig, on its mounts.
// Throws Error.
HandsChoice ReadHands(const std::filesystem::path& rig, const std::string& hands);

// True for a device that is driven by its maker's library instead of hidapi.
bool IsOpenHaptics(const RigDevice& device);

}  // namespace arthro::simulation
