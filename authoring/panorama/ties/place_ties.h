// Places frames by tie points of a person [method.md, Tie points]. The pairs of a frame give a
// similarity to a frame of the panorama, which is checked before it is used; then the frame's own
// pixels refine it, where they can. Frames that are in the panorama already keep their places.
#pragma once

#include <set>
#include <vector>

#include <opencv2/core.hpp>

#include "authoring/panorama/clip/panorama_report.h"
#include "authoring/panorama/clip/prepared_clip.h"
#include "authoring/panorama/frames/placed_frame.h"
#include "authoring/panorama/graph/links/frame_window.h"
#include "authoring/panorama/graph/register_options.h"
#include "authoring/panorama/ties/frame_tie.h"
#include "simulation/core/progress.h"

namespace arthro::authoring {

// Standard error of one click, px per coordinate.
inline constexpr double kClickDeviation = 1.5;

// Fit of the pairs of one frame: b = scale R(angle) a + shift.
struct TieFit {
  cv::Matx33d b_from_a = cv::Matx33d::eye();
  double scale = 1, rms_px = 0;
  cv::Point2d middle;     // mean of the points in a
  double square_sum = 0;  // squared distances of the points in a from it
  int pairs = 0;
};

// The error of the fit at a point of a, by the clicks alone, px.
double TieError(const TieFit& fit, const cv::Point2d& point_in_a);

// Fits a similarity to the pairs and checks it. `names`: of the pairs, for messages. `window_px`:
// diameter of a frame's window. Throws Error(kBadData): fewer than two pairs, points that lie too
// close together, a pair that contradicts the others (it is named), a change of size that no camera
// path makes.
TieFit FitTies(const std::vector<cv::Point2d>& a, const std::vector<cv::Point2d>& b,
               const std::vector<std::string>& names, double window_px);

// Adds the tied frames to `placed`, and the frames of a separate piece with the frame that ties it.
// `composed_from_plane`: the panorama without tied frames, for pairs in its pixels. Throws
// Error(kBadData) for ties that cannot be used, and Error(kCancelled).
std::vector<TiedFrame> PlaceTies(const PreparedClip& clip, const std::vector<FrameTie>& ties,
                                 const std::set<int>& excluded,
                                 const cv::Matx33d& composed_from_plane,
                                 const RegisterOptions& options, std::vector<FrameResult>& placed,
                                 const Progress& progress);

}  // namespace arthro::authoring
