// A small clip: views into a flat, textured picture through a round window, each with a known
// homography. A whole panorama of it takes a second.
#pragma once

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

namespace arthro::test {

class TinyClip {
 public:
  static constexpr int kWidth = 280, kHeight = 240;
  static constexpr double kRadius = 112, kCx = 140, kCy = 119;

  explicit TinyClip(unsigned seed = 1) : texture_(700, 900, CV_32FC3) {
    cv::RNG random(seed);
    texture_ = cv::Scalar(150, 95, 85);
    for (const auto& [cell, height] :
         {std::pair{90.0, 22.0}, {24.0, 16.0}, {7.0, 12.0}, {3.0, 8.0}}) {
      cv::Mat coarse(static_cast<int>(texture_.rows / cell) + 3,
                     static_cast<int>(texture_.cols / cell) + 3, CV_32FC1);
      random.fill(coarse, cv::RNG::NORMAL, 0, height);
      cv::Mat fine;
      cv::resize(coarse, fine, texture_.size(), 0, 0, cv::INTER_CUBIC);
      cv::cvtColor(fine, fine, cv::COLOR_GRAY2BGR);
      texture_ += fine;
    }
    for (int i = 0; i < 60; ++i) {  // vessels
      cv::Point from(random.uniform(0, texture_.cols), random.uniform(0, texture_.rows));
      const cv::Point to = from + cv::Point(random.uniform(-90, 90), random.uniform(-90, 90));
      cv::line(texture_, from, to, cv::Scalar(110, 30, 30), random.uniform(1, 4), cv::LINE_AA);
    }
  }

  // View with its middle at `at` of the texture, rotated by `angle`, rad.
  struct View {
    cv::Point2d at;
    double angle = 0;
  };
  // Makes n views along an arc, a quarter of the window apart.
  static std::vector<View> Arc(int n) {
    std::vector<View> views;
    for (int i = 0; i < n; ++i)
      views.push_back(
          {{240.0 + 52.0 * i, 330.0 + 60.0 * std::sin(0.5 * i)}, 0.04 * std::sin(1.1 * i)});
    return views;
  }

  // Exact map of the view's raw pixels to the texture.
  static cv::Matx33d TextureFromRaw(const View& view) {
    const double c = std::cos(view.angle), s = std::sin(view.angle);
    return cv::Matx33d(1, 0, view.at.x, 0, 1, view.at.y, 0, 0, 1) *
           cv::Matx33d(c, -s, 0, s, c, 0, 0, 0, 1) * cv::Matx33d(1, 0, -kCx, 0, 1, -kCy, 0, 0, 1);
  }

  // RGB, with the light's falloff, black outside the window, and some noise.
  cv::Mat Frame(const View& view, unsigned noise_seed = 1) const {
    cv::Mat lit;
    cv::warpPerspective(texture_, lit, cv::Mat(TextureFromRaw(view)), {kWidth, kHeight},
                        cv::INTER_CUBIC | cv::WARP_INVERSE_MAP, cv::BORDER_REFLECT);
    cv::Mat noise(lit.size(), CV_32FC3);
    cv::RNG random(noise_seed);
    random.fill(noise, cv::RNG::NORMAL, 0, 1.0);
    for (int y = 0; y < lit.rows; ++y)
      for (int x = 0; x < lit.cols; ++x) {
        const double r = std::hypot(x - kCx, y - kCy);
        const double light = 1.25 / (1 + 0.7 * r * r / (kRadius * kRadius));
        const double window = std::min(1.0, std::max(0.0, kRadius + 0.5 - r));
        lit.at<cv::Vec3f>(y, x) =
            static_cast<float>(window) *
            (static_cast<float>(light) * lit.at<cv::Vec3f>(y, x) + noise.at<cv::Vec3f>(y, x));
      }
    cv::Mat frame;
    lit.convertTo(frame, CV_8U);
    return frame;
  }

  static void Write(const std::filesystem::path& file, const cv::Mat& rgb) {
    cv::Mat bgr;
    cv::cvtColor(rgb, bgr, cv::COLOR_RGB2BGR);
    cv::imwrite(file.string(), bgr, {cv::IMWRITE_PNG_COMPRESSION, 1});
  }
  void WriteAll(const std::filesystem::path& folder, const std::vector<View>& views) const {
    std::filesystem::create_directories(folder);
    for (std::size_t i = 0; i < views.size(); ++i)
      Write(folder / fmt::format("{:03}.png", i), Frame(views[i], static_cast<unsigned>(i) + 1));
  }

 private:
  cv::Mat texture_;
};

}  // namespace arthro::test
