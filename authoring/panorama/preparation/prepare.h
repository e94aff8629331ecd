// Converts a rectified colour frame to the picture that is matched [paper, 3.1]: one grey without
// light, vignetting and exposure, with contrast raised as far as the noise allows, and a mask of
// its tissue.
#pragma once

#include <opencv2/core.hpp>

#include "authoring/panorama/frames/working_frame.h"
#include "authoring/panorama/preparation/clip_look.h"
#include "authoring/panorama/preparation/frame_masks.h"
#include "authoring/panorama/preparation/prepare_options.h"

namespace arthro::authoring {

// `working_rgb` CV_8UC3, RGB, rectified at `scale`; `lens_mask` CV_8UC1 of the same size, 255
// inside the lens's visible area. Throws Error(kBadImage) when sizes or types do not match.
WorkingFrame Prepare(int index, const cv::Mat& working_rgb, double scale, const cv::Mat& lens_mask,
                     const ClipLook& look, const PrepareOptions& options);

}  // namespace arthro::authoring
