// A clip with exactly known truth: an equisolid scope with the light at its tip moves over a plane.
// Frames are drawn on request, with the same bytes in any order and from any thread. Every frame
// has an exact homography to the plane; with relief, it is the homography of the mean plane.
//  Light: albedo × cosine / distance², vignetting, and highlights off small bumps. Then follow
//  haze, debris, a tool, an exposure that follows the mean, the shoulder of a camera, noise and
//  gamma.
#pragma once

#include <cstdint>
#include <vector>

#include <opencv2/core.hpp>

#include "authoring/lens/rectifier.h"
#include "authoring/phantom/clip/clip_options.h"
#include "authoring/phantom/clip/clip_overlays.h"
#include "authoring/phantom/clip/clip_path.h"
#include "authoring/phantom/clip/plane_texture.h"
#include "authoring/phantom/shape/noise.h"
#include "simulation/scene/lens.h"

namespace arthro::authoring {

class Clip {
 public:
  // Makes a clip over a procedural knee that is as large as the path needs. Throws
  // Error(kBadArgument) for options outside their ranges.
  explicit Clip(const ClipOptions& options);
  // Makes a clip over a picture (CV_8UC3, RGB). Throws Error(kBadImage) when the picture is smaller
  // than a view of it.
  Clip(const ClipOptions& options, const cv::Mat& picture);

  const ClipOptions& options() const { return options_; }
  const Lens& lens() const { return lens_; }
  int frames() const { return options_.frames; }

  // CV_8UC3, RGB, as the camera delivers it; black outside the round window.
  cv::Mat Frame(int index) const;
  // True homography from pixels of the rectified frame to panorama pixels.
  cv::Matx33d PanoramaFromRectified(int index, const RectifiedView& view) const;
  ScopePose PoseOf(int index) const { return path_.At(index, index); }
  // True for a frame that is red throughout.
  bool IsBlank(int index) const;

  // Evenly lit plane with the camera's gamma: CV_8UC3, RGB. Reference for a perfect panorama.
  cv::Mat Panorama() const;
  cv::Size panorama_size() const { return texture_.albedo.size(); }

  // Objects that hide the plane, raw pixels: CV_8UC1, 255 where they do. The tool moves; marks
  // stay.
  cv::Mat ToolMask(int index) const;
  cv::Mat MarksMask() const;
  // CV_8UC1, 255 inside the round window.
  const cv::Mat& window() const { return window_; }

 private:
  void MakeWindow();
  cv::Rect Footprint() const;
  void FollowLight();
  Random RandomOf(int index, int what) const;
  cv::Mat LightOf(int index) const;  // CV_32FC3, light reflected by the plane

  ClipOptions options_;
  Lens lens_;
  double radius_ = 0;
  ClipPathway path_;
  PlaneTexture texture_;
  // One ray per pixel inside the window, row by row.
  std::vector<cv::Vec3f> rays_;
  std::vector<float> off_axis_;      // share of half the field of view
  std::vector<cv::Vec2i> row_span_;  // first and last + 1 column
  cv::Mat window_, clouds_;
  StaticMarks marks_;
  std::vector<float> exposure_;  // one per frame
  std::vector<bool> is_blank_;
  std::vector<std::uint8_t> code_;  // gamma code by linear light, 65535 = 1
};

}  // namespace arthro::authoring
