#include "authoring/panorama/preparation/prepare.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <opencv2/imgproc.hpp>

#include "simulation/core/error.h"

namespace arthro::authoring {
namespace {

// White noise after a Gaussian of this sigma, as a share of its standard deviation.
double NoiseLeft(double sigma) {
  if (sigma < 0.3) return 1;
  // Sum of squared taps, separable; the closed form 1/(2 sigma sqrt(pi)) is inaccurate below 0.6
  // px.
  double sum = 0, squares = 0;
  for (int i = -8; i <= 8; ++i) {
    const double tap = std::exp(-0.5 * i * i / (sigma * sigma));
    sum += tap;
    squares += tap * tap;
  }
  return squares / (sum * sum);
}

void Check(const cv::Mat& rgb, double scale, const cv::Mat& mask, const ClipLook& look) {
  if (rgb.empty() || rgb.type() != CV_8UC3 || mask.type() != CV_8UC1 || mask.size() != rgb.size())
    throw Error(Code::kBadImage,
                "a frame is prepared from an 8-bit colour picture and an 8-bit mask of its size; "
                "give both at the same scale");
  if (!(scale > 0 && scale <= 4))
    throw Error(Code::kBadArgument, "the working scale must lie between 0 and 4; 0.5 is usual");
  if ((!look.light.empty() && look.light.size() != rgb.size()) ||
      (!look.static_marks.empty() && look.static_marks.size() != rgb.size()))
    throw Error(Code::kBadImage,
                "the clip's common light was learned at another size; learn it at this scale");
}

cv::Mat Eroded(const cv::Mat& mask, int radius) {
  if (radius <= 0) return mask.clone();
  // The picture's edge counts as a rim.
  constexpr int kSmall = 6;  // px; up to it a kernel of the same distances costs less
  if (radius <= kSmall) {
    constexpr double kStraight = 0.955, kDiagonal = 1.3693;  // weights of the 3 x 3 distances
    cv::Mat kernel = cv::Mat::zeros(2 * radius + 3, 2 * radius + 3, CV_8U), inner;
    for (int y = 0; y < kernel.rows; ++y)
      for (int x = 0; x < kernel.cols; ++x) {
        const auto [least, most] =
            std::minmax({std::abs(x - radius - 1), std::abs(y - radius - 1)});
        kernel.at<std::uint8_t>(y, x) = kDiagonal * least + kStraight * (most - least) <= radius;
      }
    cv::erode(mask, inner, kernel, {-1, -1}, 1, cv::BORDER_CONSTANT, 0);
    return inner;
  }
  cv::Mat padded, distance;
  cv::copyMakeBorder(mask, padded, 1, 1, 1, 1, cv::BORDER_CONSTANT, 0);
  cv::distanceTransform(padded, distance, cv::DIST_L2, 3, CV_32F);
  cv::Mat inner = distance > radius;
  return inner(cv::Rect(1, 1, mask.cols, mask.rows)).clone();
}

cv::Mat TissueMask(const cv::Mat& rgb, const cv::Mat& lens_mask, const ClipLook& look,
                   const PrepareOptions& options) {
  const double radius = std::sqrt(cv::countNonZero(lens_mask) / CV_PI);
  cv::Mat mask =
      Eroded(lens_mask, static_cast<int>(std::lround(std::max(2.0, options.rim_margin * radius))));
  if (options.mask_highlights) mask.setTo(0, HighlightMask(rgb, lens_mask));
  if (options.mask_tool) mask.setTo(0, ToolMask(rgb, lens_mask));
  if (options.mask_static && !look.static_marks.empty()) mask.setTo(0, look.static_marks);
  return mask;
}

// Gaussian over the window's pixels only, since the black outside would darken the rim.
void SmoothInside(cv::Mat& grey, const cv::Mat& window, double sigma) {
  cv::Mat weight, spread;
  window.convertTo(weight, CV_32F, 1.0 / 255);
  cv::GaussianBlur(weight, spread, {0, 0}, sigma);
  cv::GaussianBlur(grey.mul(weight), grey, {0, 0}, sigma);
  grey /= cv::max(spread, 0.01);
}

// Fades the values behind the mask from its border's grey to 0, so that the mask's outline makes no
// features.
void FadeBehindMask(cv::Mat& detail, const cv::Mat& mask) {
  cv::Mat weight, spread, sum;
  mask.convertTo(weight, CV_32F, 1.0 / 255);
  detail = detail.mul(weight);
  cv::blur(detail, sum, {9, 9});
  cv::blur(weight, spread, {9, 9});
  for (int y = 0; y < detail.rows; ++y) {
    float* d = detail.ptr<float>(y);
    const float *w = spread.ptr<float>(y), *s = sum.ptr<float>(y);
    const std::uint8_t* m = mask.ptr<std::uint8_t>(y);
    for (int x = 0; x < detail.cols; ++x)
      if (!m[x]) d[x] = s[x] / (w[x] + 0.2f);
  }
}

}  // namespace

WorkingFrame Prepare(int index, const cv::Mat& working_rgb, double scale, const cv::Mat& lens_mask,
                     const ClipLook& look, const PrepareOptions& options) {
  Check(working_rgb, scale, lens_mask, look);
  WorkingFrame frame;
  frame.index = index;
  frame.scale = scale;
  frame.mask = TissueMask(working_rgb, lens_mask, look, options);
  cv::Mat mixed = MixColours(working_rgb, ColourMix{});
  NoiseCurve noise = look.noise;
  if (noise.IsEmpty()) {
    noise.Add(mixed, frame.mask);
    noise.Finish();
  }
  const double at_half_scale = scale / 0.5;

  if (!options.even_light) {
    mixed.convertTo(frame.grey, CV_8U);
    const double mean = cv::mean(mixed, frame.mask)[0];
    mixed.convertTo(frame.grey, CV_8U, 1, 128 - mean);
    frame.noise = noise.At(mean);
    cv::Scalar average, deviation;
    cv::meanStdDev(frame.grey, average, deviation, frame.mask);
    frame.texture =
        std::sqrt(std::max(0.0, deviation[0] * deviation[0] - frame.noise * frame.noise));
    return frame;
  }

  // Smooths more when the clip is noisier for its brightness. Then takes the logarithm and removes
  // the clip's light and the frame's own smooth part.
  const double brightness = std::max(1.0, cv::mean(mixed, frame.mask)[0]);
  const double noisiness = noise.At(brightness) / brightness;
  constexpr double kQuiet = 0.005, kNoisy = 0.03;  // noise over brightness
  const double share = std::clamp((noisiness - kQuiet) / (kNoisy - kQuiet), 0.0, 1.0);
  const double sigma =
      options.smoothing + share * std::max(0.0, options.most_smoothing - options.smoothing);
  if (sigma > 0.2) SmoothInside(mixed, lens_mask, sigma);
  cv::Mat log = LogOf(mixed);
  if (!look.light.empty()) log -= look.light;
  RemoveQuadratic(log, frame.mask);
  // Runs twice: the residue of light with strong curvature is itself smooth.
  const MaskedSurround surround(frame.mask, options.surround * at_half_scale);
  cv::Mat& detail = log;
  detail -= surround.Of(log);
  detail -= surround.Of(detail);

  // Local gain: raises texture to the requested contrast, limited by the noise.
  const cv::Mat power =
      MaskedSurround(frame.mask, options.contrast_reach * at_half_scale).Of(detail.mul(detail));
  // A plane may fall below the value of every pixel. Weak texture is raised at most threefold over
  // the frame's mean.
  const float least_power = std::max(1e-8f, static_cast<float>(cv::mean(power, frame.mask)[0] / 9));
  const double left = NoiseLeft(sigma);
  std::array<float, 256> noise_of_log{};
  for (int g = 0; g < 256; ++g)
    noise_of_log[g] = static_cast<float>(left * noise.At(g) / std::max(1, g));
  double noise_power = 0, noise_pixels = 0;
  for (int y = 0; y < detail.rows; ++y) {
    float* d = detail.ptr<float>(y);
    const float *p = power.ptr<float>(y), *grey = mixed.ptr<float>(y);
    const std::uint8_t* m = frame.mask.ptr<std::uint8_t>(y);
    for (int x = 0; x < detail.cols; ++x) {
      if (!m[x]) continue;
      const float n = noise_of_log[static_cast<int>(std::clamp(grey[x], 0.0f, 255.0f))];
      const float deviation = std::sqrt(std::max(p[x], least_power));
      const float gain = std::min(static_cast<float>(options.contrast) / deviation,
                                  static_cast<float>(options.most_noise) / std::max(n, 1e-5f));
      d[x] *= gain;
      noise_power += gain * n * gain * n;
      ++noise_pixels;
    }
  }
  FadeBehindMask(detail, frame.mask);
  cv::Scalar average, deviation;
  cv::meanStdDev(detail, average, deviation, frame.mask);
  detail.convertTo(frame.grey, CV_8U, 1, 128 - average[0]);
  frame.noise = std::sqrt(noise_power / std::max(1.0, noise_pixels));
  frame.texture = std::sqrt(std::max(0.0, deviation[0] * deviation[0] - frame.noise * frame.noise));
  return frame;
}

}  // namespace arthro::authoring
