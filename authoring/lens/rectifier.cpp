#include "authoring/lens/rectifier.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <opencv2/imgproc.hpp>

#include "simulation/core/error.h"
#include "simulation/core/option_fields.h"

namespace arthro::authoring {
namespace {

constexpr double kMostPixels = 100e6;  // pixels of a rectified picture
constexpr int kNowhere = -10;          // map entry that cv::remap fills with black

// Raw pixels that may be shown, apart from the limit on the angle.
class Window {
 public:
  Window(const Lens& lens, const RectifyOptions& options)
      : lens_(lens), radius_(lens.circle.r * (1 - options.rim_margin)) {}

  // Bilinear sampling reads the neighbours, so half a pixel at the border is excluded.
  bool Holds(const glm::dvec2& raw) const {
    if (!(raw.x >= 0 && raw.y >= 0 && raw.x <= lens_.width - 1 && raw.y <= lens_.height - 1))
      return false;
    return !(lens_.circle.r > 0) ||
           std::hypot(raw.x - lens_.circle.cx, raw.y - lens_.circle.cy) <= radius_;
  }

 private:
  const Lens& lens_;
  double radius_;
};

// Extent of the window from the axis in one direction of the raw picture, as tan θ.
double Reach(const Lens& lens, const Window& window, const RectifyOptions& options,
             const glm::dvec2& direction) {
  double inside = 0, outside = std::hypot(lens.width, lens.height);
  for (int i = 0; i < 50; ++i) {
    const double middle = 0.5 * (inside + outside);
    const auto theta = AngleFromRadius(lens, middle);
    const glm::dvec2 raw(lens.cx + middle * direction.x,
                         lens.cy + middle * direction.y / lens.aspect);
    (theta && *theta <= options.largest_half_angle && window.Holds(raw) ? inside : outside) =
        middle;
  }
  return std::tan(AngleFromRadius(lens, inside).value_or(0));
}

// Profile of the lens as raw px per rectified px at unit focal length, tabulated by tan²θ. The maps
// read it for every pixel, and Newton's method there would take a second for a large picture.
class RadialTable {
 public:
  RadialTable(const Lens& lens, double largest_tangent)
      : step_(largest_tangent * largest_tangent / (kEntries - 2)) {
    for (int i = 0; i < kEntries; ++i) {
      const double tangent = std::sqrt(i * step_);
      const auto r = RadiusFromAngle(lens, std::atan(tangent));
      scale_[i] = i == 0 ? FocalAtAxis(lens) : r ? *r / tangent : kNoPixel;
    }
  }

  // Catmull-Rom interpolation: the scale is smooth in tan²θ, so that 4096 entries leave an error
  // below 1e-6 px.
  double At(double squared_tangent) const {
    const double at = squared_tangent / step_;
    const int i = std::clamp(static_cast<int>(at), 1, kEntries - 3);
    const double t = at - i, a = scale_[i - 1], b = scale_[i], c = scale_[i + 1], d = scale_[i + 2];
    return b + 0.5 * t * (c - a + t * (2 * a - 5 * b + 4 * c - d + t * (3 * (b - c) + d - a)));
  }

 private:
  static constexpr int kEntries = 4096;
  static constexpr double kNoPixel = std::numeric_limits<double>::quiet_NaN();
  double step_;
  std::array<double, kEntries> scale_{};
};

}  // namespace

RectifiedView ViewOf(const Lens& lens, const RectifyOptions& options) {
  CheckOptions(options);
  const Window window(lens, options);
  if (lens.width < 1 || lens.height < 1 || !(lens.focal_px > 0) ||
      !window.Holds({lens.cx, lens.cy}) || !AngleFromRadius(lens, 0))
    throw Error(
        Code::kBadArgument,
        fmt::format("the lens's axis meets its {} x {} picture at ({:.0f}, {:.0f}), outside "
                    "of what it shows; calibrate it again",
                    lens.width, lens.height, lens.cx, lens.cy));
  // The visible area is star-shaped about the axis, so its bounding box follows from its extent in
  // all directions.
  constexpr int kDirections = 1440;
  glm::dvec2 low(0), high(0);
  for (int i = 0; i < kDirections; ++i) {
    const double angle = 2 * std::numbers::pi * i / kDirections;
    const glm::dvec2 direction(std::cos(angle), std::sin(angle));
    const glm::dvec2 end = Reach(lens, window, options, direction) * direction;
    low = glm::min(low, end);
    high = glm::max(high, end);
  }
  RectifiedView view;
  view.focal_px = FocalAtAxis(lens);
  const auto Whole = [&](double tangent) { return std::ceil(tangent * view.focal_px) + 1; };
  view.cx = Whole(-low.x);
  view.cy = Whole(-low.y);
  const double width = view.cx + Whole(high.x) + 1, height = view.cy + Whole(high.y) + 1;
  if (!(width * height <= kMostPixels))
    throw Error(Code::kBadArgument,
                fmt::format("rectified, this lens would need {:.0f} x {:.0f} px; lower the largest "
                            "half angle or check the lens file",
                            width, height));
  view.width = static_cast<int>(width);
  view.height = static_cast<int>(height);
  if (view.width < 8 || view.height < 8)
    throw Error(Code::kBadArgument,
                "this lens shows almost nothing; check the circle in the lens file");
  return view;
}

Rectifier::Rectifier(const Lens& lens, const RectifyOptions& options, double scale)
    : view_(ViewOf(lens, options)),
      raw_width_(lens.width),
      raw_height_(lens.height),
      scale_(scale) {
  if (!(scale >= 1.0 / 64 && scale <= 4))
    throw Error(
        Code::kBadArgument,
        fmt::format("a rectified picture at scale {} cannot be made; take 1/64 to 4", scale));
  samples_ = static_cast<int>(std::ceil(1 / scale - 1e-9));
  const int width = std::max(1, static_cast<int>(std::ceil(view_.width * scale - 1e-9)));
  const int height = std::max(1, static_cast<int>(std::ceil(view_.height * scale - 1e-9)));
  const Window window(lens, options);
  const double largest = std::tan(options.largest_half_angle);
  const RadialTable table(lens, 1.01 * largest);

  // Computes exact maps of the samples, then the fixed-point maps that cv::remap uses (1/32 px).
  mask_ = cv::Mat(height, width, CV_8UC1, cv::Scalar(255));
  cv::Mat map(height * samples_, width * samples_, CV_32FC2);
  for (int y = 0; y < map.rows; ++y) {
    cv::Vec2f* row = map.ptr<cv::Vec2f>(y);
    uchar* mask = mask_.ptr<uchar>(y / samples_);
    // Position x_work = (x + 0.5) s - 0.5; a sample is such a pixel at the scale s·samples.
    const double sample = scale_ * samples_;
    const double ry = ((y + 0.5) / sample - 0.5 - view_.cy) / view_.focal_px;
    for (int x = 0; x < map.cols; ++x) {
      const double rx = ((x + 0.5) / sample - 0.5 - view_.cx) / view_.focal_px;
      const double squared = rx * rx + ry * ry;
      if (squared <= largest * largest) {
        const double r = table.At(squared);
        const glm::dvec2 raw(lens.cx + r * rx, lens.cy + r * ry / lens.aspect);
        row[x] = cv::Vec2f(static_cast<float>(raw.x), static_cast<float>(raw.y));
        if (window.Holds(raw)) continue;
      }
      mask[x / samples_] = 0;
    }
  }
  for (int y = 0; y < map.rows; ++y)
    for (int x = 0; x < map.cols; ++x)
      if (!mask_.at<uchar>(y / samples_, x / samples_))
        map.at<cv::Vec2f>(y, x) = cv::Vec2f(kNowhere, kNowhere);
  cv::convertMaps(map, cv::noArray(), map_xy_, map_fraction_, CV_16SC2);
}

void Rectifier::Exclude(const std::vector<cv::Rect>& raw) {
  // Bilinear sampling reads the next pixel too.
  std::vector<cv::Rect> read;
  for (const cv::Rect& box : raw)
    if (box.area() > 0) read.emplace_back(box.x - 1, box.y - 1, box.width + 1, box.height + 1);
  if (read.empty()) return;
  const auto is_excluded = [&](const cv::Vec2s& pixel) {
    return std::any_of(read.begin(), read.end(), [&](const cv::Rect& box) {
      return box.contains(cv::Point(pixel[0], pixel[1]));
    });
  };
  for (int y = 0; y < map_xy_.rows; ++y)
    for (int x = 0; x < map_xy_.cols; ++x)
      if (is_excluded(map_xy_.at<cv::Vec2s>(y, x))) mask_.at<uchar>(y / samples_, x / samples_) = 0;
  for (int y = 0; y < map_xy_.rows; ++y)
    for (int x = 0; x < map_xy_.cols; ++x)
      if (!mask_.at<uchar>(y / samples_, x / samples_))
        map_xy_.at<cv::Vec2s>(y, x) = cv::Vec2s(kNowhere, kNowhere);
}

void Rectifier::Rectify(const cv::Mat& raw, cv::Mat& rectified) const {
  if (raw.cols != raw_width_ || raw.rows != raw_height_)
    throw Error(
        Code::kBadImage,
        fmt::format("the picture is {} x {} px but the lens was calibrated for {} x {}; use "
                    "the lens of this camera at this size",
                    raw.cols, raw.rows, raw_width_, raw_height_));
  if (raw.depth() != CV_8U || (raw.channels() != 1 && raw.channels() != 3))
    throw Error(Code::kBadImage, "only 8-bit pictures with one or three channels are rectified");
  if (samples_ == 1) {
    cv::remap(raw, rectified, map_xy_, map_fraction_, cv::INTER_LINEAR, cv::BORDER_CONSTANT);
    return;
  }
  // Processes strips that stay in the cache between the two steps.
  const int strip = std::max(1, 64 / samples_);
  rectified.create(mask_.size(), raw.type());
  cv::Mat samples;
  for (int y = 0; y < mask_.rows; y += strip) {
    const int rows = std::min(strip, mask_.rows - y);
    const cv::Range fine(y * samples_, (y + rows) * samples_);
    cv::remap(raw, samples, map_xy_.rowRange(fine), map_fraction_.rowRange(fine), cv::INTER_LINEAR,
              cv::BORDER_CONSTANT);
    cv::Mat part = rectified.rowRange(y, y + rows);
    cv::resize(samples, part, part.size(), 0, 0, cv::INTER_AREA);
  }
}

}  // namespace arthro::authoring
