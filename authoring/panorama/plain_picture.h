// A panorama in OpenCV's type as a plain value.
#pragma once

#include <opencv2/core.hpp>

#include "authoring/panorama/clip/panorama_report.h"

namespace arthro::authoring {

// `rgba`: CV_8UC4 or empty.
RgbaPicture PlainPicture(const cv::Mat& rgba);

}  // namespace arthro::authoring
