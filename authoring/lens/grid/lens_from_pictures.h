// Lens of a camera from picture files of a flat target: finds the round window and the target in
// each, and calibrates (calibrate_lens.h). The pictures are of one camera at one size.
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "authoring/lens/calibrate_lens.h"
#include "authoring/lens/target/detect_target.h"

namespace arthro::authoring {

struct PicturesLens {
  LensCalibration calibration;
  std::string refusal;  // why there is no lens; empty: there is one
};

// `spacing`: step of the target, m. Throws Error(kBadImage) for a file that is no picture, or one
// of another size than the first.
PicturesLens LensFromPictures(std::span<const std::filesystem::path> files, double spacing,
                              const DetectOptions& detect, const CalibrateOptions& calibrate,
                              const Progress& progress);

}  // namespace arthro::authoring
