// Composes placed frames to one panorama, in two sequential passes over the footage [paper, 3.1;
// Brown & Lowe 2007]. Panorama pixels: origin at the centre of the top-left pixel, x right, y down;
// colours RGB.
//
// The first pass keeps a small picture of each frame, on the panorama's grid of cells (8 px wide,
// for example). All decisions are made on these pictures: the light (one falloff for the clip, one
// gain per frame), the consensus of the frames at each cell, and the weights of the frames at each
// cell. The second pass adds the fine detail of the chosen frames, each within its own box. Memory
// holds the panorama and the small pictures, whose total size is bounded.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "authoring/lens/rectifier.h"
#include "authoring/panorama/compose/compose_options.h"
#include "authoring/panorama/frames/placed_frame.h"
#include "simulation/core/progress.h"

namespace arthro::authoring {

// Reads raw frames of the footage in order: sets `index` (in the footage) and the picture. Returns
// false at the end; the next call begins again with the first frame. Each pass reads to the end.
using FrameSource = std::function<bool(int& index, cv::Mat& raw_rgb)>;

// Receives the current panorama as a small RGBA picture, for a window. Called from the job's
// thread.
using ComposeObserver = std::function<void(const cv::Mat& small_rgba, double done)>;

struct FrameLeftOut {
  int index = 0;  // in the footage
  std::string reason;
};

struct ComposeReport {
  int frames_seen = 0;          // placed frames whose picture was read
  int frames_contributing = 0;  // frames among them with a share in the panorama's detail
  std::vector<FrameLeftOut> left_out;
  double scale = 1;          // panorama px per px of the plane of registration
  int cell = 0;              // width of a cell, panorama px
  double covered_share = 0;  // imaged share of the panorama's pixels
  double hole_share = 0;     // share of the imaged part that is filled because every frame is
                             // overexposed or blocked there
  double outlier_share =
      0;  // share of the frames' cells that was dropped as tool, debris or highlight
  double gain_spread = 1;    // largest over smallest gain of the frames
  double light_residue = 0;  // grey levels: median distance of the frames from the consensus
  double light_ms = 0, seams_ms = 0, first_pass_ms = 0, second_pass_ms = 0;  // processor time
};

struct ComposedPanorama {
  cv::Mat rgba;  // CV_8UC4, straight alpha; empty: nothing
  cv::Matx33d composed_from_panorama =
      cv::Matx33d::eye();  // homography from the plane of registration
  RectifiedView view;      // the panorama as a pinhole picture: size, focal length, centre, px
};

// Composes the frames of component 0. `rectifier` must have scale 1. Returns an empty picture when
// nothing is placed. Throws Error(kCancelled) when `progress` asks to stop, and Error(kBadArgument)
// for options out of range or homographies that are not finite.
ComposedPanorama Compose(const FrameSource& source, const Rectifier& rectifier,
                         const std::vector<FrameResult>& frames, const ComposeOptions& options,
                         ComposeReport* report, const Progress& progress,
                         const ComposeObserver& observer = {});

}  // namespace arthro::authoring
