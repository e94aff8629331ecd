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
  int points = 0;      // of a that b shows
  double overlap = 0;  // the same as a share of a's points
  double similarity =
      0;  // correlation of the two bands, -1 to 1, mean over cells; the better texture
  double certainty = 0;  // how far that stands above chance, in deviations
  // How strongly the score answers a shift, as a share of what the normal matrix says: both the
  // noise in a's gradients and weights that fall where residuals grow make it less than 1.
  double response = 1;
  // The least certainty of nine parts of the overlap, of those large enough to tell.
  double weakest_part = 0;
  int cells = 0;  // that have a say
  Patch patch;
  Mat8 normal = Mat8::zeros();   // Σ w J Jᵀ
  Mat8 scatter = Mat8::zeros();  // Σ over cells of s sᵀ, s = Σ w Jᵀ r of a cell
};

// One band of the level.
class BandSolver {
 public:
  struct Sums {
    double weight = 0, slope = 0, aa = 0, ab = 0, bb = 0, magnitude = 0;
    int points = 0;
    Mat8 normal = Mat8::zeros();
    Vec8 gradient = Vec8::zeros();
  };
  struct Cell {
    float aa = 0, ab = 0, bb = 0;
    float score[8] = {};
  };
  BandSolver(const DirectBand& a, const DirectBand& b);

  std::size_t size() const { return x_.size(); }
  // Level px of a: the part of a's points that lands in b.
  Patch PatchOf(const cv::Matx33d& h) const;
  // `h` and `patch` of the level's pixels.
  Sums Accumulate(const cv::Matx33d& h, const Patch& patch, bool with_cells);
  // Gain and deviation for the next sums, from the last.
  void Reset();
  void Adapt(const Sums& sums);
  // What a residual counts: gain over variance.
  double importance() const { return gain_ / (deviation_ * deviation_); }
  double gain() const { return gain_; }
  const std::vector<Cell>& cells() const { return cells_; }

 private:
  cv::Size size_;   // of a's band
  cv::Mat target_;  // b's band, kOutside where there is none
  std::vector<float> x_, y_, value_, gx_, gy_;
  float gain_ = 1, deviation_ = 1;
  std::vector<Cell> cells_;
};

class DirectSolver {
 public:
  DirectSolver(const DirectLevel& a, const DirectLevel& b);

  // Improves `b_from_a` (rectified px) until a step moves no corner of the patch by more than
  // `enough_px` of this level. False when the frames do not overlap or nothing fixes them.
  bool Solve(Motion motion, int most_iterations, double enough_px, cv::Matx33d& b_from_a);

  // What the pixels say at `b_from_a`; the response only when asked for, as it costs four passes.
  Evidence Weigh(const cv::Matx33d& b_from_a, bool with_response);

 private:
  struct Joint {
    int points = 0;
    Mat8 normal = Mat8::zeros();
    Vec8 gradient = Vec8::zeros();
  };
  // Both bands, each with the weight that it deserves.
  Joint Accumulate(const cv::Matx33d& h, const Patch& patch, bool adapt, bool with_cells);
  double ResponseAt(const cv::Matx33d& h, const Patch& patch);

  cv::Size size_;  // of a's level
  cv::Matx33d a_level_from_rectified_, b_level_from_rectified_;
  BandSolver bands_[kTextures];
};

}  // namespace arthro::authoring
