#include "authoring/panorama/pairs/direct_solver.h"

#include <algorithm>
#include <cmath>

#include <opencv2/core/hal/intrin.hpp>

namespace arthro::authoring {
namespace {

constexpr int kBlock = 128;         // points per block; a multiple of 4
constexpr float kOutside = 1e6f;    // residual outside the frame; its weight is zero
constexpr float kTolerance = 4.0f;  // deviations at which the weight of a residual is a quarter
constexpr int kCellSide = 12;       // level px: over three times the band's correlation length
// Number of independent values in a cell: the inverse variance of the correlation of two cells of
// different texture.
constexpr double kFreePerCell = 9.0;
constexpr double kLeastPart = 0.04;  // share of the cells that make a part
constexpr double kLeastGain = 0.1, kMostGain = 1.5;
constexpr int kFewestPoints = 200;

float Dot(const float* a, const float* b) {
  cv::v_float32x4 sum = cv::v_setzero_f32(), more = cv::v_setzero_f32();
  for (int i = 0; i < kBlock; i += 8) {
    sum = cv::v_muladd(cv::v_load(a + i), cv::v_load(b + i), sum);
    more = cv::v_muladd(cv::v_load(a + i + 4), cv::v_load(b + i + 4), more);
  }
  return cv::v_reduce_sum(sum + more);
}

cv::Matx33d StepOf(const Vec8& p) {
  return {1 + p(1), p(2), p(0), p(4), 1 + p(5), p(3), -p(6), -p(7), 1};
}

// Columns: degrees of freedom of the motion.
cv::Mat BasisOf(Motion motion) {
  if (motion == Motion::kSimilarity) {
    cv::Mat basis = cv::Mat::zeros(8, 4, CV_64F);
    basis.at<double>(0, 0) = 1;
    basis.at<double>(3, 1) = 1;
    basis.at<double>(1, 2) = 1;
    basis.at<double>(5, 2) = 1;
    basis.at<double>(2, 3) = -1;
    basis.at<double>(4, 3) = 1;
    return basis;
  }
  return cv::Mat::eye(8, motion == Motion::kAffine ? 6 : 8, CV_64F);
}

// Similarity of a set of cells, by texture.
struct Likeness {
  double sum[kTextures] = {};
  int cells[kTextures] = {};

  void Add(Texture texture, const BandSolver::Cell& cell) {
    sum[texture] += cell.ab / std::sqrt(cell.aa * cell.bb);
    ++cells[texture];
  }
  double Similarity() const {
    double best = 0;
    for (const Texture texture : {kColour, kRelief})
      if (cells[texture] > 0) best = std::max(best, sum[texture] / cells[texture]);
    return best;
  }
  // Certainty by the better texture, or by both when both agree.
  double Certainty() const {
    double best = 0, both = 0;
    for (const Texture texture : {kColour, kRelief}) {
      if (cells[texture] == 0) continue;
      const double certainty = sum[texture] * std::sqrt(kFreePerCell / cells[texture]);
      both += certainty / std::sqrt(2.0);
      best = std::max(best, certainty);
    }
    return std::max(best, both);
  }
};

}  // namespace

BandSolver::BandSolver(const DirectBand& a, const DirectBand& b) : size_(a.values.size()) {
  target_.create(b.values.size(), CV_32FC1);
  for (int y = 0; y < b.values.rows; ++y) {
    const std::int8_t* band = b.values.ptr<std::int8_t>(y);
    float* out = target_.ptr<float>(y);
    for (int x = 0; x < b.values.cols; ++x)
      out[x] = band[x] == kNoBand ? kOutside : static_cast<float>(band[x]) * (1 / kBandUnit);
  }
  const std::size_t count = a.points.size();
  x_.resize(count), y_.resize(count), value_.resize(count), gx_.resize(count), gy_.resize(count);
  const int width = a.values.cols;
  for (std::size_t i = 0; i < count; ++i) {
    const std::int8_t* at = a.values.ptr<std::int8_t>() + a.points[i];
    const int column = a.points[i] % width, row = a.points[i] / width;
    x_[i] = static_cast<float>(column);
    y_[i] = static_cast<float>(row);
    value_[i] = static_cast<float>(at[0]) / kBandUnit;
    gx_[i] = static_cast<float>(at[1] - at[-1]) / (2 * kBandUnit);
    gy_[i] = static_cast<float>(at[width] - at[-width]) / (2 * kBandUnit);
  }
  const int across = width / kCellSide + 1, down = a.values.rows / kCellSide + 1;
  cells_.resize(static_cast<std::size_t>(across) * down);
}

Patch BandSolver::PatchOf(const cv::Matx33d& h) const {
  double sx = 0, sy = 0, sxx = 0, syy = 0;
  int n = 0;
  for (std::size_t i = 0; i < x_.size(); i += 7) {
    const double x = x_[i], y = y_[i], w = h(2, 0) * x + h(2, 1) * y + h(2, 2);
    if (!(w > 1e-6)) continue;
    const double bx = (h(0, 0) * x + h(0, 1) * y + h(0, 2)) / w,
                 by = (h(1, 0) * x + h(1, 1) * y + h(1, 2)) / w;
    if (!(bx >= 0 && by >= 0 && bx < target_.cols - 1 && by < target_.rows - 1)) continue;
    if (target_.at<float>(static_cast<int>(by), static_cast<int>(bx)) == kOutside) continue;
    sx += x, sy += y, sxx += x * x, syy += y * y, ++n;
  }
  if (n < 20) return {{0, 0}, 0, 0};
  const double mx = sx / n, my = sy / n;
  return {{mx, my},
          std::sqrt(2 * std::max(1.0, sxx / n - mx * mx)),
          std::sqrt(2 * std::max(1.0, syy / n - my * my))};
}

BandSolver::Sums BandSolver::Accumulate(const cv::Matx33d& h, const Patch& patch, bool with_cells) {
  Sums sums;
  float H[9];
  for (int i = 0; i < 9; ++i) H[i] = static_cast<float>(h.val[i] / h.val[8]);
  const float cx = static_cast<float>(patch.centre.x), cy = static_cast<float>(patch.centre.y);
  const float rx = static_cast<float>(patch.reach_x), ry = static_cast<float>(patch.reach_y);
  const float inverse = 1 / (kTolerance * deviation_ * kTolerance * deviation_);
  const float right = static_cast<float>(target_.cols - 1),
              bottom = static_cast<float>(target_.rows - 1);
  const std::size_t stride = target_.step1();
  const float* pixels = target_.ptr<float>();
  if (with_cells) std::fill(cells_.begin(), cells_.end(), Cell{});
  const int across = size_.width / kCellSide + 1;

  alignas(16) float b[kBlock], u[kBlock], v[kBlock], a[kBlock], gx[kBlock], gy[kBlock], r[kBlock],
      w[kBlock], J[8][kBlock], wJ[8][kBlock], wr[kBlock], wa[kBlock], one[kBlock], slope[kBlock];
  std::fill(one, one + kBlock, 1.0f);
  for (std::size_t start = 0; start < x_.size(); start += kBlock) {
    const int n = static_cast<int>(std::min<std::size_t>(kBlock, x_.size() - start));
    for (int i = 0; i < kBlock; ++i) {
      const std::size_t k = start + static_cast<std::size_t>(i < n ? i : 0);
      const float x = x_[k], y = y_[k];
      u[i] = (x - cx) / rx, v[i] = (y - cy) / ry;
      a[i] = value_[k], gx[i] = gx_[k] * rx, gy[i] = gy_[k] * ry;
      const float d = 1 / (H[6] * x + H[7] * y + H[8]);
      const float bx = (H[0] * x + H[1] * y + H[2]) * d, by = (H[3] * x + H[4] * y + H[5]) * d;
      b[i] = kOutside;
      if (i < n && d > 0 && bx >= 0 && by >= 0 && bx < right && by < bottom) {
        const int ix = static_cast<int>(bx), iy = static_cast<int>(by);
        const float fx = bx - static_cast<float>(ix), fy = by - static_cast<float>(iy);
        const float* at = pixels + static_cast<std::size_t>(iy) * stride + ix;
        const float top = at[0] + fx * (at[1] - at[0]);
        const float low = at[stride] + fx * (at[stride + 1] - at[stride]);
        b[i] = top + fy * (low - top);
      }
    }
    for (int i = 0; i < kBlock; ++i) {
      const float seen = std::abs(b[i]) < 4.0f ? 1.0f : 0.0f;
      b[i] *= seen;
      const float residual = b[i] - gain_ * a[i];
      const float t = 1 / (1 + residual * residual * inverse);
      r[i] = residual;
      w[i] = seen * t * t;
      slope[i] = w[i] * (1 - 4 * residual * residual * inverse * t);
      one[i] = seen;
      const float q = gx[i] * u[i] + gy[i] * v[i];
      J[0][i] = gx[i], J[1][i] = gx[i] * u[i], J[2][i] = gx[i] * v[i];
      J[3][i] = gy[i], J[4][i] = gy[i] * u[i], J[5][i] = gy[i] * v[i];
      J[6][i] = q * u[i], J[7][i] = q * v[i];
      wr[i] = w[i] * residual;
      wa[i] = w[i] * a[i];
    }
    for (int j = 0; j < 8; ++j)
      for (int i = 0; i < kBlock; ++i) wJ[j][i] = w[i] * J[j][i];
    for (int j = 0; j < 8; ++j) {
      sums.gradient(j) += Dot(J[j], wr);
      for (int k = j; k < 8; ++k) sums.normal(j, k) += Dot(wJ[j], J[k]);
    }
    for (int i = 0; i < kBlock; ++i) wJ[0][i] = w[i] * b[i], wJ[1][i] = std::abs(r[i]);
    sums.weight += Dot(w, one);
    sums.slope += Dot(slope, one);
    sums.aa += Dot(wa, a), sums.ab += Dot(wa, b), sums.bb += Dot(wJ[0], b);
    sums.magnitude += Dot(w, wJ[1]);
    sums.points += static_cast<int>(Dot(one, one));
    if (with_cells)
      for (int i = 0; i < n; ++i) {
        const std::size_t k = start + static_cast<std::size_t>(i);
        const int row = static_cast<int>(y_[k]) / kCellSide,
                  column = static_cast<int>(x_[k]) / kCellSide;
        Cell& cell = cells_[static_cast<std::size_t>(row) * static_cast<std::size_t>(across) +
                            static_cast<std::size_t>(column)];
        cell.aa += one[i] * a[i] * a[i];
        cell.ab += one[i] * a[i] * b[i];
        cell.bb += one[i] * b[i] * b[i];
        for (int j = 0; j < 8; ++j) cell.score[j] += wr[i] * J[j][i];
      }
  }
  for (int j = 0; j < 8; ++j)
    for (int k = 0; k < j; ++k) sums.normal(j, k) = sums.normal(k, j);
  return sums;
}

void BandSolver::Reset() { gain_ = 0.5f, deviation_ = 1.0f; }

void BandSolver::Adapt(const Sums& sums) {
  if (!(sums.weight > 0 && sums.aa > 0)) return;
  gain_ = static_cast<float>(std::clamp(sums.ab / sums.aa, kLeastGain, kMostGain));
  // Ratio of a normal deviate's standard deviation to its weighted mean magnitude.
  deviation_ = static_cast<float>(std::clamp(1.2533 * sums.magnitude / sums.weight, 0.05, 1.5));
}

DirectSolver::DirectSolver(const DirectLevel& a, const DirectLevel& b)
    : size_(a.size()),
      a_level_from_rectified_(a.level_from_rectified),
      b_level_from_rectified_(b.level_from_rectified),
      bands_{{a.bands[kColour], b.bands[kColour]}, {a.bands[kRelief], b.bands[kRelief]}} {}

DirectSolver::Joint DirectSolver::Accumulate(const cv::Matx33d& h, const Patch& patch, bool adapt,
                                             bool with_cells) {
  Joint joint;
  for (BandSolver& band : bands_) {
    const BandSolver::Sums sums = band.Accumulate(h, patch, with_cells);
    if (!(sums.weight > 0)) continue;
    if (adapt) band.Adapt(sums);
    // Weights decrease for large residuals, so the score responds less than the normal matrix
    // predicts.
    const double slope = std::clamp(sums.slope / sums.weight, 0.4, 1.0);
    joint.points += sums.points;
    joint.normal += sums.normal * (band.importance() * band.gain() * slope);
    joint.gradient += sums.gradient * band.importance();
  }
  return joint;
}

bool DirectSolver::Solve(Motion motion, int most_iterations, double enough_px,
                         cv::Matx33d& b_from_a) {
  cv::Matx33d h = b_level_from_rectified_ * b_from_a * a_level_from_rectified_.inv();
  const Patch patch = bands_[kColour].PatchOf(h);
  if (!(patch.reach_x > 2 && patch.reach_y > 2)) return false;
  const cv::Matx33d norm(1 / patch.reach_x, 0, -patch.centre.x / patch.reach_x, 0,
                         1 / patch.reach_y, -patch.centre.y / patch.reach_y, 0, 0, 1);
  const cv::Matx33d norm_inverse = norm.inv();
  const cv::Mat basis = BasisOf(motion);
  for (BandSolver& band : bands_) band.Reset();
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    const Joint joint = Accumulate(h, patch, true, false);
    if (joint.points < kFewestPoints) return false;
    cv::Mat normal = basis.t() * cv::Mat(joint.normal) * basis;
    const double damping = 1e-3 * cv::trace(normal)[0] / normal.rows;
    for (int i = 0; i < normal.rows; ++i) normal.at<double>(i, i) += damping;
    cv::Mat step;
    if (!cv::solve(normal, basis.t() * cv::Mat(joint.gradient), step, cv::DECOMP_CHOLESKY))
      return false;
    Vec8 p = Vec8(cv::Mat(basis * step));

    // Limits the step to the band's linear range.
    double longest = 0;
    for (const double u : {-1.0, 1.0})
      for (const double v : {-1.0, 1.0}) {
        const double q = p(6) * u + p(7) * v;
        longest =
            std::max(longest, std::hypot((p(0) + p(1) * u + p(2) * v + u * q) * patch.reach_x,
                                         (p(3) + p(4) * u + p(5) * v + v * q) * patch.reach_y));
      }
    constexpr double kLongestStep = 2.0;  // level px
    if (!(longest < 1e6)) return false;
    if (longest > kLongestStep) p *= kLongestStep / longest;
    h = h * norm_inverse * StepOf(p).inv() * norm;
    h *= 1 / h(2, 2);
    if (longest < enough_px) break;
  }
  b_from_a = b_level_from_rectified_.inv() * h * a_level_from_rectified_;
  b_from_a *= 1 / b_from_a(2, 2);
  return std::isfinite(cv::norm(b_from_a));
}

double DirectSolver::ResponseAt(const cv::Matx33d& h, const Patch& patch) {
  double answer = 0, expected = 0;
  for (const int axis : {0, 3}) {
    const double step = 0.5;  // px of this level: within the band's linear range
    double side[2];
    for (const int sign : {0, 1}) {
      const double d = sign ? step : -step;
      const cv::Matx33d shift(1, 0, axis == 0 ? d : 0, 0, 1, axis == 3 ? d : 0, 0, 0, 1);
      const Joint there = Accumulate(h * shift, patch, false, false);
      side[sign] = there.gradient(axis);
      expected += there.normal(axis, axis) * step / (axis == 0 ? patch.reach_x : patch.reach_y);
    }
    answer += side[1] - side[0];
  }
  return expected > 0 ? std::clamp(answer / expected, 0.02, 1.5) : 0;
}

Evidence DirectSolver::Weigh(const cv::Matx33d& b_from_a, bool with_response) {
  Evidence evidence;
  const cv::Matx33d h = b_level_from_rectified_ * b_from_a * a_level_from_rectified_.inv();
  const Patch patch = bands_[kColour].PatchOf(h);
  if (!(patch.reach_x > 2 && patch.reach_y > 2)) return evidence;
  for (BandSolver& band : bands_) band.Reset();
  if (Accumulate(h, patch, true, false).points < kFewestPoints) return evidence;
  if (with_response) evidence.response = ResponseAt(h, patch);
  const Joint joint = Accumulate(h, patch, false, true);
  evidence.points = joint.points;
  evidence.overlap = static_cast<double>(joint.points) /
                     static_cast<double>(bands_[kColour].size() + bands_[kRelief].size());
  evidence.normal = joint.normal;

  const std::size_t count = bands_[kColour].cells().size();
  const int across = size_.width / kCellSide + 1;
  Likeness whole, parts[9];
  for (std::size_t i = 0; i < count; ++i) {
    // Thirds of the overlap in both directions; those of an ellipse hold about as many cells each.
    const int column = static_cast<int>(i) % across, row = static_cast<int>(i) / across;
    const double x = (column + 0.5) * kCellSide, y = (row + 0.5) * kCellSide;
    const auto third = [](double u) { return u < -0.45 ? 0 : u < 0.45 ? 1 : 2; };
    Likeness& part = parts[3 * third((y - patch.centre.y) / patch.reach_y) +
                           third((x - patch.centre.x) / patch.reach_x)];
    Vec8 score = Vec8::zeros();
    bool is_counted = false;
    for (const Texture texture : {kColour, kRelief}) {
      const BandSolver::Cell& cell = bands_[texture].cells()[i];
      if (!(cell.aa > 0 && cell.bb > 0)) continue;
      is_counted = true;
      whole.Add(texture, cell);
      part.Add(texture, cell);
      for (int j = 0; j < 8; ++j)
        score(j) += static_cast<double>(cell.score[j]) * bands_[texture].importance();
    }
    evidence.cells += is_counted;
    evidence.scatter += score * score.t();
  }
  evidence.similarity = whole.Similarity();
  evidence.certainty = whole.Certainty();
  evidence.weakest_part = evidence.certainty;
  for (const Likeness& part : parts)
    if (part.cells[kColour] > evidence.cells * kLeastPart)
      evidence.weakest_part = std::min(evidence.weakest_part, part.Certainty());

  const double scale = a_level_from_rectified_(0, 0);
  const cv::Matx33d back = a_level_from_rectified_.inv();
  evidence.patch = {
      {back(0, 0) * patch.centre.x + back(0, 2), back(1, 1) * patch.centre.y + back(1, 2)},
      patch.reach_x / scale,
      patch.reach_y / scale};
  return evidence;
}

}  // namespace arthro::authoring
