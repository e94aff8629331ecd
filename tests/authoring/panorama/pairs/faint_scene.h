// Frames of a flat scene with faint texture as WorkingFrames: exact homographies, noise, debris,
// highlights, a gain per frame.
#pragma once

#include <cmath>
#include <cstdint>

#include <opencv2/imgproc.hpp>

#include "authoring/panorama/frames/working_frame.h"

namespace arthro::test {

struct FaintLook {
  double texture = 6;  // grey levels, standard deviation
  double noise = 6;
  double gain = 1;
  int blobs = 0;  // bright discs fixed to the lens, not to the scene
  std::uint64_t seed = 1;
};

class FaintScene {
 public:
  static constexpr int kSide = 480;  // px, rectified frames
  static constexpr double kScale = 0.5;

  explicit FaintScene(std::uint64_t seed = 7) : texture_(1100, 1100, CV_32FC1, cv::Scalar(0)) {
    // Equal shares of texture at three sizes, scene px.
    cv::RNG random(seed);
    for (const double sigma : {3.0, 6.0, 12.0}) {
      cv::Mat layer(texture_.size(), CV_32FC1);
      random.fill(layer, cv::RNG::NORMAL, 0, 1);
      cv::GaussianBlur(layer, layer, {0, 0}, sigma);
      texture_ += layer * (2 * std::sqrt(CV_PI) * sigma / std::sqrt(3.0));
    }
  }

  // Homography from frame pixels to the scene: rotation and zoom about the frame's middle, then a
  // shift; `tilt` is the last row's part, px^-1.
  static cv::Matx33d Pose(double x, double y, double angle = 0, double zoom = 1,
                          cv::Vec2d tilt = {0, 0}) {
    const double m = 0.5 * (kSide - 1), c = zoom * std::cos(angle), s = zoom * std::sin(angle);
    const cv::Matx33d centred(1, 0, -m, 0, 1, -m, 0, 0, 1);
    return cv::Matx33d(c, -s, 550 + x, s, c, 550 + y, 0, 0, 1) *
           cv::Matx33d(1, 0, 0, 0, 1, 0, tilt[0], tilt[1], 1) * centred;
  }

  authoring::WorkingFrame Frame(const cv::Matx33d& scene_from_frame, const FaintLook& look) const {
    const int side = static_cast<int>(kSide * kScale);
    const cv::Matx33d frame_from_working(1 / kScale, 0, 0.5 / kScale - 0.5, 0, 1 / kScale,
                                         0.5 / kScale - 0.5, 0, 0, 1);
    cv::Mat seen;
    cv::warpPerspective(texture_, seen, scene_from_frame * frame_from_working, {side, side},
                        cv::INTER_CUBIC | cv::WARP_INVERSE_MAP, cv::BORDER_REFLECT);
    cv::Mat noise(seen.size(), CV_32FC1);
    cv::RNG random(look.seed);
    random.fill(noise, cv::RNG::NORMAL, 0, look.noise);
    seen = seen * (look.gain * look.texture) + noise;
    authoring::WorkingFrame frame;
    frame.scale = kScale;
    seen.convertTo(frame.grey, CV_8UC1, 1, 128);
    for (int i = 0; i < look.blobs; ++i)
      cv::circle(frame.grey, {random.uniform(0, side), random.uniform(0, side)},
                 random.uniform(4, 14), random.uniform(0, 2) ? 230 : 30, -1);
    frame.mask = cv::Mat::zeros(side, side, CV_8UC1);
    cv::circle(frame.mask, {side / 2, side / 2}, side / 2 - 3, 255, -1);
    frame.grey.setTo(0, frame.mask == 0);
    return frame;
  }

 private:
  cv::Mat texture_;
};

}  // namespace arthro::test
