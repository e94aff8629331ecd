// Reports of a lens calibration: a table for the terminal and JSON for programs.
#pragma once

#include <string>
#include <vector>

#include "authoring/lens/calibrate_lens.h"

namespace arthro::authoring {

// `names`: one per picture, in the order of calibration.views.
std::string TableOf(const LensCalibration& calibration, const std::vector<std::string>& names);

// {schema, verdict, sentences, model, focal_px, …, models:[…], views:[…]}; angles in degrees.
std::string JsonOf(const LensCalibration& calibration, const std::vector<std::string>& names);

}  // namespace arthro::authoring
