// Objects between the scope and the plane, or on the scope: clouds, floating debris, a shaft, dirt
// and letters. Pictures are CV_32FC3, RGB, linear.
#pragma once

#include <cstdint>

#include <opencv2/core.hpp>

#include "authoring/phantom/clip/clip_options.h"

namespace arthro::authoring {

// CV_32F, twice the frame's size at a quarter of its pixels: drifting clouds.
cv::Mat Clouds(const ClipOptions& options, double radius);
void AddHaze(const cv::Mat& clouds, double strength, int frame, cv::Mat& picture);

void AddDebris(const ClipOptions& options, double radius, int frame, cv::Mat& picture);

// Share of a pixel that the shaft covers: CV_32F, 0 to 1.
cv::Mat ToolCover(const ClipOptions& options, cv::Point2d centre, double radius, int frame);
void AddTool(const ClipOptions& options, cv::Point2d centre, double radius, int frame,
             cv::Mat& picture);

// Marks fixed in the frame, CV_8UC1, 255 at a mark: dark dirt on the lens and white letters.
struct StaticMarks {
  cv::Mat dirt, letters;
};
StaticMarks MarksOf(const ClipOptions& options, cv::Point2d centre, double radius);

}  // namespace arthro::authoring
