#include "authoring/panorama/preparation/clip_look.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <opencv2/imgproc.hpp>

#include "authoring/panorama/preparation/frame_masks.h"
#include "simulation/core/error.h"

namespace arthro::authoring {
namespace {

constexpr int kThinAfter = 32;      // frames used at each stride before it doubles
constexpr int kFewest = 6;          // frames needed to distinguish a mark from tissue
constexpr double kMarkReach = 10;   // px at half scale: smaller structure is detail
constexpr double kLightReach = 16;  // px at half scale: larger structure is light
// Factor by which a mark exceeds the chance mean of moving tissue.
constexpr double kBeyondChance = 4;
// Bound on a mark's change, in units of its strength, while the tissue behind it moves.
constexpr double kSteady = 1.0;
constexpr double kMostDetail = 3;  // standard deviations of its frame; a highlight exceeds it
// Share of power that the mean of moving tissue keeps at most; it averages away.
constexpr double kMoves = 0.4;
// Bright text is overexposed in most frames; so is a highlight that the lamp keeps in one place.
constexpr double kGlaresIn = 0.5;  // share of the frames
// Share of the largest contrast of the marks at which a stroke ends.
constexpr double kEdgeOfStroke = 0.5;
constexpr double kLargestMarks = 0.2;  // share of the window; a larger area is not marks

// Returns the strokes of `marks`: pixels whose contrast to the surroundings of the marks, in the
// mean of the frames, is at least kEdgeOfStroke of the largest.
cv::Mat CoresOf(const cv::Mat& marks, const cv::Mat& mean_log, const cv::Mat& window) {
  cv::Mat around;
  cv::bitwise_not(marks, around);
  cv::bitwise_and(around, window, around);
  const cv::Mat contrast = cv::abs(mean_log - MaskedSurround(around, kLightReach).Of(mean_log));
  double largest = 0;
  cv::minMaxLoc(contrast, nullptr, &largest, nullptr, nullptr, marks);
  cv::Mat cores;
  cv::bitwise_and(contrast >= kEdgeOfStroke * largest, marks, cores);
  return cores;
}

double MedianOf(std::vector<float>& values) {
  const auto middle = values.begin() + values.size() / 2;
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// Robust standard deviation of values with mean 0, from a sixteenth of the pixels.
double SpreadOf(const cv::Mat& detail, const cv::Mat& mask) {
  std::vector<float> sizes;
  for (int y = 0; y < detail.rows; y += 4)
    for (int x = 0; x < detail.cols; x += 4)
      if (mask.at<std::uint8_t>(y, x)) sizes.push_back(std::abs(detail.at<float>(y, x)));
  return sizes.empty() ? 0 : MedianOf(sizes) / 0.6745;
}

}  // namespace

void ClipLookBuilder::Add(const cv::Mat& working_rgb, const cv::Mat& mask) {
  if (working_rgb.type() != CV_8UC3 || mask.type() != CV_8UC1 ||
      mask.size() != working_rgb.size() || (used_ > 0 && seen_.size() != mask.size()))
    throw Error(Code::kBadImage,
                "the frames of a clip must all have one size, and their mask as well; this frame "
                "has another one, so leave it out");
  if (offered_++ % stride_ != 0) return;
  if (used_ == 0) {
    window_ = cv::Mat::zeros(mask.size(), CV_8U);
    for (cv::Mat* sum : {&seen_, &logs_, &light_, &detail_, &detail_squared_})
      *sum = cv::Mat::zeros(mask.size(), CV_32F);
  }
  window_ |= mask;
  if (++used_ % kThinAfter == 0) stride_ *= 2;

  cv::Mat usable;
  cv::bitwise_not(HighlightMask(working_rgb, mask), usable);
  cv::bitwise_and(usable, mask, usable);
  usable.setTo(0, ToolMask(working_rgb, mask));
  const cv::Mat mixed = MixColours(working_rgb, mix_);
  noise_.Add(mixed, usable);
  const cv::Mat log = LogOf(mixed);

  cv::add(logs_, log, logs_, mask);
  const cv::Mat light = MaskedSurround(usable, kLightReach).Of(log);
  const double exposure = cv::mean(light, usable)[0];
  // Excludes the rim's blur into the black around it.
  cv::erode(usable, usable, cv::Mat(), {-1, -1}, 2, cv::BORDER_CONSTANT, 0);
  cv::Mat detail = log - MaskedSurround(usable, kMarkReach).Of(log);
  cv::GaussianBlur(detail, detail, {3, 3}, 0.8);
  const double most = kMostDetail * SpreadOf(detail, usable);
  detail = cv::min(cv::max(detail, -most), most);
  cv::add(light_, light - exposure, light_, usable);
  cv::add(seen_, 1.0, seen_, usable);
  cv::add(detail_, detail, detail_, usable);
  cv::add(detail_squared_, detail.mul(detail), detail_squared_, usable);
}

ClipLook ClipLookBuilder::Finish() {
  ClipLook look;
  look.frames = used_;
  if (used_ == 0) return look;
  // Pixels that no frame showed as tissue take the light of their surroundings.
  cv::Mat light = light_ / cv::max(seen_, 1.0);
  look.light = MaskedSurround(seen_ > 0, kLightReach / 2).Of(light);
  look.noise = noise_;
  look.noise.Finish();
  if (used_ >= kFewest) FindStaticMarks(look);
  return look;
}

void ClipLookBuilder::FindStaticMarks(ClipLook& look) const {
  // Deviation of the mean detail by chance, and strength of the detail of one frame. Medians, so
  // that the marks themselves do not count.
  std::vector<float> strays, powers;
  for (int y = 0; y < seen_.rows; ++y)
    for (int x = 0; x < seen_.cols; ++x) {
      const float n = seen_.at<float>(y, x);
      if (n < kFewest) continue;
      strays.push_back(std::abs(detail_.at<float>(y, x) / n));
      powers.push_back(detail_squared_.at<float>(y, x) / n);
    }
  if (strays.empty()) return;
  const double chance = MedianOf(strays) / 0.6745, power = MedianOf(powers);
  if (chance * chance > kMoves * power)
    return;  // the clip is still: its tissue does not average away

  // Each frame excludes the rim, so it is never seen and holds no marks.
  cv::Mat inner;
  cv::erode(window_, inner, cv::getStructuringElement(cv::MORPH_RECT, {7, 7}), {-1, -1}, 1,
            cv::BORDER_CONSTANT, 0);
  const auto near_rim = [&](int x, int y) { return inner.at<std::uint8_t>(y, x) == 0; };
  cv::Mat marks = cv::Mat::zeros(seen_.size(), CV_8U);
  int count = 0;
  for (int y = 0; y < seen_.rows; ++y)
    for (int x = 0; x < seen_.cols; ++x) {
      const float n = seen_.at<float>(y, x);
      if (window_.at<std::uint8_t>(y, x) && n < (1 - kGlaresIn) * used_ && !near_rim(x, y)) {
        marks.at<std::uint8_t>(y, x) = 255;
        ++count;
      }
      if (n < kFewest) continue;
      const double mean = detail_.at<float>(y, x) / n;
      const double variance = std::max(0.0, detail_squared_.at<float>(y, x) / n - mean * mean);
      if (std::abs(mean) < kBeyondChance * chance || std::abs(mean) < kSteady * std::sqrt(variance))
        continue;
      marks.at<std::uint8_t>(y, x) = 255;
      ++count;
    }
  if (count == 0 || count > kLargestMarks * static_cast<double>(strays.size())) return;
  cv::dilate(marks, marks, cv::getStructuringElement(cv::MORPH_ELLIPSE, {7, 7}));
  look.static_marks = marks;
  look.static_cores = CoresOf(marks, logs_ / used_, window_);
}

}  // namespace arthro::authoring
