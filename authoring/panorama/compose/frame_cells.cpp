#include "authoring/panorama/compose/frame_cells.h"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

namespace arthro::authoring {
namespace {

constexpr double kGlare = 246;        // grey levels: above it no colour is left
constexpr int kGlareReach = 5;        // px: glow around a highlight
constexpr double kLeastShown = 0.97;  // share of a cell, inside the lens's mask

// Position in the target: (source + 0.5) / factor - 0.5, in both directions.
cv::Matx33d Shrink(double factor) {
  return {1 / factor, 0, 0.5 / factor - 0.5, 0, 1 / factor, 0.5 / factor - 0.5, 0, 0, 1};
}

// Panorama px per px of the frame's picture, approximate.
double Magnification(const cv::Size& picture, const LaidFrame& frame) {
  if (!frame.surface.empty()) {
    const cv::Scalar mean = cv::mean(frame.surface.sharpness, frame.surface.is_shown);
    return 1 / std::max(mean[0], 1e-3);
  }
  const cv::Matx33d& h = frame.composed_from_rectified;
  const double at_middle = h(2, 0) * picture.width / 2 + h(2, 1) * picture.height / 2 + h(2, 2);
  return std::sqrt(std::abs(cv::determinant(h)) / std::pow(std::max(at_middle, 1e-9), 3));
}

}  // namespace

CellRays::CellRays(const LaidFrame& frame, int cell, const RectifiedView& view)
    : rectified_from_cell_(frame.composed_from_rectified.inv() * Shrink(1.0 / cell)),
      composed_from_rectified_(frame.composed_from_rectified),
      view_(view),
      det_(std::abs(cv::determinant(frame.composed_from_rectified))),
      surface_(frame.surface),
      first_(frame.cells.tl()) {}

CellRays::Ray CellRays::At(int column, int row) const {
  if (!surface_.empty()) {
    const int x = column - first_.x, y = row - first_.y;
    const auto& tangent = surface_.tangent.at<cv::Vec2f>(y, x);
    return {tangent[0], tangent[1], surface_.light.at<float>(y, x),
            surface_.sharpness.at<float>(y, x)};
  }
  const cv::Vec3d h = rectified_from_cell_ * cv::Vec3d(column, row, 1);
  const double px = h[0] / h[2], py = h[1] / h[2];
  Ray ray;
  ray.x = (px - view_.cx) / view_.focal_px;
  ray.y = (py - view_.cy) / view_.focal_px;
  const auto& c = composed_from_rectified_;
  ray.w = std::max(1e-6, c(2, 0) * px + c(2, 1) * py + c(2, 2));
  // A fisheye has about cos^3 as many pixels per unit of area in the tangent plane.
  const double cosine = 1 / std::sqrt(1 + ray.x * ray.x + ray.y * ray.y);
  ray.sharpness = std::sqrt(ray.w * ray.w * ray.w / det_ * cosine * cosine * cosine);
  return ray;
}

cv::Mat TissueMask(const cv::Mat& rectified_rgb, const cv::Mat& lens_mask) {
  cv::Mat channels[3], glare;
  cv::split(rectified_rgb, channels);
  cv::max(channels[0], channels[1], glare);
  cv::max(glare, channels[2], glare);
  cv::threshold(glare, glare, kGlare, 255, cv::THRESH_BINARY);
  cv::dilate(glare, glare, cv::Mat::ones(kGlareReach, kGlareReach, CV_8U));
  cv::Mat tissue = lens_mask.clone();
  tissue.setTo(0, glare);
  return tissue;
}

FrameCells CellsOf(const cv::Mat& rectified_rgb, const cv::Mat& tissue_mask,
                   const cv::Mat& lens_mask, const LaidFrame& frame, int cell) {
  // Reduces to about the cells' size by averaging whole pixels, so that none is skipped.
  const cv::Matx33d& h = frame.composed_from_rectified;
  const double magnification = Magnification(rectified_rgb.size(), frame);
  const int shrink = std::clamp(static_cast<int>(std::lround(cell / magnification)), 1,
                                std::min({16, rectified_rgb.cols, rectified_rgb.rows}));
  const cv::Size small(rectified_rgb.cols / shrink, rectified_rgb.rows / shrink);
  const cv::Rect whole(0, 0, small.width * shrink, small.height * shrink);
  cv::Mat shown = cv::Mat::zeros(rectified_rgb.size(), CV_8UC3), colour, good, lens;
  rectified_rgb.copyTo(shown, tissue_mask);
  cv::resize(shown(whole), colour, small, 0, 0, cv::INTER_AREA);
  cv::resize(tissue_mask(whole), good, small, 0, 0, cv::INTER_AREA);
  cv::resize(lens_mask(whole), lens, small, 0, 0, cv::INTER_AREA);
  colour.convertTo(colour, CV_32F);

  const cv::Size box = frame.cells.size();
  const cv::Matx33d cell_from_small =
      cv::Matx33d(1, 0, -frame.cells.x, 0, 1, -frame.cells.y, 0, 0, 1) * Shrink(cell) * h *
      Shrink(1.0 / shrink);
  cv::Mat small_pixel;  // over a surface
  if (!frame.surface.empty())
    frame.surface.pixel.convertTo(small_pixel, CV_32F, 1.0 / shrink, 0.5 / shrink - 0.5);
  const auto draw = [&](const cv::Mat& from, cv::Mat& to) {
    if (small_pixel.empty())
      cv::warpPerspective(from, to, cell_from_small, box);
    else
      cv::remap(from, to, small_pixel, cv::noArray(), cv::INTER_LINEAR);
  };
  cv::Mat cell_colour, cell_good, cell_lens, glaring, cell_glaring;
  draw(colour, cell_colour);
  draw(good, cell_good);
  draw(lens, cell_lens);
  if (!frame.surface.empty()) cell_lens.setTo(0, frame.surface.is_shown == 0);
  // Overexposed cells keep their colour, since there is no better one.
  cv::resize(rectified_rgb(whole), glaring, small, 0, 0, cv::INTER_AREA);
  draw(glaring, cell_glaring);

  FrameCells cells{cv::Mat(box, CV_16UC3), cv::Mat(box, CV_8U)};
  for (int y = 0; y < box.height; ++y)
    for (int x = 0; x < box.width; ++x) {
      const int share = cell_good.at<uchar>(y, x);
      const bool is_inside = cell_lens.at<uchar>(y, x) >= 255 * kLeastShown;
      uchar& blend_weight = cells.blend_weight.at<uchar>(y, x);
      auto& out = cells.colour.at<cv::Vec3w>(y, x);
      blend_weight = 0;
      out = cv::Vec3w(0, 0, 0);
      if (!is_inside) continue;
      const cv::Vec3f& sum = cell_colour.at<cv::Vec3f>(y, x);
      const cv::Vec3b& glare = cell_glaring.at<cv::Vec3b>(y, x);
      for (int c = 0; c < 3; ++c)
        out[c] = cv::saturate_cast<ushort>(
            kGreySteps *
            (share >= 64 ? std::min(255.f, sum[c] * 255.f / static_cast<float>(share)) : glare[c]));
      blend_weight = static_cast<uchar>(share >= 64 ? share : 1);
    }
  return cells;
}

}  // namespace arthro::authoring
