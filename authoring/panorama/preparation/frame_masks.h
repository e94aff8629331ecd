// Masks of the areas of a frame without tissue: highlights, and the metal of an instrument. `rgb`
// is CV_8UC3, RGB, at working scale; `mask` CV_8UC1, 255 inside the lens's visible area; results
// CV_8UC1, 255 at pixels that must not be used.
#pragma once

#include <opencv2/core.hpp>

namespace arthro::authoring {

// Highlights: whiter than their surroundings or close to saturated, grown by their glow. A
// threshold on colour relative to the local colour follows Arnold et al. 2010; whiteness is the
// weakest channel, which tissue keeps low.
cv::Mat HighlightMask(const cv::Mat& rgb, const cv::Mat& mask);

// An instrument: colourless, with straight sides, long, and entering from the rim. All four must
// hold, so that pale cartilage is not masked.
cv::Mat ToolMask(const cv::Mat& rgb, const cv::Mat& mask);

}  // namespace arthro::authoring
