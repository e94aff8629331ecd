#include "authoring/lens/target/target_points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include <opencv2/imgproc.hpp>

namespace arthro::authoring {
namespace {

constexpr std::size_t kMostCandidates = 6000;
constexpr float kWeakest = 0.1f;  // contrast of a dim rim, as a share of the strong ones

const cv::Point2d kNothing(std::numeric_limits<double>::quiet_NaN(),
                           std::numeric_limits<double>::quiet_NaN());

float At(const cv::Mat& picture, double x, double y) {
  const int ix = std::clamp(static_cast<int>(x), 0, picture.cols - 2);
  const int iy = std::clamp(static_cast<int>(y), 0, picture.rows - 2);
  const float fx = static_cast<float>(x - ix), fy = static_cast<float>(y - iy);
  const float* a = picture.ptr<float>(iy) + ix;
  const float* b = picture.ptr<float>(iy + 1) + ix;
  return (1 - fy) * ((1 - fx) * a[0] + fx * a[1]) + fy * ((1 - fx) * b[0] + fx * b[1]);
}

// Checks that a ring round the point is dark, bright, dark, bright: its second harmonic exceeds the
// first, third and fourth. An edge, a corner or a crossing of lines has no such ring.
bool IsCheckered(const cv::Mat& smooth, const cv::Point2d& at, double radius) {
  constexpr int kSamples = 24;
  std::array<double, 5> re{}, im{};
  for (int n = 0; n < kSamples; ++n) {
    const double phi = 2 * std::numbers::pi * n / kSamples;
    const double x = at.x + radius * std::cos(phi), y = at.y + radius * std::sin(phi);
    if (x < 0 || y < 0 || x > smooth.cols - 1 || y > smooth.rows - 1) return false;
    const double value = At(smooth, x, y);
    for (int h = 1; h < 5; ++h) {
      re[h] += value * std::cos(h * phi);
      im[h] += value * std::sin(h * phi);
    }
  }
  const auto Power = [&](int h) { return re[h] * re[h] + im[h] * im[h]; };
  return Power(2) > 2.0 * (Power(1) + Power(3) + Power(4));
}

}  // namespace

const char* ToString(TargetKind kind) {
  switch (kind) {
    case TargetKind::kLines:
      return "line grid";
    case TargetKind::kChessboard:
      return "chessboard";
    case TargetKind::kDots:
      return "dot grid";
    case TargetKind::kNone:
      break;
  }
  return "none";
}

std::vector<cv::Point2d> CandidatePoints(const cv::Mat& picture, TargetKind kind, double sigma) {
  cv::Mat smooth, xx, yy, xy;
  cv::GaussianBlur(picture, smooth, {}, sigma, sigma, cv::BORDER_REPLICATE);
  cv::Sobel(smooth, xx, CV_32F, 2, 0, 3);
  cv::Sobel(smooth, yy, CV_32F, 0, 2, 3);
  cv::Sobel(smooth, xy, CV_32F, 1, 1, 3);
  cv::Mat strength(picture.size(), CV_32FC1, cv::Scalar(0));
  const bool wants_saddle = kind == TargetKind::kChessboard;
  for (int y = 0; y < picture.rows; ++y) {
    const float *a = xx.ptr<float>(y), *b = yy.ptr<float>(y), *c = xy.ptr<float>(y);
    float* s = strength.ptr<float>(y);
    for (int x = 0; x < picture.cols; ++x) {
      const float det = a[x] * b[x] - c[x] * c[x];
      s[x] = wants_saddle ? std::max(0.f, -det) : a[x] > 0 && b[x] > 0 ? std::max(0.f, det) : 0.f;
    }
  }
  cv::Mat highest;
  const int apart = 2 * std::max(1, static_cast<int>(std::lround(sigma))) + 1;
  cv::dilate(strength, highest, cv::Mat::ones(apart, apart, CV_8U));
  struct Found {
    float strength;
    cv::Point2d at;
  };
  std::vector<Found> found;
  const int border = 3;
  for (int y = border; y < picture.rows - border; ++y)
    for (int x = border; x < picture.cols - border; ++x)
      if (const float s = strength.at<float>(y, x); s > 0 && s == highest.at<float>(y, x))
        found.push_back({s, cv::Point2d(x, y)});
  std::stable_sort(found.begin(), found.end(),
                   [](const Found& a, const Found& b) { return a.strength > b.strength; });
  // Compares with a percentile, since the strongest response may be a highlight or the rim.
  const float strong =
      found.empty() ? 0 : found[std::min<std::size_t>(30, found.size() / 4)].strength;
  std::vector<cv::Point2d> points;
  for (const Found& one : found) {
    if (one.strength < kWeakest * kWeakest * strong || points.size() == kMostCandidates) break;
    if (wants_saddle && !IsCheckered(smooth, one.at, 1.0 + 2.0 * sigma)) continue;
    points.push_back(one.at);
  }
  return points;
}

PointRefiner::PointRefiner(const cv::Mat& picture, TargetKind kind) : kind_(kind) {
  if (kind == TargetKind::kDots) {
    picture_ = picture;
    return;
  }
  cv::Mat smooth;
  cv::GaussianBlur(picture, smooth, {}, 0.8, 0.8, cv::BORDER_REPLICATE);
  cv::Scharr(smooth, gradient_x_, CV_32F, 1, 0);
  cv::Scharr(smooth, gradient_y_, CV_32F, 0, 1);
}

cv::Point2d PointRefiner::Refine(const cv::Point2d& start, double reach) const {
  return kind_ == TargetKind::kDots ? CentreOfDarkness(start, reach) : MeetingOfEdges(start, reach);
}

cv::Point2d PointRefiner::MeetingOfEdges(cv::Point2d at, double reach) const {
  const cv::Mat &gx = gradient_x_, &gy = gradient_y_;
  const cv::Point2d start = at;
  for (int round = 0; round < 12; ++round) {
    const int left = static_cast<int>(std::ceil(at.x - reach)),
              right = static_cast<int>(std::floor(at.x + reach));
    const int top = static_cast<int>(std::ceil(at.y - reach)),
              bottom = static_cast<int>(std::floor(at.y + reach));
    if (left < 1 || top < 1 || right > gx.cols - 2 || bottom > gx.rows - 2) return kNothing;
    double a = 0, b = 0, c = 0, u = 0, v = 0;
    for (int y = top; y <= bottom; ++y) {
      const float *px = gx.ptr<float>(y), *py = gy.ptr<float>(y);
      for (int x = left; x <= right; ++x) {
        const double dx = x - at.x, dy = y - at.y, far = (dx * dx + dy * dy) / (reach * reach);
        if (far >= 1) continue;
        const double weight = (1 - far) * (1 - far);
        const double xx = weight * px[x] * px[x], xy = weight * px[x] * py[x],
                     yy = weight * py[x] * py[x];
        a += xx;
        b += xy;
        c += yy;
        u += xx * dx + xy * dy;
        v += xy * dx + yy * dy;
      }
    }
    const double det = a * c - b * b;
    // Edges in one direction alone do not fix a point.
    if (!(det > 0.01 * (a + c) * (a + c))) return kNothing;
    const cv::Point2d step((c * u - b * v) / det, (a * v - b * u) / det);
    at += step;
    if (!(cv::norm(at - start) <= reach)) return kNothing;
    if (cv::norm(step) < 1e-4) break;
  }
  return at;
}

cv::Point2d PointRefiner::CentreOfDarkness(cv::Point2d at, double reach) const {
  const cv::Point2d start = at;
  for (int round = 0; round < 8; ++round) {
    // Background: a plane through the ring at the window's edge, since the light varies across a
    // dot.
    constexpr int kRing = 16;
    double ground = 0, slope_x = 0, slope_y = 0;
    if (at.x < reach + 1 || at.y < reach + 1 || at.x > picture_.cols - 2 - reach ||
        at.y > picture_.rows - 2 - reach)
      return kNothing;
    for (int n = 0; n < kRing; ++n) {
      const double phi = 2 * std::numbers::pi * n / kRing;
      const double value = At(picture_, at.x + reach * std::cos(phi), at.y + reach * std::sin(phi));
      ground += value / kRing;
      slope_x += 2 * value * std::cos(phi) / (kRing * reach);
      slope_y += 2 * value * std::sin(phi) / (kRing * reach);
    }
    double weight = 0, u = 0, v = 0;
    for (int y = static_cast<int>(std::ceil(at.y - reach)); y <= at.y + reach; ++y)
      for (int x = static_cast<int>(std::ceil(at.x - reach)); x <= at.x + reach; ++x) {
        const double dx = x - at.x, dy = y - at.y;
        if (dx * dx + dy * dy > reach * reach) continue;
        const double dark =
            ground + slope_x * dx + slope_y * dy - picture_.at<float>(y, x) - 0.1 * ground;
        if (dark <= 0) continue;
        weight += dark;
        u += dark * dx;
        v += dark * dy;
      }
    if (!(weight > 0.05)) return kNothing;
    const cv::Point2d step(u / weight, v / weight);
    at += step;
    if (!(cv::norm(at - start) <= reach)) return kNothing;
    if (cv::norm(step) < 1e-3) break;
  }
  return at;
}

}  // namespace arthro::authoring
