// Panorama over the relief: the frames' colours on the surface as seen from the portal, by the
// light model, the shares and the bands of authoring/panorama.
#pragma once

#include <filesystem>
#include <map>

#include <opencv2/core.hpp>

#include "authoring/relief/make/finish_surface.h"

namespace arthro::authoring {

struct ReliefPicture {
  cv::Mat rgba;   // CV_8UC4
  int scale = 1;  // px per cell
  // Expected error by index of the frame in the footage: mean distance, in px of the picture,
  // between where the frame lays a tracked point and where all frames lay it on average.
  std::map<int, double> error_px;
};

ReliefPicture DrawOverRelief(const std::filesystem::path& footage, const MeasuredRelief& made,
                             const FinishedSurface& finished, const ReliefOptions& options,
                             const Progress& progress);

}  // namespace arthro::authoring
