// Recorded hands as TRACE.csv [method.md, File formats]: one row per sample, in order of time.
//   t,device,hip_x,hip_y,hip_z,qw,qx,qy,qz,buttons
// s, `scope`|`instrument`, m and unit quaternion in the device frame, bit field. Numbers are
// written with the fewest digits that read back to the same bits.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "simulation/device/device_sample.h"

namespace arthro::simulation {

// Longest gap in a recording; a longer one is an error of the unit or two recordings in one.
inline constexpr double kLongestGap = 60.0;  // s

struct TraceRow {
  DeviceRole device = DeviceRole::kScope;
  DeviceSample sample;  // valid
};

// Reads a trace. Throws Error(kBadData) with the line: a wrong header or number of columns, an
// unknown device, a number that is invalid or not finite, a quaternion whose length differs from 1
// by more than 1e-3, time that runs backwards or leaps by more than a minute, or no rows.
std::vector<TraceRow> ParseTrace(std::string_view text, const std::filesystem::path& file = {});
std::vector<TraceRow> ReadTrace(const std::filesystem::path& file);

std::string TraceText(std::span<const TraceRow> rows);
void WriteTrace(const std::filesystem::path& file, std::span<const TraceRow> rows);

}  // namespace arthro::simulation
