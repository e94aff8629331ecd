// One level of direct alignment: inverse compositional Gauss-Newton [Baker & Matthews 2004] on the
// eight parameters of a homography, over the chosen pixels of frame a, with weights that let
// debris, glints and tools drop out, and a gain between the two pictures.
//
// A pixel of a at u = (x - centre) / reach moves by
//   du = p0 + p1 u + p2 v + u (p6 u + p7 v),   dv = p3 + p4 u + p5 v + v (p6 u + p7 v)
#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "authoring/panorama/pairs/direct_pyramid.h"

namespace arthro::authoring {

using Vec8 = cv::Matx<double, 8, 1>;
using Mat8 = cv::Matx<double, 8, 8>;

enum class Motion { kSimilarity, kAffine, kHomography };

// The part of frame a that parameters refer to, rectified px.
struct Patch {
  cv::Point2d centre{0, 0};
  double reach_x = 1, reach_y = 1;  // rms distance from the centre along x and y, times sqrt 2
};

// What the pixels say at one homography.
struct Evidence {
  int points = 0;         // of a that b shows
  double overlap = 0;     // the same as a share of a's points
  double similarity = 0;  // correlation of the two bands, -1 to 1, mean over cells
  double certainty = 0;   // how far that stands above chance, in deviations
  double gain = 1, deviation = 1;
  // How strongly the score answers a shift, as a share of what the normal matrix says: both the
  // noise in a's gradients and weights that fall where residuals grow make it less than 1.
  double response = 1;
  int cells = 0;  // that have a say
  Patch patch;
  Mat8 normal = Mat8::zeros();   // Σ w J Jᵀ
  Mat8 scatter = Mat8::zeros();  // Σ over cells of s sᵀ, s = Σ w Jᵀ r of a cell
};

class DirectSolver {
 public:
  DirectSolver(const DirectLevel& a, const DirectLevel& b);

  // Improves `b_from_a` (rectified px). Returns the last step, px of this level at the patch's
  // corners, or nothing when the frames do not overlap or the least squares is singular.
  bool Solve(Motion motion, int most_iterations, double enough_px, cv::Matx33d& b_from_a);

  // What the pixels say at `b_from_a`; the response only when asked for, as it costs four passes.
  Evidence Weigh(const cv::Matx33d& b_from_a, bool with_response);

 private:
  struct Sums {
    double weight = 0, slope = 0, aa = 0, ab = 0, bb = 0, magnitude = 0;
    int points = 0;
    Mat8 normal = Mat8::zeros();
    Vec8 gradient = Vec8::zeros();
  };
  Patch PatchOf(const cv::Matx33d& h) const;
  double ResponseAt(const cv::Matx33d& h);
  Sums Accumulate(const cv::Matx33d& h, bool with_cells);

  const DirectLevel& a_;
  cv::Matx33d b_level_from_rectified_;
  cv::Mat target_;  // b's band, kOutside where there is none
  std::vector<float> x_, y_, value_, gx_, gy_;
  Patch patch_;  // level px of a
  float gain_ = 1, deviation_ = 1;
  struct Cell {
    float aa = 0, ab = 0, bb = 0;
    float score[8] = {};
  };
  std::vector<Cell> cells_;
};

}  // namespace arthro::authoring
