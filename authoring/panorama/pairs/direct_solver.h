// One level of direct alignment: inverse compositional Gauss-Newton [Baker & Matthews 2004] on the
// eight parameters of a homography, over the chosen pixels of frame a. Robust weights exclude
// debris, highlights and tools; a gain relates the two pictures.
//
// Movement of a pixel of a at u = (x - centre) / reach:
//   du = p0 + p1 u + p2 v + u (p6 u + p7 v),   dv = p3 + p4 u + p5 v + v (p6 u + p7 v)
#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "authoring/panorama/pairs/direct_pyramid.h"

namespace arthro::authoring {

using Vec8 = cv::Matx<double, 8, 1>;
using Mat8 = cv::Matx<double, 8, 8>;

enum class Motion { kSimilarity, kAffine, kHomography };

// Part of frame a that the parameters refer to, rectified px.
struct Patch {
  cv::Point2d centre{0, 0};
  double reach_x = 1, reach_y = 1;  // rms distance from the centre along x and y, times sqrt 2
};

// Evidence of the pixels for one homography.
struct Evidence {
  int points = 0;      // points of a that b shows
  double overlap = 0;  // the same as a share of a's points
  double similarity =
      0;  // correlation of the two bands, -1 to 1, mean over cells; the better texture
  double certainty = 0;  // correlation above chance, in deviations
  // Response of the score to a shift, as a share of the normal matrix's prediction. Noise in a's
  // gradients and robust weights make it less than 1.
  double response = 1;
  // Least certainty among nine parts of the overlap, of those that are large enough.
  double weakest_part = 0;
  int cells = 0;  // number of cells with enough points
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
  // Extent of a's points that fall into b; level px of a.
  Patch PatchOf(const cv::Matx33d& h) const;
  // `h` and `patch` in the level's pixels.
  Sums Accumulate(const cv::Matx33d& h, const Patch& patch, bool with_cells);
  // Sets gain and deviation for the next sums from the last ones.
  void Reset();
  void Adapt(const Sums& sums);
  // Weight of a residual: gain over variance.
  double importance() const { return gain_ / (deviation_ * deviation_); }
  double gain() const { return gain_; }
  const std::vector<Cell>& cells() const { return cells_; }

 private:
  cv::Size size_;   // size of a's band
  cv::Mat target_;  // b's band, kOutside beyond it
  std::vector<float> x_, y_, value_, gx_, gy_;
  float gain_ = 1, deviation_ = 1;
  std::vector<Cell> cells_;
};

class DirectSolver {
 public:
  DirectSolver(const DirectLevel& a, const DirectLevel& b);

  // Improves `b_from_a` (rectified px) until a step moves no corner of the patch by more than
  // `enough_px` of this level. Returns false when the frames do not overlap or leave the motion
  // undetermined.
  bool Solve(Motion motion, int most_iterations, double enough_px, cv::Matx33d& b_from_a);

  // Evidence of the pixels at `b_from_a`; computes the response only on request, as it costs four
  // passes.
  Evidence Weigh(const cv::Matx33d& b_from_a, bool with_response);

 private:
  struct Joint {
    int points = 0;
    Mat8 normal = Mat8::zeros();
    Vec8 gradient = Vec8::zeros();
  };
  // Sums of both bands, each with its weight.
  Joint Accumulate(const cv::Matx33d& h, const Patch& patch, bool adapt, bool with_cells);
  double ResponseAt(const cv::Matx33d& h, const Patch& patch);

  cv::Size size_;  // size of a's level
  cv::Matx33d a_level_from_rectified_, b_level_from_rectified_;
  BandSolver bands_[kTextures];
};

}  // namespace arthro::authoring
