// Where a frame does not show tissue: the glints of the light and the metal of an instrument.
// `rgb` is CV_8UC3, RGB, at working scale; `mask` CV_8UC1, 255 where the lens shows something;
// results CV_8UC1, 255 where the frame is not to be used.
#pragma once

#include <opencv2/core.hpp>

namespace arthro::authoring {

// Glints: whiter than their surround or close to saturated, grown by the glow around them. The
// idea is Arnold et al. 2010's, a threshold on colour against the local colour; whiteness is the
// weakest channel, which tissue keeps low.
cv::Mat HighlightMask(const cv::Mat& rgb, const cv::Mat& mask);

// An instrument: colourless, with straight sides, long, and entering from the rim. All four must
// hold, so that pale cartilage stays.
cv::Mat ToolMask(const cv::Mat& rgb, const cv::Mat& mask);

}  // namespace arthro::authoring
