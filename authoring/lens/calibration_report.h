// A lens calibration for people (a table on the terminal) and for programs (JSON).
#pragma once

#include <string>
#include <vector>

#include "authoring/lens/calibrate_lens.h"

namespace arthro::authoring {

// `names`: of the pictures, in the order of calibration.views.
std::string TableOf(const LensCalibration& calibration, const std::vector<std::string>& names);

// {schema, verdict, sentences, model, focal_px, …, models:[…], views:[…]}; the angles in degrees.
std::string JsonOf(const LensCalibration& calibration, const std::vector<std::string>& names);

}  // namespace arthro::authoring
