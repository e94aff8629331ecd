// From the swept surface to the closed one: confidence, membrane, visibility, brightness.
#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "authoring/relief/make/measure_relief.h"
#include "authoring/relief/surface/close_surface.h"
#include "authoring/relief/surface/surface_view.h"

namespace arthro::authoring {

struct FinishedSurface {
  SurfaceCells cells;
  cv::Mat confidence;    // CV_32FC1, 0 where nothing was measured
  ClosedSurface closed;  // empty: no cell was measured
  std::vector<SurfaceView> views;
  std::vector<cv::Mat> visible;  // per view, as of VisibleCells
  cv::Mat is_seen;               // CV_8UC1, 255 where a view sees the cell
};

FinishedSurface FinishSurface(const MeasuredRelief& made, const ReliefOptions& options,
                              const Progress& progress);

}  // namespace arthro::authoring
