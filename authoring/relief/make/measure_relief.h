// The measurement itself, stage by stage, in OpenCV's and Eigen's types; make_relief.h wraps it for
// callers that know neither.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <set>
#include <vector>

#include "authoring/panorama/clip/stage_clock.h"
#include "authoring/relief/motion/motion.h"
#include "authoring/relief/motion/portal.h"
#include "authoring/relief/relief_clip.h"
#include "authoring/relief/relief_options.h"
#include "authoring/relief/surface/sweep.h"

namespace arthro::authoring {

struct MeasuredRelief {
  ReliefClip clip;
  LensProfile lens;
  std::vector<Track> tracks;
  Motion motion;            // in the portal frame, m, once the portal is known
  PivotFit pivot;           // in m, portal frame
  double focal_factor = 1;  // best focal length over the given one
  double focal_sigma = 0;   // standard error of the factor; 0: not determined
  bool is_focal_changed = false;
  bool has_pivot = false;  // the shafts pass one point, and the adjustment used it
  double shaft_miss = 0;   // distance between shafts and portal over the insertion; 1 at most
  SweptSurface surface;
};

// Called after the poses, before the sweep; ends the job by returning false.
using AfterMotion = std::function<bool(const MeasuredRelief&)>;

// Without a lens the focal length is found from the clip.
MeasuredRelief MeasureRelief(const std::filesystem::path& footage, const std::optional<Lens>& lens,
                             const ReliefOptions& options, const std::set<int>& excluded,
                             const AfterMotion& after_motion, StageClock& clock,
                             const MotionObserver& observer = {});

// Probability that a cell is within 1 mm of the surface, CV_32FC1; 0 where nothing was measured.
// The poses are in m.
cv::Mat ConfidenceOf(const SweptSurface& surface, double focal_px, double least_parallax);

// Standard error of the radius where it was measured, CV_32FC1, m; NaN elsewhere.
cv::Mat SigmaOfMeasured(const SweptSurface& surface, double focal_px);

}  // namespace arthro::authoring
