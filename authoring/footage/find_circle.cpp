#include "authoring/footage/find_circle.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <random>
#include <vector>

#include <opencv2/imgproc.hpp>

namespace arthro::authoring {
namespace {

constexpr int kRays = 720;
constexpr int kLeastSide = 16;     // px; a smaller picture has no usable rim
constexpr double kLeastRise = 20;  // grey levels between the surround and the window
constexpr int kTrials =
    600;  // samples of 3 points; P(all on the rim) = 1 - 1e-4 when 25 % of the points are

// Result of one ray cast outwards from a point inside the window.
struct RimRay {
  cv::Point2d direction;
  double reach = 0;  // px, distance to the picture's edge
  bool has_edge = false;
  double distance = 0;  // px, distance of the edge from the origin of the ray
  cv::Point2d point;
};

struct Levels {
  double dark = 0, bright = 0;
};

Levels LevelsOf(const cv::Mat& grey) {
  std::array<int, 256> counts{};
  for (int y = 0; y < grey.rows; ++y) {
    const std::uint8_t* row = grey.ptr<std::uint8_t>(y);
    for (int x = 0; x < grey.cols; ++x) ++counts[row[x]];
  }
  const auto percentile = [&](double share, int from) {
    double total = 0, sum = 0;
    for (int i = from; i < 256; ++i) total += counts[static_cast<std::size_t>(i)];
    for (int i = from; i < 256; ++i)
      if ((sum += counts[static_cast<std::size_t>(i)]) >= share * total) return i;
    return 255;
  };
  // Low and high percentiles: the dark area may be the corners alone, the bright area a small
  // window.
  const int dark = percentile(0.005, 0);
  const int lit = std::min(255, dark + static_cast<int>(kLeastRise));
  return {static_cast<double>(dark), static_cast<double>(percentile(0.5, lit))};
}

double Sample(const cv::Mat& grey, cv::Point2d p) {
  const double x = std::clamp(p.x, 0.0, grey.cols - 1.001);
  const double y = std::clamp(p.y, 0.0, grey.rows - 1.001);
  const int ix = static_cast<int>(x), iy = static_cast<int>(y);
  const double fx = x - ix, fy = y - iy;
  const std::uint8_t *top = grey.ptr<std::uint8_t>(iy) + ix,
                     *bottom = grey.ptr<std::uint8_t>(iy + 1) + ix;
  return (1 - fy) * ((1 - fx) * top[0] + fx * top[1]) +
         fy * ((1 - fx) * bottom[0] + fx * bottom[1]);
}

double ReachOf(const cv::Size& size, cv::Point2d origin, cv::Point2d direction) {
  double reach = 1e9;
  if (direction.x > 1e-12) reach = std::min(reach, (size.width - 1 - origin.x) / direction.x);
  if (direction.x < -1e-12) reach = std::min(reach, -origin.x / direction.x);
  if (direction.y > 1e-12) reach = std::min(reach, (size.height - 1 - origin.y) / direction.y);
  if (direction.y < -1e-12) reach = std::min(reach, -origin.y / direction.y);
  return std::max(0.0, reach);
}

// Walks inwards from the picture's edge to the first lasting light and returns the steepest
// position there.
RimRay CastRay(const cv::Mat& grey, cv::Point2d origin, double angle, const Levels& levels) {
  RimRay ray;
  ray.direction = {std::cos(angle), std::sin(angle)};
  ray.reach = ReachOf(grey.size(), origin, ray.direction);
  const int count = static_cast<int>(ray.reach) + 1;
  if (count < 12) return ray;
  std::vector<double> profile(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i)
    profile[static_cast<std::size_t>(i)] =
        Sample(grey, origin + static_cast<double>(i) * ray.direction);
  const auto at = [&](int i) {
    return profile[static_cast<std::size_t>(std::clamp(i, 0, count - 1))];
  };

  const double threshold =
      levels.dark + std::max(0.6 * kLeastRise, 0.15 * (levels.bright - levels.dark));
  constexpr int kLasting = 5;  // px; thinner is text or a speck in the surround
  int lit = 0, first = -1;
  for (int i = count - 1; i >= 0 && first < 0; --i) {
    lit = at(i) > threshold ? lit + 1 : 0;
    if (lit == kLasting) first = i + kLasting - 1;
  }
  if (first < 0 || first >= count - 3)
    return ray;  // black throughout, or lit up to the picture's edge

  // Steepest fall within the rim's blur, refined to a fraction of a pixel by a parabola.
  const int blur = std::max(4, static_cast<int>(0.012 * std::min(grey.cols, grey.rows)));
  const auto fall = [&](int i) { return at(i - 2) + at(i - 1) - at(i + 1) - at(i + 2); };
  int steepest = first;
  for (int i = first - 2 * blur; i <= first + blur; ++i)
    if (i >= 2 && i < count - 2 && fall(i) > fall(steepest)) steepest = i;
  double inside = 0;  // grey level of the window a little further inside
  for (int i = 1; i <= 12; ++i) inside += at(steepest - blur - i) / 12.0;
  const double rise = at(steepest - blur) - at(steepest + blur);
  if (rise < std::max(0.5 * kLeastRise, 0.4 * (inside - levels.dark)))
    return ray;  // a soft shadow, not a rim
  const double a = fall(steepest - 1), b = fall(steepest), c = fall(steepest + 1);
  const double bend = a - 2 * b + c;
  const double shift = bend < -1e-9 ? std::clamp(0.5 * (a - c) / bend, -0.5, 0.5) : 0.0;
  ray.has_edge = true;
  ray.distance = steepest + shift;
  ray.point = origin + ray.distance * ray.direction;
  return ray;
}

std::vector<RimRay> CastRays(const cv::Mat& grey, cv::Point2d origin, const Levels& levels) {
  std::vector<RimRay> rays;
  rays.reserve(kRays);
  for (int i = 0; i < kRays; ++i)
    rays.push_back(CastRay(grey, origin, 2 * std::numbers::pi * i / kRays, levels));
  return rays;
}

double Tolerance(double radius) { return std::max(1.5, 0.004 * radius); }

double OffRim(const LensCircle& circle, cv::Point2d p) {
  return std::hypot(p.x - circle.cx, p.y - circle.cy) - circle.r;
}

std::optional<LensCircle> Through(cv::Point2d a, cv::Point2d b, cv::Point2d c) {
  const cv::Point2d ab = b - a, ac = c - a;
  const double cross = 2 * ab.cross(ac);
  if (std::abs(cross) < 1e-6) return std::nullopt;
  const double bb = ab.dot(ab), cc = ac.dot(ac);
  const cv::Point2d o((ac.y * bb - ab.y * cc) / cross, (ab.x * cc - ac.x * bb) / cross);
  return LensCircle{a.x + o.x, a.y + o.y, std::hypot(o.x, o.y)};
}

// Gauss-Newton least squares of the distances to the rim, with decreasing weight for far points.
LensCircle Refine(LensCircle circle, const std::vector<cv::Point2d>& points) {
  for (int step = 0; step < 12; ++step) {
    cv::Matx33d normal = cv::Matx33d::zeros();
    cv::Vec3d right(0, 0, 0);
    for (const cv::Point2d& p : points) {
      const double off = OffRim(circle, p), scale = off / Tolerance(circle.r);
      if (std::abs(scale) > 2) continue;
      const double weight = (1 - scale * scale / 4) * (1 - scale * scale / 4);
      const double distance = std::max(1e-9, off + circle.r);
      const cv::Vec3d slope(-(p.x - circle.cx) / distance, -(p.y - circle.cy) / distance, -1);
      normal += weight * slope * slope.t();
      right += weight * off * slope;
    }
    cv::Vec3d change;
    if (!cv::solve(normal, -right, change, cv::DECOMP_CHOLESKY)) break;
    circle.cx += change[0];
    circle.cy += change[1];
    circle.r += change[2];
    if (cv::norm(change) < 1e-4) break;
  }
  return circle;
}

std::optional<LensCircle> FitCircle(const std::vector<RimRay>& rays, const cv::Size& size) {
  std::vector<cv::Point2d> points;
  for (const RimRay& ray : rays)
    if (ray.has_edge) points.push_back(ray.point);
  if (points.size() < kRays / 10) return std::nullopt;
  std::mt19937 random(1);  // fixed: the same clip gives the same circle
  LensCircle best;
  int most = 0;
  const double largest = 2 * std::hypot(size.width, size.height);
  for (int trial = 0; trial < kTrials; ++trial) {
    const auto pick = [&] { return points[random() % points.size()]; };
    const auto circle = Through(pick(), pick(), pick());
    if (!circle || circle->r < 0.02 * std::min(size.width, size.height) || circle->r > largest)
      continue;
    const double tolerance = Tolerance(circle->r);
    const int inliers =
        static_cast<int>(std::count_if(points.begin(), points.end(), [&](const cv::Point2d& p) {
          return std::abs(OffRim(*circle, p)) < tolerance;
        }));
    if (inliers > most) {
      most = inliers;
      best = *circle;
    }
  }
  if (most < kRays / 12) return std::nullopt;
  return Refine(best, points);
}

// Checks that no light lies beyond the rim. A straight obstruction may cut into the window.
bool IsWindow(const LensCircle& circle, const std::vector<RimRay>& rays, cv::Point2d origin) {
  int visible = 0, on_rim = 0, beyond = 0;
  for (const RimRay& ray : rays) {
    // Point at which this ray leaves the circle.
    const cv::Point2d o = origin - cv::Point2d(circle.cx, circle.cy);
    const double along = o.dot(ray.direction);
    const double under = along * along - o.dot(o) + circle.r * circle.r;
    if (under < 0) return false;  // the origin would lie outside the circle
    const double leaves = -along + std::sqrt(under);
    if (leaves > ray.reach - 4) continue;  // cut off by the sensor
    ++visible;
    if (ray.has_edge && std::abs(OffRim(circle, ray.point)) < Tolerance(circle.r))
      ++on_rim;
    else if (!ray.has_edge || ray.distance > leaves)
      ++beyond;
  }
  return visible >= kRays / 12 && on_rim >= 0.3 * visible && beyond <= 0.15 * visible;
}

// Middle of the lit pixels. Any point inside the window serves as an origin of rays.
cv::Point2d LitMiddle(const cv::Mat& grey, const Levels& levels) {
  const cv::Mat lit = grey > 0.6 * levels.dark + 0.4 * levels.bright;
  const cv::Moments m = cv::moments(lit, true);
  if (m.m00 <= 0) return {grey.cols / 2.0, grey.rows / 2.0};
  return {m.m10 / m.m00, m.m01 / m.m00};
}

// Picture without the rows and columns along its edges that stay black over the clip, or that are
// half black and half picture.
cv::Rect LitPart(const cv::Mat& brightest) {
  if (brightest.empty()) return {};
  cv::Mat rows, columns;
  cv::reduce(brightest, rows, 1, cv::REDUCE_MAX);
  cv::reduce(brightest, columns, 0, cv::REDUCE_MAX);
  constexpr int kBlack = 40;  // grey level; the brightest pixel of a black bar stays below it
  constexpr int kBlur = 2;    // px beside a bar that the bar darkens
  const auto part = [](const cv::Mat& line) {
    const int count = static_cast<int>(line.total());
    int first = 0, last = count;
    while (first < last && line.data[first] < kBlack) ++first;
    while (last > first && line.data[last - 1] < kBlack) --last;
    const int before = first > 0 ? first + kBlur : 0;
    const int after = last < count ? last - kBlur : last;
    return cv::Range(before, std::max(before, after));
  };
  const cv::Range y = part(rows), x = part(columns);
  return {x.start, y.start, x.size(), y.size()};
}

}  // namespace

LensCircle FindCircle(const cv::Mat& picture) {
  CV_Assert(picture.empty() || picture.type() == CV_8UC1);
  if (std::min(picture.cols, picture.rows) < kLeastSide) return {};
  cv::Mat grey;
  cv::GaussianBlur(picture, grey, {}, std::max(0.8, std::min(picture.cols, picture.rows) / 700.0));
  const Levels levels = LevelsOf(grey);
  if (levels.bright - levels.dark < kLeastRise) return {};

  // The first rays start from a guess, the next from the circle found with the guess.
  cv::Point2d origin = LitMiddle(grey, levels);
  std::vector<RimRay> rays;
  std::optional<LensCircle> circle;
  for (int round = 0; round < 3; ++round) {
    rays = CastRays(grey, origin, levels);
    circle = FitCircle(rays, grey.size());
    if (!circle) return {};
    if (!IsWindow(*circle, rays, origin)) return {};
    const cv::Point2d middle(circle->cx, circle->cy);
    if (!cv::Rect2d(0, 0, grey.cols, grey.rows).contains(middle)) break;
    origin = middle;
  }
  // A window that contains the whole picture cuts nothing off.
  const double farthest = std::max(
      {std::hypot(circle->cx, circle->cy), std::hypot(grey.cols - 1 - circle->cx, circle->cy),
       std::hypot(circle->cx, grey.rows - 1 - circle->cy),
       std::hypot(grey.cols - 1 - circle->cx, grey.rows - 1 - circle->cy)});
  return circle->r < farthest - 2 ? *circle : LensCircle{};
}

void CircleFinder::Add(const cv::Mat& rgb) {
  if (rgb.empty() || (!brightest_.empty() && rgb.size() != brightest_.size())) return;
  cv::extractChannel(rgb, grey_, 0);  // green: tissue may be dark in it, but never in red alone
  if (brightest_.empty())
    grey_.copyTo(brightest_);
  else
    cv::max(brightest_, grey_, brightest_);
  ++frames_;
  if (const LensCircle circle = FindCircle(grey_); circle.r > 0) circles_.push_back(circle);
}

ClipCircle CircleFinder::Find() const {
  ClipCircle found = FindRound();
  found.lit = LitPart(brightest_);
  return found;
}

ClipCircle CircleFinder::FindRound() const {
  if (2 * circles_.size() < static_cast<std::size_t>(frames_) || circles_.empty())
    return {FindCircle(brightest_), 0};
  // The window on the sensor keeps its size, so a circle of another radius is an error.
  std::vector<double> radii;
  for (const LensCircle& circle : circles_) radii.push_back(circle.r);
  std::nth_element(radii.begin(), radii.begin() + radii.size() / 2, radii.end());
  const double radius = radii[radii.size() / 2];
  std::vector<cv::Point2f> middles;
  cv::Point2d mean(0, 0);
  for (const LensCircle& circle : circles_) {
    if (std::abs(circle.r - radius) > 0.03 * radius) continue;
    middles.emplace_back(static_cast<float>(circle.cx), static_cast<float>(circle.cy));
    mean += cv::Point2d(circle.cx, circle.cy);
  }
  mean *= 1.0 / static_cast<double>(middles.size());
  cv::Point2f middle;
  float reach = 0;
  cv::minEnclosingCircle(middles, middle, reach);
  constexpr double kStill = 1.0;  // px; smaller movements are scatter of the detection
  if (reach < kStill) return {{mean.x, mean.y, radius}, 0};
  return {{middle.x, middle.y, radius - reach}, 2.0 * reach};
}

}  // namespace arthro::authoring
