#include "authoring/phantom/clip/clip_overlays.h"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

#include "authoring/phantom/clip/plane_noise.h"

namespace arthro::authoring {
namespace {

constexpr double kBoxRadius = 300;  // px

struct Shaft {
  cv::Point2d tip, along;  // unit
  double half_width = 0;   // px
};

Shaft ShaftOf(cv::Point2d centre, double radius, int frame) {
  const double angle = 0.6 + 0.5 * std::sin(0.17 * frame);
  return {centre + radius * cv::Point2d(0.4 * std::cos(0.11 * frame), 0.2 * std::sin(0.23 * frame)),
          {std::cos(angle), std::sin(angle)},
          0.2 * radius};
}

double Wrap(double x, double size) { return x - size * std::floor(x / size); }

}  // namespace

cv::Mat Clouds(const ClipOptions& options, double radius) {
  if (options.haze <= 0) return {};
  Random random(static_cast<std::uint64_t>(options.seed) * 31 + 5);
  return PlaneNoise({options.width / 2 + 2, options.height / 2 + 2},
                    {160 * radius / kBoxRadius / 4, 3}, random);
}

void AddHaze(const cv::Mat& clouds, double strength, int frame, cv::Mat& picture) {
  if (clouds.empty()) return;
  // Moves to and fro over clouds that are twice as large as the picture.
  const double ox = picture.cols / 8.0 * (1 + std::sin(0.021 * frame)),
               oy = picture.rows / 8.0 * (1 + std::sin(0.013 * frame + 1));
  const cv::Matx23d moved(0.25, 0, ox, 0, 0.25, oy);
  cv::Mat cover;
  cv::warpAffine(clouds, cover, moved, picture.size(), cv::INTER_LINEAR | cv::WARP_INVERSE_MAP,
                 cv::BORDER_REFLECT);
  const cv::Vec3f veil(0.55f, 0.25f, 0.22f);
  for (int y = 0; y < picture.rows; ++y)
    for (int x = 0; x < picture.cols; ++x) {
      const float share = static_cast<float>(strength) *
                          std::clamp(0.4f * cover.at<float>(y, x) + 0.1f, 0.0f, 1.0f);
      cv::Vec3f& p = picture.at<cv::Vec3f>(y, x);
      p = p * (1 - share) + veil * share;
    }
}

void AddDebris(const ClipOptions& options, double radius, int frame, cv::Mat& picture) {
  constexpr float kCover = 0.6f;
  const double scale = radius / kBoxRadius;
  Random random(static_cast<std::uint64_t>(options.seed) * 131 + 9);
  for (int i = 0; i < options.debris; ++i) {
    const auto drift = [&] { return 14 * scale * NormalOf(random.Next()); };
    const double x0 = random.Uniform(0, picture.cols), y0 = random.Uniform(0, picture.rows);
    const double vx = drift(), vy = drift();
    const double a = std::max(1.0, scale * random.Uniform(3, 15)),
                 b = std::max(1.0, scale * random.Uniform(3, 10));
    const double turn = random.Uniform(0, 3.1416) + 0.2 * NormalOf(random.Next()) * frame;
    const float grey = random.Uniform(0, 3) < 1 ? 0.25f : 0.9f;
    const double x = Wrap(x0 + vx * frame, picture.cols), y = Wrap(y0 + vy * frame, picture.rows);
    const int reach = static_cast<int>(std::ceil(1.4 * std::max(a, b) + 2));
    const double ca = std::cos(turn), sa = std::sin(turn);
    for (int v = std::max(0, static_cast<int>(y) - reach);
         v <= std::min(picture.rows - 1, static_cast<int>(y) + reach); ++v)
      for (int u = std::max(0, static_cast<int>(x) - reach);
           u <= std::min(picture.cols - 1, static_cast<int>(x) + reach); ++u) {
        const double along = (ca * (u - x) + sa * (v - y)) / a,
                     across = (-sa * (u - x) + ca * (v - y)) / b;
        const double away = (std::hypot(along, across) - 1) * std::min(a, b);  // px, approximate
        const float share = kCover / (1 + std::exp(static_cast<float>(away / 0.8)));
        cv::Vec3f& p = picture.at<cv::Vec3f>(v, u);
        p = p * (1 - share) + cv::Vec3f(grey, 0.97f * grey, 0.9f * grey) * share;
      }
  }
}

cv::Mat ToolCover(const ClipOptions& options, cv::Point2d centre, double radius, int frame) {
  cv::Mat cover = cv::Mat::zeros(options.height, options.width, CV_32F);
  const Shaft shaft = ShaftOf(centre, radius, frame);
  for (int y = 0; y < cover.rows; ++y)
    for (int x = 0; x < cover.cols; ++x) {
      const cv::Point2d d = cv::Point2d(x, y) - shaft.tip;
      const double along = d.dot(shaft.along);
      const double across = d.x * -shaft.along.y + d.y * shaft.along.x;
      const double away =
          (along > 0 ? std::abs(across) : std::hypot(along, across)) - shaft.half_width;
      cover.at<float>(y, x) = static_cast<float>(std::clamp(0.5 - away / 3, 0.0, 1.0));
    }
  return cover;
}

void AddTool(const ClipOptions& options, cv::Point2d centre, double radius, int frame,
             cv::Mat& picture) {
  const cv::Mat cover = ToolCover(options, centre, radius, frame);
  const Shaft shaft = ShaftOf(centre, radius, frame);
  for (int y = 0; y < picture.rows; ++y)
    for (int x = 0; x < picture.cols; ++x) {
      const float share = cover.at<float>(y, x);
      if (share <= 0) continue;
      const cv::Point2d d = cv::Point2d(x, y) - shaft.tip;
      const double across = (d.x * -shaft.along.y + d.y * shaft.along.x) / shaft.half_width;
      const float steel =
          static_cast<float>(0.25 + 0.6 * std::exp(-(across - 0.2) * (across - 0.2) / 0.0625));
      cv::Vec3f& p = picture.at<cv::Vec3f>(y, x);
      p = p * (1 - share) + cv::Vec3f(steel, steel, steel) * share;
    }
}

StaticMarks MarksOf(const ClipOptions& options, cv::Point2d centre, double radius) {
  StaticMarks marks;
  if (!options.marks) return marks;
  marks.dirt = cv::Mat::zeros(options.height, options.width, CV_8U);
  marks.letters = marks.dirt.clone();
  Random random(static_cast<std::uint64_t>(options.seed) * 17 + 3);
  for (int i = 0; i < 5; ++i) {
    const double angle = random.Uniform(0, 6.28), far = radius * random.Uniform(0.2, 0.8);
    const int size = std::max(2, static_cast<int>(radius * random.Uniform(0.015, 0.04)));
    cv::circle(marks.dirt, cv::Point(centre + far * cv::Point2d(std::cos(angle), std::sin(angle))),
               size, cv::Scalar(255), cv::FILLED, cv::LINE_AA);
  }
  cv::putText(marks.letters, "L KNEE 30", cv::Point(centre + radius * cv::Point2d(-0.5, 0.72)),
              cv::FONT_HERSHEY_SIMPLEX, radius / 300, cv::Scalar(255),
              std::max(1, static_cast<int>(std::lround(radius / 100))), cv::LINE_AA);
  return marks;
}

}  // namespace arthro::authoring
