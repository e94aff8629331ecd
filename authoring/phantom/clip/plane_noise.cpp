#include "authoring/phantom/clip/plane_noise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <opencv2/imgproc.hpp>

#include "simulation/core/units.h"

namespace arthro::authoring {
namespace {

constexpr int kQuantiles = 4096;

// Inverse of the cumulative normal distribution [Acklam 2003].
double Quantile(double p) {
  const auto tail = [](double q) {
    return (((((-7.784894002430293e-03 * q - 3.223964580411365e-01) * q - 2.400758277161838) * q -
              2.549732539343734) *
                 q +
             4.374664141464968) *
                q +
            2.938163982698783) /
           ((((7.784695709041462e-03 * q + 3.224671290700398e-01) * q + 2.445134137142996) * q +
             3.754408661907416) *
                q +
            1.0);
  };
  if (p < 0.02425) return tail(std::sqrt(-2 * std::log(p)));
  if (p > 1 - 0.02425) return -tail(std::sqrt(-2 * std::log(1 - p)));
  const double q = p - 0.5, r = q * q;
  return (((((-3.969683028665376e+01 * r + 2.209460984245205e+02) * r - 2.759285104469687e+02) * r +
            1.383577518672690e+02) *
               r -
           3.066479806614716e+01) *
              r +
          2.506628277459239) *
         q /
         (((((-5.447609879822406e+01 * r + 1.615858368580409e+02) * r - 1.556989798598866e+02) * r +
            6.680131188771972e+01) *
               r -
           1.328068155288572e+01) *
              r +
          1.0);
}

struct Quantiles {
  std::array<float, kQuantiles> of;
  Quantiles() {
    for (int i = 0; i < kQuantiles; ++i)
      of[static_cast<std::size_t>(i)] = static_cast<float>(Quantile((i + 0.5) / kQuantiles));
  }
};
const Quantiles kNormal;

// One octave: random values on a grid, interpolated smoothly.
void AddOctave(cv::Mat& sum, double cell, double stretch, double strength, Random& random) {
  cv::Mat grid(std::max(2, static_cast<int>(sum.rows / cell) + 3),
               std::max(2, static_cast<int>(sum.cols / cell / stretch) + 3), CV_32F);
  for (int y = 0; y < grid.rows; ++y)
    for (int x = 0; x < grid.cols; ++x)
      grid.at<float>(y, x) = static_cast<float>(strength) * NormalOf(random.Next());
  cv::Mat fine;
  cv::resize(grid, fine, sum.size(), 0, 0, cv::INTER_CUBIC);
  sum += fine;
}

struct Walk {
  cv::Mat& picture;
  Random& random;
  double scale;

  void Go(double x, double y, double heading, double length, double thickness, int generation) {
    const double stride = 12 * scale;
    std::vector<cv::Point> line;
    for (int i = static_cast<int>(length / 12); i > 0; --i) {
      heading += 0.22 * NormalOf(random.Next());
      x += stride * std::cos(heading);
      y += stride * std::sin(heading);
      line.emplace_back(static_cast<int>(std::lround(8 * x)), static_cast<int>(std::lround(8 * y)));
      if (generation < 3 && random.Uniform(0, 1) < 0.05) {
        const double side = random.Uniform(0, 1) < 0.5 ? -1.0 : 1.0;
        Go(x, y, heading + side * random.Uniform(0.4, 1.0), length * 0.5, thickness * 0.65,
           generation + 1);
      }
    }
    if (line.size() > 1)
      cv::polylines(picture, line, false, cv::Scalar(255),
                    std::max(1, static_cast<int>(std::lround(thickness * scale))), cv::LINE_AA, 3);
  }
};

}  // namespace

float NormalOf(std::uint64_t bits) { return kNormal.of[(bits >> 20) & (kQuantiles - 1)]; }

cv::Mat PlaneNoise(cv::Size size, const NoiseShape& shape, Random& random) {
  // Coarse octaves are computed at low resolution, with no visible difference and a sixteenth of
  // the work.
  constexpr double kCoarse = 24;  // px, size of a cell
  constexpr double kFinest = 2;   // px
  const cv::Size quarter((size.width + 3) / 4, (size.height + 3) / 4);
  cv::Mat coarse, fine;
  double strength = 1, total = 0, cell = shape.cell;
  for (int octave = 0; octave < shape.octaves; ++octave) {
    if (cell >= kCoarse && size.area() > 256) {
      if (coarse.empty()) coarse = cv::Mat::zeros(quarter, CV_32F);
      AddOctave(coarse, cell / 4, shape.stretch, strength, random);
    } else {
      if (fine.empty()) fine = cv::Mat::zeros(size, CV_32F);
      AddOctave(fine, cell, shape.stretch, strength, random);
    }
    total += strength * strength;
    strength *= shape.gain;
    cell = std::max(kFinest, cell / 2);
  }
  cv::Mat sum;
  if (!coarse.empty()) {
    cv::resize(coarse, sum, size, 0, 0, cv::INTER_LINEAR);
    if (!fine.empty()) sum += fine;
  } else {
    sum = fine;
  }
  sum *= 1.0 / std::sqrt(total);
  return sum;
}

cv::Mat VesselsOnPlane(cv::Size size, int count, double thickness, double scale, Random& random) {
  cv::Mat drawn = cv::Mat::zeros(size, CV_8U), soft;
  Walk walk{drawn, random, scale};
  for (int i = 0; i < count; ++i) {
    const double x = random.Uniform(0, size.width), y = random.Uniform(0, size.height),
                 heading = random.Uniform(0, kRadianPerTurn), length = random.Uniform(300, 1500),
                 thick = random.Uniform(1, thickness);
    walk.Go(x, y, heading, length, thick, 0);
  }
  cv::GaussianBlur(drawn, drawn, {}, std::max(0.7, 1.2 * scale));
  drawn.convertTo(soft, CV_32F, 1 / 255.0);
  return soft;
}

}  // namespace arthro::authoring
