// Radii of the surface over directions from the portal. For each direction radii are tried, the
// frames are compared where they see the point, and a smooth surface of best agreement is chosen by
// semi-global matching [Hirschmüller 2008]. Poses are in the portal frame.
#pragma once

#include <optional>
#include <vector>

#include <opencv2/core.hpp>

#include "authoring/panorama/frames/working_frame.h"
#include "authoring/relief/motion/bundle/bundle.h"
#include "authoring/relief/motion/bundle/lens_profile.h"
#include "authoring/relief/relief_options.h"
#include "simulation/core/progress.h"
#include "simulation/scene/projection.h"

namespace arthro::authoring {

// Cells are the pixels of `projection`; CV_32FC1 each, NaN where nothing was measured.
struct SweptSurface {
  Projection projection;
  cv::Mat radius;      // in the unit of the poses
  cv::Mat agreement;   // 0 to 1, share of the frames that agree within 1 px
  cv::Mat peak;        // correlation at the radius
  cv::Mat margin;      // how far the best other radius lies below it
  cv::Mat parallax;    // rad, largest angle between two rays
  cv::Mat range;       // mean distance to the tips that see it
  cv::Mat steadiness;  // 0 to 1, share of the surround whose own best radius is the smooth one
  cv::Mat seen_by;     // frames
};

SweptSurface SweepSurface(const std::vector<WorkingFrame>& frames, const LensProfile& lens,
                          const Reconstruction& scene, const ReliefOptions& options,
                          const Progress& progress);

}  // namespace arthro::authoring
