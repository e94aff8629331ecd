// Surface of the plane that a clip shows: tissue colours, small bumps that cause highlights, and
// the height of the ground. One pixel of `albedo` is one panorama pixel.
#pragma once

#include <opencv2/core.hpp>

#include "authoring/phantom/clip/clip_options.h"

namespace arthro::authoring {

struct PlaneTexture {
  cv::Mat albedo;  // CV_16UC3, RGB, linear, 65535 = 1
  cv::Mat slope;   // CV_32FC2 at half the size: slopes of the bumps, px per px, along x and y
  cv::Mat height;  // CV_32F at a quarter of the size, about ±1; empty without relief
};

// Part `region` of a procedural knee of size `world` px. Sizes scale with `radius`, the window's;
// the seed determines the rest.
PlaneTexture KneeTexture(const ClipOptions& options, cv::Size2d world, const cv::Rect& region,
                         double radius);

// Picture (CV_8UC3, RGB) on the plane; bumps and relief as above.
PlaneTexture PictureTexture(const cv::Mat& picture, const ClipOptions& options, double radius);

// Position of a panorama pixel in a field that is `factor` times smaller.
inline float Shrunk(float x, float factor) { return (x + 0.5f) / factor - 0.5f; }

}  // namespace arthro::authoring
