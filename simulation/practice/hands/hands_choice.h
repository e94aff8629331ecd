// What a person chose to hold the two hands of a practice: the devices of a rig, a recorded pair,
// simulated devices, or nothing, and then mouse and keys. SI.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "simulation/device/trace_io.h"
#include "simulation/scene/rig_file.h"

namespace arthro::simulation {

struct HandsChoice {
  std::optional<RigFile> rig;
  std::filesystem::path rig_file;  // that it was read from
  std::vector<TraceRow> trace;     // recorded hands; empty: none
  bool is_simulated = false;
  bool is_zero_force = false;
  std::filesystem::path log;  // that all of it is written to; empty: none
  std::string notice;         // a sentence where the recording is not whole
};

// `rig`: a rig file or empty; `hands`: TRACE.csv, a device log, "plant" or empty. Of both, the
// recording or the simulated devices stand in for the rig's, on its mounts. Throws Error.
HandsChoice ReadHands(const std::filesystem::path& rig, const std::string& hands);

// A device of a rig that its maker's library drives, and not hidapi.
bool IsOpenHaptics(const RigDevice& device);

}  // namespace arthro::simulation
