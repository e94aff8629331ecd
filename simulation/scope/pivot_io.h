// Reads presses from a table (POSES.csv) and writes a calibration as JSON (pivot.json) [method.md,
// File formats]. Metres.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "simulation/scope/pivot_calibration.h"

namespace arthro::simulation {

// Reads a header line `hip_x,hip_y,hip_z,tip_x,tip_y,tip_z`, then one press per row; blank lines
// are skipped. Throws Error(kBadData) with the line for anything else, a number that is not finite
// or a press whose hand and tip coincide; Error(kFile) where there is no such file. A table without
// a press is no error: the calibration reports too few.
std::vector<PivotPress> ReadPresses(const std::filesystem::path& csv);

// {schema, status, reason, pivot, sigma, condition, residual, poses_used}; null where unknown.
std::string JsonFromPivot(const PivotCalibration& calibration);

}  // namespace arthro::simulation
