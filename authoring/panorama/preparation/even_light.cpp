#include "authoring/panorama/preparation/even_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <opencv2/imgproc.hpp>

namespace arthro::authoring {
namespace {

constexpr int kCell = 8;           // px; light that would need a finer grid is texture
constexpr double kFineEnough = 6;  // cells per sigma at least; 3 are less accurate

// Moments of the unmasked pixels about their cell's centre, in cells, for the fit of a plane.
struct MaskMoments {
  double w = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;
};
struct ValueMoments {
  float f = 0, fx = 0, fy = 0;
};

// Adds moments about a centre that is (dx, dy) away from the sum's centre.
void AddShifted(MaskMoments& to, const MaskMoments& from, double weight, double dx, double dy) {
  const double w = weight * from.w, x = weight * from.x, y = weight * from.y;
  to.w += w;
  to.x += x + w * dx;
  to.y += y + w * dy;
  to.xx += weight * from.xx + 2 * dx * x + w * dx * dx;
  to.xy += weight * from.xy + dx * y + dy * x + w * dx * dy;
  to.yy += weight * from.yy + 2 * dy * y + w * dy * dy;
}

void AddShifted(ValueMoments& to, const ValueMoments& from, float weight, float dx, float dy) {
  const float f = weight * from.f;
  to.f += f;
  to.fx += weight * from.fx + f * dx;
  to.fy += weight * from.fy + f * dy;
}

// The separable Gaussian over a grid of cells.
template <class M>
void Blur(std::vector<M>& cells, int columns, int rows, const std::vector<float>& kernel) {
  const int reach = static_cast<int>(kernel.size()) - 1;
  std::vector<M> across(cells.size());
  for (int y = 0; y < rows; ++y) {
    const M* from = &cells[static_cast<std::size_t>(y) * columns];
    M* to = &across[static_cast<std::size_t>(y) * columns];
    for (int x = 0; x < columns; ++x) {
      M sum;
      for (int k = std::max(-reach, -x); k <= std::min(reach, columns - 1 - x); ++k)
        AddShifted(sum, from[x + k], kernel[std::abs(k)], static_cast<float>(k), 0);
      to[x] = sum;
    }
  }
  std::fill(cells.begin(), cells.end(), M());
  for (int y = 0; y < rows; ++y)
    for (int k = std::max(-reach, -y); k <= std::min(reach, rows - 1 - y); ++k) {
      const M* from = &across[static_cast<std::size_t>(y + k) * columns];
      M* to = &cells[static_cast<std::size_t>(y) * columns];
      for (int x = 0; x < columns; ++x)
        AddShifted(to[x], from[x], kernel[std::abs(k)], 0, static_cast<float>(k));
    }
}

// Calls run(first pixel, pixels, whether all of them count) for each piece of a row within one cell
// that has unmasked pixels.
template <class Run>
void ForRuns(const std::uint8_t* mask, int count, const Run& run) {
  for (int x = 0; x < count; x += kCell) {
    const int pixels = std::min(kCell, count - x);
    int unmasked = 0;
    for (int i = 0; i < pixels; ++i) unmasked += mask[x + i] != 0;
    if (unmasked > 0) run(x, pixels, unmasked == kCell);
  }
}

}  // namespace

cv::Mat MixColours(const cv::Mat& rgb, const ColourMix& mix) {
  const double sum = std::max(1e-9, mix.red + mix.green + mix.blue);
  const float r = static_cast<float>(mix.red / sum), g = static_cast<float>(mix.green / sum),
              b = static_cast<float>(mix.blue / sum);
  cv::Mat mixed(rgb.size(), CV_32F);
  for (int y = 0; y < rgb.rows; ++y) {
    const std::uint8_t* in = rgb.ptr<std::uint8_t>(y);
    float* out = mixed.ptr<float>(y);
    for (int x = 0; x < rgb.cols; ++x, in += 3) out[x] = r * in[0] + g * in[1] + b * in[2];
  }
  return mixed;
}

cv::Mat LogOf(const cv::Mat& mixed) {
  // A table in steps of 1/16 grey level, interpolated: a tenth of the cost of std::log.
  constexpr int kSteps = 16;
  static const std::vector<float> table = [] {
    std::vector<float> t(256 * kSteps + 2);
    for (std::size_t i = 0; i < t.size(); ++i)
      t[i] = static_cast<float>(std::log(std::max(1.0, static_cast<double>(i) / kSteps)));
    return t;
  }();
  cv::Mat log(mixed.size(), CV_32F);
  for (int y = 0; y < mixed.rows; ++y) {
    const float* in = mixed.ptr<float>(y);
    float* out = log.ptr<float>(y);
    for (int x = 0; x < mixed.cols; ++x) {
      const float at = std::clamp(in[x], 0.0f, 255.0f) * kSteps;
      const int i = static_cast<int>(at);
      out[x] = table[i] + (at - static_cast<float>(i)) * (table[i + 1] - table[i]);
    }
  }
  return log;
}

void RemoveQuadratic(cv::Mat& value, const cv::Mat& mask) {
  constexpr int kStep = 4;  // px; light is smooth enough for this spacing
  using Terms = cv::Vec<double, 6>;
  const double half_x = 0.5 * value.cols, half_y = 0.5 * value.rows;
  const auto terms = [&](int x, int y) {
    const double u = x / half_x - 1, v = y / half_y - 1;
    return Terms(1, u, v, u * u, u * v, v * v);
  };
  cv::Matx<double, 6, 6> normal =
      cv::Matx<double, 6, 6>::eye() * 1e-6;  // with few pixels the fit stays flat
  Terms right = Terms::all(0);
  for (int y = 0; y < value.rows; y += kStep)
    for (int x = 0; x < value.cols; x += kStep) {
      if (!mask.at<std::uint8_t>(y, x)) continue;
      const Terms t = terms(x, y);
      for (int i = 0; i < 6; ++i) {
        right[i] += t[i] * value.at<float>(y, x);
        for (int j = 0; j < 6; ++j) normal(i, j) += t[i] * t[j];
      }
    }
  const Terms c = normal.solve(right, cv::DECOMP_CHOLESKY);
  for (int y = 0; y < value.rows; ++y) {
    float* row = value.ptr<float>(y);
    const double v = y / half_y - 1;
    const double a = c[0] + v * (c[2] + v * c[5]), b = c[1] + v * c[4];
    for (int x = 0; x < value.cols; ++x) {
      const double u = x / half_x - 1;
      row[x] -= static_cast<float>(a + u * (b + u * c[3]));
    }
  }
}

MaskedSurround::MaskedSurround(const cv::Mat& mask, double sigma) : mask_(mask), cell_(kCell) {
  while (sigma >= kFineEnough * 2 * cell_) cell_ *= 2;
  columns_ = (mask.cols + cell_ - 1) / cell_;
  rows_ = (mask.rows + cell_ - 1) / cell_;
  const double sigma_cells = std::max(0.3, sigma / cell_);
  kernel_.resize(static_cast<std::size_t>(std::ceil(3 * sigma_cells)) + 1);
  for (std::size_t k = 0; k < kernel_.size(); ++k)
    kernel_[k] = static_cast<float>(
        std::exp(-0.5 * static_cast<double>(k * k) / (sigma_cells * sigma_cells)));

  std::vector<MaskMoments> cells(static_cast<std::size_t>(columns_) * rows_);
  for (int y = 0; y < mask.rows; ++y) {
    const std::uint8_t* m = mask.ptr<std::uint8_t>(y);
    MaskMoments* row = &cells[static_cast<std::size_t>(y / cell_) * columns_];
    const double v = (y % cell_ + 0.5) / cell_ - 0.5;
    ForRuns(m, mask.cols, [&](int x, int pixels, bool) {
      int n = 0, sum = 0, squares = 0;
      for (int i = 0; i < pixels; ++i) {
        const int here = m[x + i] != 0;
        n += here;
        sum += here * i;
        squares += here * i * i;
      }
      const double u = (x % cell_ + 0.5) / cell_ - 0.5, su = static_cast<double>(sum) / cell_;
      const double along = n * u + su;
      MaskMoments& cell = row[x / cell_];
      cell.w += n;
      cell.x += along;
      cell.y += n * v;
      cell.xx += n * u * u + 2 * u * su + static_cast<double>(squares) / (cell_ * cell_);
      cell.xy += along * v;
      cell.yy += n * v * v;
    });
  }
  Blur(cells, columns_, rows_, kernel_);

  // The plane's value at a cell's centre is linear in the cell's pixels. A small ridge keeps the
  // slope at 0 when the pixels do not determine it.
  planes_.resize(cells.size());
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const MaskMoments& m = cells[i];
    if (m.w <= 0) continue;
    const double mx = m.x / m.w, my = m.y / m.w;
    const double ridge = 0.02 * kCell * kCell / (cell_ * cell_);  // cells squared
    const double xx = m.xx / m.w - mx * mx + ridge, yy = m.yy / m.w - my * my + ridge;
    const double xy = m.xy / m.w - mx * my, determinant = xx * yy - xy * xy;
    const double p = (yy * mx - xy * my) / determinant, q = (xx * my - xy * mx) / determinant;
    planes_[i] = {static_cast<float>((1 + p * mx + q * my) / m.w), static_cast<float>(-p / m.w),
                  static_cast<float>(-q / m.w)};
  }
}

cv::Mat MaskedSurround::Of(const cv::Mat& value) const {
  std::vector<ValueMoments> cells(planes_.size());
  const float per_px = 1.0f / static_cast<float>(cell_);
  for (int y = 0; y < value.rows; ++y) {
    const float* f = value.ptr<float>(y);
    const std::uint8_t* m = mask_.ptr<std::uint8_t>(y);
    ValueMoments* row = &cells[static_cast<std::size_t>(y / cell_) * columns_];
    const float v = (static_cast<float>(y % cell_) + 0.5f) * per_px - 0.5f;
    ForRuns(m, value.cols, [&](int x, int pixels, bool is_full) {
      float sum = 0, first = 0;
      if (is_full) {
        for (int i = 0; i < kCell; ++i) {
          sum += f[x + i];
          first += f[x + i] * static_cast<float>(i);
        }
      } else {
        for (int i = 0; i < pixels; ++i) {
          if (!m[x + i]) continue;
          sum += f[x + i];
          first += f[x + i] * static_cast<float>(i);
        }
      }
      const float u = (static_cast<float>(x % cell_) + 0.5f) * per_px - 0.5f;
      ValueMoments& cell = row[x / cell_];
      cell.f += sum;
      cell.fx += sum * u + first * per_px;
      cell.fy += sum * v;
    });
  }
  Blur(cells, columns_, rows_, kernel_);
  cv::Mat grid(rows_, columns_, CV_32F), whole;
  float* out = grid.ptr<float>();
  for (std::size_t i = 0; i < cells.size(); ++i)
    out[i] = planes_[i][0] * cells[i].f + planes_[i][1] * cells[i].fx + planes_[i][2] * cells[i].fy;
  cv::resize(grid, whole, {columns_ * cell_, rows_ * cell_}, 0, 0, cv::INTER_LINEAR);
  return whole(cv::Rect(0, 0, value.cols, value.rows));
}

void NoiseCurve::Add(const cv::Mat& mixed, const cv::Mat& mask) {
  if (counts_.empty()) counts_ = cv::Mat_<int>::zeros(kBins, kLevels);
  // Immerkaer's filter: it cancels planes, and its response to white noise is 6 times the noise.
  for (int y = 1; y + 1 < mixed.rows; y += 2) {
    const float *a = mixed.ptr<float>(y - 1), *b = mixed.ptr<float>(y),
                *c = mixed.ptr<float>(y + 1);
    const std::uint8_t *ma = mask.ptr<std::uint8_t>(y - 1), *mc = mask.ptr<std::uint8_t>(y + 1);
    for (int x = 1; x + 1 < mixed.cols; x += 2) {
      if (!ma[x - 1] || !ma[x + 1] || !mc[x - 1] || !mc[x + 1]) continue;
      const float answer = a[x - 1] - 2 * a[x] + a[x + 1] - 2 * b[x - 1] + 4 * b[x] - 2 * b[x + 1] +
                           c[x - 1] - 2 * c[x] + c[x + 1];
      const int level = std::min(kLevels - 1, static_cast<int>(std::abs(answer) * (4.0f / 6.0f)));
      const int bin = std::clamp(static_cast<int>(b[x]) / (256 / kBins), 0, kBins - 1);
      ++counts_(bin, level);
      ++pixels_;
    }
  }
}

void NoiseCurve::Finish() {
  constexpr double kQuartile = 0.3186;  // quartile of |x| of a normal x, in standard deviations
  constexpr int kEnough = 200;          // pixels for a quartile to within a few percent
  constexpr double kRounding = 0.2;     // grey levels
  std::vector<int> known;
  for (int bin = 0; bin < kBins && !counts_.empty(); ++bin) {
    int total = 0, below = 0;
    for (int l = 0; l < kLevels; ++l) total += counts_(bin, l);
    if (total < kEnough) continue;
    for (int l = 0; l < kLevels; ++l) {
      const int here = counts_(bin, l);
      if (below + here < total / 4 || here == 0) {
        below += here;
        continue;
      }
      const double at = l + (total / 4.0 - below) / here;
      sigma_[bin] = std::max(kRounding, at / 4.0 / kQuartile);
      break;
    }
    known.push_back(bin);
  }
  // Levels of brightness without samples take the noise of the nearest level with samples.
  for (int bin = 0; bin < kBins; ++bin) {
    int nearest = -1;
    for (const int k : known)
      if (nearest < 0 || std::abs(k - bin) < std::abs(nearest - bin)) nearest = k;
    sigma_[bin] = nearest < 0 ? 1.0 : sigma_[nearest];
  }
}

double NoiseCurve::At(double grey) const {
  const double at = std::clamp(grey / (256.0 / kBins) - 0.5, 0.0, kBins - 1.0);
  const int i = std::min(static_cast<int>(at), kBins - 2);
  return sigma_[i] + (at - i) * (sigma_[i + 1] - sigma_[i]);
}

}  // namespace arthro::authoring
