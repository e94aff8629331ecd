// Score of a registration of a rendered clip. Nine points per frame, the centre and eight at 85 %
// of the round window, are mapped to the panorama and compared with the truth. One homography
// between the two panoramas is fitted before, since the panorama's plane is free. A frame is right
// when its worst point is less than 10 px off. The published numbers use the same measure.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "authoring/panorama/placed_frame.h"
#include "authoring/phantom/clip/clip.h"

namespace arthro::test {

inline constexpr double kRightPx = 10;

struct ClipScore {
  int frames = 0, placed = 0, right = 0;
  double mean_px = 0, max_px = 0;  // over the nine points of the right frames
  std::vector<double> worst_px;    // one per result; NaN where it was not placed
  int wrong_as_good = 0;           // placed, 10 px or more off, and expected to be less
  double covered = 1;              // share of placed frames whose expected error is not passed
  cv::Matx33d truth_from_panorama = cv::Matx33d::eye();

  std::string Text() const;
};

// The nine points in rectified pixels.
std::vector<cv::Point2d> NinePoints(const authoring::Clip& clip,
                                    const authoring::RectifiedView& view);

// `truth` of each result, rectified to panorama px, and the nine points; with `is_blank` (may be
// empty), whether the frame shows nothing.
ClipScore ScorePlaces(std::span<const cv::Point2d> nine, std::span<const cv::Matx33d> truth,
                      const std::vector<bool>& is_blank,
                      std::span<const authoring::FrameResult> results, int component = 0);

// Scores the results in `component`; `results[i].index` is the frame of the clip. A blank frame
// that was placed counts as wrong.
ClipScore ScoreClip(const authoring::Clip& clip, const authoring::RectifiedView& view,
                    std::span<const authoring::FrameResult> results, int component = 0);

}  // namespace arthro::test
