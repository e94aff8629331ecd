// Light of an arthroscope: it is fixed to the camera, so one falloff serves the whole clip. In
// addition each frame has one gain (the camera's automatic exposure). Both scale red, green and
// blue equally, so that no tissue changes hue.
//
// Model in the logarithm of the recorded level, e(y) = ln y + b0 y^2 + b1 y^6 for a grey level y
// from 0 to 1. The camera's gamma only scales e; b bends it in the compressed bright tones. A place
// of the tissue with brightness A reads
//   e(y) = A + v . (u, u^2, u^3) + t ln w + gain + field(x, y)
// with u = sin^2 of the angle off the axis, as a share of the clip's largest, and w the
// homography's denominator. w is proportional to the distance of a flat scene, so t ln w is the
// inverse square law and the slant of a tilted view. It is exact for a plane, whatever plane the
// panorama lies in, since the rest depends on the place alone. `field` is the low-frequency residue
// of one frame, kept small.
#pragma once

#include <array>
#include <vector>

#include <opencv2/core.hpp>

#include "authoring/panorama/compose/frame_cells.h"
#include "simulation/core/progress.h"

namespace arthro::authoring {

struct FrameLight {
  double gain = 0;  // natural logarithm
  std::array<double, 5>
      field{};  // x, y, x^2 - y^2, xy, x^2 + y^2 of the unit vector over sqrt(reach)
};

struct LightModel {
  std::array<double, 2> response{};  // b
  std::array<double, 3> falloff{};   // v
  double tilt = 0;                   // t
  double reach = 1;                  // the largest sin^2 of an angle off the axis
  double level = 0;                  // level at which A is shown: keeps the usual brightness
  std::vector<FrameLight> frames;

  // e(y), y from 0 to 1.
  double Exposure(double y) const;
  // Excess of frame `f` at a ray, in e.
  double Excess(int f, const CellRays::Ray& ray) const;
};

// Grey level of the panorama for an exposure e: the camera's own curve.
class ToneCurve {
 public:
  explicit ToneCurve(const LightModel& light);
  // Linear tone exp(e(y)) for a grey level of 0..255, and the inverse.
  float Linear(int grey) const { return linear_[grey]; }
  float Linear(double grey) const;
  float Grey(float linear) const;

 private:
  static constexpr int kSteps = 4096;
  std::vector<float> linear_, grey_;
  float largest_ = 1;
};

// Estimates the light from overlaps of frames. `cells` and `rays` by frame; frames that were not
// read are skipped.
LightModel EstimateLight(const std::vector<FrameCells>& cells, const std::vector<CellRays>& rays,
                         const Layout& layout, const ComposeOptions& options,
                         const Progress& progress);

// Removes the light from a frame's cells.
void EvenLight(FrameCells& cells, const CellRays& rays, const cv::Rect& box,
               const LightModel& light, int f, const ToneCurve& tone);

}  // namespace arthro::authoring
