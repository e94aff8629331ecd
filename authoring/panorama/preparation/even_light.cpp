#include "authoring/panorama/preparation/even_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <opencv2/imgproc.hpp>

namespace arthro::authoring {
namespace {

constexpr int kCell = 8;  // px; a light that needs a finer grid than this is texture

// Moments of the unmasked pixels about their cell's centre, in cells: what a plane is fitted from.
enum Moment { kW, kX, kY, kXX, kXY, kYY, kF, kFX, kFY, kMoments };
using Moments = std::array<double, kMoments>;

void AddPixel(Moments& m, double x, double y, double f) {
  m[kW] += 1;
  m[kX] += x;
  m[kY] += y;
  m[kXX] += x * x;
  m[kXY] += x * y;
  m[kYY] += y * y;
  m[kF] += f;
  m[kFX] += f * x;
  m[kFY] += f * y;
}

// Adds moments that were taken about a centre (dx, dy) away from the sum's centre.
void AddShifted(Moments& to, const Moments& from, double weight, double dx, double dy) {
  const double w = weight * from[kW], x = weight * from[kX], y = weight * from[kY];
  to[kW] += w;
  to[kX] += x + w * dx;
  to[kY] += y + w * dy;
  to[kXX] += weight * from[kXX] + 2 * dx * x + w * dx * dx;
  to[kXY] += weight * from[kXY] + dx * y + dy * x + w * dx * dy;
  to[kYY] += weight * from[kYY] + 2 * dy * y + w * dy * dy;
  const double f = weight * from[kF];
  to[kF] += f;
  to[kFX] += weight * from[kFX] + f * dx;
  to[kFY] += weight * from[kFY] + f * dy;
}

// Value at the centre of the plane through the moments. A little ridge keeps the slope at 0 where
// the pixels in reach do not tell it.
double PlaneAtCentre(const Moments& m) {
  if (m[kW] <= 0) return 0;
  const double mx = m[kX] / m[kW], my = m[kY] / m[kW], mf = m[kF] / m[kW];
  const double ridge = 0.02;  // cells squared
  const double xx = m[kXX] / m[kW] - mx * mx + ridge, yy = m[kYY] / m[kW] - my * my + ridge;
  const double xy = m[kXY] / m[kW] - mx * my;
  const double fx = m[kFX] / m[kW] - mf * mx, fy = m[kFY] / m[kW] - mf * my;
  const double determinant = xx * yy - xy * xy;
  const double slope_x = (fx * yy - fy * xy) / determinant;
  const double slope_y = (fy * xx - fx * xy) / determinant;
  return mf - slope_x * mx - slope_y * my;
}

// One row or column of the separable Gaussian, about cells `stride` apart.
void BlurLine(const Moments* from, Moments* to, int count, int stride, bool along_x,
              const std::vector<double>& kernel) {
  const int reach = static_cast<int>(kernel.size()) - 1;
  for (int i = 0; i < count; ++i) {
    Moments sum{};
    for (int k = std::max(-reach, -i); k <= std::min(reach, count - 1 - i); ++k) {
      const Moments& m = from[(i + k) * stride];
      if (m[kW] > 0) AddShifted(sum, m, kernel[std::abs(k)], along_x ? k : 0, along_x ? 0 : k);
    }
    to[i * stride] = sum;
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
  // A table in steps of 1/16 grey level, interpolated: a tenth of the price of std::log.
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
  constexpr int kStep = 4;  // px; a light needs no more samples
  using Terms = cv::Vec<double, 6>;
  const double half_x = 0.5 * value.cols, half_y = 0.5 * value.rows;
  const auto terms = [&](int x, int y) {
    const double u = x / half_x - 1, v = y / half_y - 1;
    return Terms(1, u, v, u * u, u * v, v * v);
  };
  cv::Matx<double, 6, 6> normal = cv::Matx<double, 6, 6>::eye() * 1e-6;  // few pixels: stays flat
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

cv::Mat MaskedLowPass(const cv::Mat& value, const cv::Mat& mask, double sigma) {
  const int columns = (value.cols + kCell - 1) / kCell, rows = (value.rows + kCell - 1) / kCell;
  std::vector<Moments> cells(static_cast<std::size_t>(columns) * rows), blurred(cells.size());
  for (int y = 0; y < value.rows; ++y) {
    const float* f = value.ptr<float>(y);
    const std::uint8_t* m = mask.ptr<std::uint8_t>(y);
    Moments* row = &cells[static_cast<std::size_t>(y / kCell) * columns];
    const double v = (y % kCell + 0.5) / kCell - 0.5;
    for (int cx = 0; cx < columns; ++cx)
      for (int x = cx * kCell; x < std::min(value.cols, (cx + 1) * kCell); ++x)
        if (m[x]) AddPixel(row[cx], (x - cx * kCell + 0.5) / kCell - 0.5, v, f[x]);
  }

  const double sigma_cells = std::max(0.3, sigma / kCell);
  std::vector<double> kernel(static_cast<std::size_t>(std::ceil(3 * sigma_cells)) + 1);
  for (std::size_t k = 0; k < kernel.size(); ++k)
    kernel[k] = std::exp(-0.5 * static_cast<double>(k * k) / (sigma_cells * sigma_cells));
  for (int y = 0; y < rows; ++y)
    BlurLine(&cells[static_cast<std::size_t>(y) * columns],
             &blurred[static_cast<std::size_t>(y) * columns], columns, 1, true, kernel);
  for (int x = 0; x < columns; ++x) BlurLine(&blurred[x], &cells[x], rows, columns, false, kernel);

  cv::Mat grid(rows, columns, CV_32F);
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x)
      grid.at<float>(y, x) =
          static_cast<float>(PlaneAtCentre(cells[static_cast<std::size_t>(y) * columns + x]));
  cv::Mat whole;
  cv::resize(grid, whole, {columns * kCell, rows * kCell}, 0, 0, cv::INTER_LINEAR);
  return whole(cv::Rect(0, 0, value.cols, value.rows));
}

void NoiseCurve::Add(const cv::Mat& mixed, const cv::Mat& mask) {
  if (counts_.empty()) counts_ = cv::Mat_<int>::zeros(kBins, kLevels);
  // Immerkaer's filter: blind to planes, and its answer to white noise is 6 times the noise.
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
  constexpr double kQuartile = 0.3186;  // of |x| of a normal x, in standard deviations
  constexpr int kEnough = 200;          // pixels for a quartile within some percent
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
  // Brightnesses that were not seen are taken from the nearest that was.
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
