// Placed frames to one panorama, in two sequential passes over the footage [paper, 3.1;
// Brown & Lowe 2007]. Panorama pixels: origin at the centre of the top-left pixel,
// x right, y down; colours RGB.
//
// The first pass keeps a small picture of each frame, on the panorama's grid of cells (8 px wide,
// say). All decisions are made on these: the light (one falloff for the clip, one gain a frame),
// what most frames show at a place, and which frames a place is taken from. The second pass adds
// the fine detail of the frames that were chosen, each within its own box. Memory is that of the
// panorama plus the small pictures, whose total is bounded.
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

// Raw frames of the footage in order: sets `index` (in the footage) and the picture. False at the
// end; the call after that begins with the first frame again. Each pass reads to the end.
using FrameSource = std::function<bool(int& index, cv::Mat& raw_rgb)>;

// A small RGBA panorama as it stands, for a window. Called from the job's thread.
using ComposeObserver = std::function<void(const cv::Mat& small_rgba, double done)>;

struct FrameLeftOut {
  int index = 0;  // in the footage
  std::string reason;
};

struct ComposeReport {
  int frames_seen = 0;          // placed frames whose picture was read
  int frames_contributing = 0;  // of these, in the panorama's detail
  std::vector<FrameLeftOut> left_out;
  double scale = 1;          // panorama px per px of the plane of registration
  int cell = 0;              // width of a cell, panorama px
  double covered_share = 0;  // of the panorama's pixels, imaged
  double hole_share = 0;     // of the imaged part, filled because every frame glares or is blocked
  double outlier_share = 0;  // of what frames show, dropped as tool, debris or glint
  double gain_spread = 1;    // largest over smallest gain of a frame
  double light_residue = 0;  // grey levels: how far frames are from the consensus, median
  double light_ms = 0, seams_ms = 0, first_pass_ms = 0, second_pass_ms = 0;  // CPU
};

struct ComposedPanorama {
  cv::Mat rgba;  // CV_8UC4, straight alpha; empty: nothing
  cv::Matx33d composed_from_panorama = cv::Matx33d::eye();  // of the plane of registration
  RectifiedView view;  // the panorama as a pinhole picture: size, focal length, centre, px
};

// Composes the frames of component 0. `rectifier` must have scale 1. Nothing placed gives an empty
// picture. Throws Error(kCancelled) when `progress` says so, Error(kBadArgument) for options out of
// range or homographies that are not finite.
ComposedPanorama Compose(const FrameSource& source, const Rectifier& rectifier,
                         const std::vector<FrameResult>& frames, const ComposeOptions& options,
                         ComposeReport* report, const Progress& progress,
                         const ComposeObserver& observer = {});

}  // namespace arthro::authoring
