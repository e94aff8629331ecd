// Radius from brightness, where motion measured none [method.md, Relief from motion]. With poses
// known, a place of albedo a lit by the tip reads, in frame i,
//   e_i = ln a + gain_i + falloff(off axis) + t ln(cos θ_i / |X - C_i|²),
// so that a and the radius separate where the ranges of three frames differ. The light model is
// fitted on the measured cells, and so is the error of this estimate: it is compared there with
// what was measured.
#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "authoring/relief/surface/close_surface.h"
#include "authoring/relief/surface/surface_view.h"
#include "simulation/core/progress.h"

namespace arthro::authoring {

// CV_32FC1, NaN where brightness determines nothing.
struct BrightnessRange {
  cv::Mat radius, sigma;
  double inflation = 0;  // factor on the formal error, by which it fits the measured cells
};

// `pictures`: the views' frames, CV_8UC3, at the lens's scale. `closed`: the surface closed without
// brightness. `visible` as of VisibleCells.
BrightnessRange RangeFromBrightness(const std::vector<SurfaceView>& views,
                                    const std::vector<cv::Mat>& pictures, const LensProfile& lens,
                                    const SurfaceCells& cells, const ClosedSurface& closed,
                                    const std::vector<cv::Mat>& visible, int threads,
                                    const Progress& progress);

}  // namespace arthro::authoring
