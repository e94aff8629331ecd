// Removes the distortion of a raw frame: computes the picture that a pinhole camera with the lens's
// focal length (at the axis) would have taken. A pixel of the rectified picture (x right, y down,
// origin at the centre of the top-left pixel) is the ray ((x - cx)/f, (y - cy)/f, 1) in the camera
// frame.
//
// A working picture is the same view at a smaller scale s: x_work = (x + 0.5) s - 0.5, likewise y.
#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "authoring/lens/rectify_options.h"
#include "simulation/scene/lens.h"

namespace arthro::authoring {

struct RectifiedView {
  int width = 0, height = 0;
  double focal_px = 0, cx = 0, cy = 0;  // at scale 1
};

// Smallest view that contains all that the lens sees: inside its circle minus the margin, inside
// the picture, and within the largest half angle. Throws Error(kBadArgument) when the lens sees
// nothing, or so much that no picture could hold it.
RectifiedView ViewOf(const Lens& lens, const RectifyOptions& options);

// Maps that are computed once and applied to every frame. Safe to call from several threads.
class Rectifier {
 public:
  Rectifier(const Lens& lens, const RectifyOptions& options, double scale = 1.0);

  const RectifiedView& view() const { return view_; }
  cv::Size size() const { return mask_.size(); }  // size of the pictures at this scale
  // CV_8UC1, 255 where the lens shows something.
  const cv::Mat& mask() const { return mask_; }

  // Takes raw pixels that show no tissue, such as burned-in text, out of the mask and the pictures.
  void Exclude(const std::vector<cv::Rect>& raw);

  // 8-bit, one or three channels; black outside the mask. Below scale 1 the raw pixels are
  // averaged, not skipped. Throws Error(kBadImage) when the size of `raw` is not the lens's.
  void Rectify(const cv::Mat& raw, cv::Mat& rectified) const;

 private:
  RectifiedView view_;
  int raw_width_ = 0, raw_height_ = 0;
  double scale_ = 1.0;
  int samples_ = 1;                       // samples per side, averaged for one pixel of this scale
  cv::Mat map_xy_, map_fraction_, mask_;  // the maps at `samples_` times the size
};

}  // namespace arthro::authoring
