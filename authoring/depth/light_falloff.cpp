#include "authoring/depth/light_falloff.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "authoring/depth/highlights.h"
#include "authoring/depth/noise/guided_smoothing.h"

namespace arthro::authoring {
namespace {

// Linear albedos of pale cartilage and of red synovium; tissue is modelled as a mixture of the two.
constexpr float kPaleRed = 0.86f, kPaleGreen = 0.80f, kRedRed = 0.72f, kRedGreen = 0.36f;
constexpr float kDarkest = 2e-3f;      // linear light; darker pixels hold only noise
constexpr double kEdge = 0.10;         // share of brightness; half of it in distance
constexpr double kChromaBlur = 1.5;    // px
constexpr double kNormalBlur = 4;      // px at kSlopeSize; finer structure is texture, not slope
constexpr float kLeastCosine = 0.45f;  // cosine; a steeper place is an edge between two surfaces
// Relaxation factor of one iteration. Above a half, steep places oscillate.
constexpr float kTrust = 0.3f;
// Shorter side at which slopes are computed, so that a picture and its preview have the same
// slopes.
constexpr int kSlopeSize = 240;                    // px
constexpr double kWide = RadiansFromDegrees(120);  // a wider picture is not a pinhole's

// Linear light by 16-bit grey.
std::vector<float> Decoding(double gamma) {
  std::vector<float> linear(kWhite + 1);
  for (std::size_t grey = 0; grey < linear.size(); ++grey)
    linear[grey] =
        std::max(kDarkest, static_cast<float>(std::pow(static_cast<double>(grey) / kWhite, gamma)));
  return linear;
}

// One linear channel with its highlights filled.
cv::Mat LinearChannel(const ColourImage& picture, const GreyPlane& plane,
                      const std::vector<std::uint8_t>& highlight, int channel,
                      const std::vector<float>& linear) {
  GreyPlane own{plane.width, plane.height, {}, plane.imaged};
  own.grey.resize(plane.imaged.size());
  for (std::size_t i = 0; i < own.grey.size(); ++i)
    own.grey[i] =
        static_cast<std::uint16_t>(256 * picture.rgb[3 * i + static_cast<std::size_t>(channel)]);
  if (!highlight.empty()) FillHighlights(own, highlight);
  cv::Mat light(plane.height, plane.width, CV_32F);
  for (std::size_t i = 0; i < own.grey.size(); ++i) light.ptr<float>()[i] = linear[own.grey[i]];
  return light;
}

// Angular scale of the picture: pixels per radian in its middle, and whether it is a pinhole's.
struct Geometry {
  float focal = 1, cx = 0, cy = 0;
  bool is_pinhole = true;
};

Geometry GeometryOf(int width, int height, double field_of_view) {
  const double half = std::min(width, height) / 2.0;
  Geometry g;
  g.is_pinhole = field_of_view <= kWide;
  g.focal = static_cast<float>(std::max(
      1e-3, g.is_pinhole ? half / std::tan(field_of_view / 2) : half / (field_of_view / 2)));
  g.cx = static_cast<float>((width - 1) / 2.0);
  g.cy = static_cast<float>((height - 1) / 2.0);
  return g;
}

// Vignetting of the lens, 1 in the middle.
cv::Mat VignetteOf(const cv::Size& size, const DepthOptions& options) {
  const Geometry g = GeometryOf(size.width, size.height, options.field_of_view);
  cv::Mat share(size, CV_32F);
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x) {
      const float away =
          std::hypot(static_cast<float>(x) - g.cx, static_cast<float>(y) - g.cy) / g.focal;
      const float theta = g.is_pinhole ? std::atan(away) : away;
      const float rim = std::min(1.0f, theta / static_cast<float>(options.field_of_view / 2));
      share.at<float>(y, x) = 1 - static_cast<float>(options.vignette) * rim * rim;
    }
  return share;
}

// Brightness divided by the tissue's albedo: the lower green is against red, the more synovium.
cv::Mat WithoutTissue(const cv::Mat& red, const cv::Mat& green, const cv::Mat& weight) {
  cv::Mat ratio;
  cv::divide(green, red, ratio);
  ratio = WeightedBlur(ratio, weight, kChromaBlur);
  cv::Mat light(red.size(), CV_32F);
  constexpr float kPaleRatio = kPaleGreen / kPaleRed, kRedRatio = kRedGreen / kRedRed;
  for (int y = 0; y < light.rows; ++y)
    for (int x = 0; x < light.cols; ++x) {
      const float share =
          std::clamp((kPaleRatio - ratio.at<float>(y, x)) / (kPaleRatio - kRedRatio), 0.0f, 1.0f);
      light.at<float>(y, x) =
          0.5f * (red.at<float>(y, x) / (kPaleRed + share * (kRedRed - kPaleRed)) +
                  green.at<float>(y, x) / (kPaleGreen + share * (kRedGreen - kPaleGreen)));
    }
  return light;
}

// Cosine of the angle between ray and surface normal. On a range map it is 1/√(1 + |∇ log
// distance|²), with the gradient per radian of the ray's direction.
float CosineAt(const cv::Mat& log_distance, const cv::Mat& known, const Geometry& g, int x, int y) {
  // Differences are taken between known pixels only.
  const cv::Point here(x, y);
  const auto slope = [&](cv::Point a, cv::Point b) {
    if (known.at<float>(a) == 0) a = here;
    if (known.at<float>(b) == 0) b = here;
    const int apart = std::abs(b.x - a.x) + std::abs(b.y - a.y);
    if (apart == 0) return 0.0f;
    return g.focal * (log_distance.at<float>(b) - log_distance.at<float>(a)) /
           static_cast<float>(apart);
  };
  const float gx = slope({std::max(0, x - 1), y}, {std::min(known.cols - 1, x + 1), y});
  const float gy = slope({x, std::max(0, y - 1)}, {x, std::min(known.rows - 1, y + 1)});
  float steep = gx * gx + gy * gy;
  if (g.is_pinhole) {  // metric of the sphere in a pinhole's picture
    const float u = (static_cast<float>(x) - g.cx) / g.focal,
                v = (static_cast<float>(y) - g.cy) / g.focal;
    steep = (1 + u * u + v * v) * (steep + (u * gx + v * gy) * (u * gx + v * gy));
  }
  return std::max(kLeastCosine, 1 / std::sqrt(1 + steep));
}

// Fixed point of log distance = ½ log(cosine / brightness): a slope away from the light is darker
// than its distance alone explains.
cv::Mat Shaded(const cv::Mat& from_light, const cv::Mat& weight, const DepthOptions& options,
               const Progress& progress) {
  const double scale = static_cast<double>(kSlopeSize) / std::min(from_light.rows, from_light.cols);
  cv::Mat start = from_light, known = weight;
  if (scale < 1) {
    const cv::Size size(static_cast<int>(std::lround(scale * from_light.cols)),
                        static_cast<int>(std::lround(scale * from_light.rows)));
    cv::Mat total;
    cv::resize(from_light.mul(weight), start, size, 0, 0, cv::INTER_AREA);
    cv::resize(weight, total, size, 0, 0, cv::INTER_AREA);
    cv::divide(start, cv::max(total, 1e-6), start);
    cv::Mat(total > 0.5).convertTo(known, CV_32F, 1 / 255.0);
  }
  const Geometry g = GeometryOf(start.cols, start.rows, options.field_of_view);
  cv::Mat log_distance = start.clone(), correction = cv::Mat::zeros(start.size(), CV_32F);
  for (int round = 0; round < options.iterations; ++round) {
    progress.Step("shading", 0.6 + 0.3 * round / options.iterations);
    const cv::Mat smooth = WeightedBlur(log_distance, known, kNormalBlur);
    ForStripsOfRows(smooth.rows, [&](int first, int last) {
      for (int y = first; y < last; ++y)
        for (int x = 0; x < smooth.cols; ++x) {
          if (known.at<float>(y, x) == 0) continue;
          float& c = correction.at<float>(y, x);
          c += kTrust * (0.5f * std::log(CosineAt(smooth, known, g, x, y)) - c);
          log_distance.at<float>(y, x) = start.at<float>(y, x) + c;
        }
    });
  }
  if (scale >= 1) return from_light + correction;
  cv::Mat large;
  cv::resize(WeightedBlur(correction, known, 0.8), large, from_light.size(), 0, 0,
             cv::INTER_LINEAR);
  return from_light + large;
}

}  // namespace

std::vector<float> DistanceFromLight(const ColourImage& picture, const GreyPlane& plane,
                                     const std::vector<std::uint8_t>& highlight,
                                     const DepthOptions& options, const Progress& progress) {
  cv::Mat weight(plane.height, plane.width, CV_32F);
  for (std::size_t i = 0; i < plane.imaged.size(); ++i)
    weight.ptr<float>()[i] = plane.imaged[i] ? 1.0f : 0.0f;
  progress.Step("light", 0.35);
  const std::vector<float> linear = Decoding(options.gamma);
  const cv::Mat red = LinearChannel(picture, plane, highlight, 0, linear);
  cv::Mat light = red;
  if (options.correct_tissue)
    light = WithoutTissue(red, LinearChannel(picture, plane, highlight, 1, linear), weight);
  progress.Step("smoothing", 0.5);
  if (options.vignette > 0) cv::divide(light, VignetteOf(light.size(), options), light);
  light = GuidedSmoothing(light, weight, 2 * options.median_radius, kEdge, NoiseOf(light, weight));
  cv::Mat log_light;
  cv::log(cv::max(light, kDarkest), log_light);
  cv::Mat log_distance = log_light * -0.5;
  if (options.estimator == DepthEstimator::kShading)
    log_distance = Shaded(log_distance, weight, options, progress);
  progress.Step("normalise", 0.9);

  std::vector<float> distance(plane.imaged.size(), std::numeric_limits<float>::quiet_NaN()), known;
  for (std::size_t i = 0; i < distance.size(); ++i)
    if (plane.imaged[i]) known.push_back(distance[i] = std::exp(log_distance.ptr<float>()[i]));
  if (known.empty()) return distance;
  const auto middle = known.begin() + static_cast<std::ptrdiff_t>(known.size() / 2);
  std::nth_element(known.begin(), middle, known.end());
  for (float& d : distance) d /= *middle;
  return distance;
}

}  // namespace arthro::authoring
