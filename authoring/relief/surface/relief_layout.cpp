#include "authoring/relief/surface/relief_layout.h"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

#include "simulation/core/units.h"

namespace arthro::authoring {
namespace {

constexpr float kLeastCosine = 0.05f;  // least cosine of the angle off the optical axis
// Least cosine of the incidence: a slope that is less certain than that would brighten without end.
constexpr float kLeastIncidence = 0.3f;

SurfacePlace PlaceOf(const SurfaceView& view, const LensProfile& lens, const SurfaceCells& cells,
                     const cv::Mat& radius, const LitSurface& lit, const cv::Mat& visible,
                     const cv::Rect& box, float usual_range, const ReliefLayoutRequest& request) {
  SurfacePlace place{cv::Mat(box.size(), CV_32FC2), visible(box).clone(),
                     cv::Mat(box.size(), CV_32FC2), cv::Mat(box.size(), CV_32F),
                     cv::Mat(box.size(), CV_32F)};
  const double radians_per_px =
      RadiansFromDegrees(1) / (cells.projection.px_per_deg * request.cell);
  const double focal_px = lens.focal_px() * request.picture_scale;
  for (int y = 0; y < box.height; ++y)
    for (int x = 0; x < box.width; ++x) {
      const cv::Vec3f& d = cells.Row(box.y + y)[box.x + x];
      const float r = radius.at<float>(box.y + y, box.x + x);
      const cv::Vec3f point = d * r, ray = point - view.centre;
      const float range = std::max(1e-6f, static_cast<float>(cv::norm(ray)));
      const cv::Vec3f local = view.camera_from_portal * ray / range;
      double pixel[2] = {-1, -1};
      ProjectPoint(view, lens, point, pixel);
      place.pixel.at<cv::Vec2f>(y, x) = {
          static_cast<float>((pixel[0] + 0.5) * request.picture_scale - 0.5),
          static_cast<float>((pixel[1] + 0.5) * request.picture_scale - 0.5)};
      const float along = std::max(local[2], kLeastCosine);
      place.tangent.at<cv::Vec2f>(y, x) = {local[0] / along, local[1] / along};
      const cv::Vec3f& normal = lit.normals.at<cv::Vec3f>(box.y + y, box.x + x);
      const cv::Vec3f to_lit = d * lit.radius.at<float>(box.y + y, box.x + x) - view.centre;
      const float lit_range = std::max(1e-6f, static_cast<float>(cv::norm(to_lit)));
      const float incidence = std::max(kLeastIncidence, -normal.dot(to_lit) / lit_range);
      const float from_portal = std::max(kLeastIncidence, -normal.dot(d));
      const float relative = usual_range / lit_range;
      place.light.at<float>(y, x) = incidence * relative * relative;
      place.sharpness.at<float>(y, x) = static_cast<float>(focal_px * radians_per_px * r / range *
                                                           std::sqrt(incidence / from_portal));
    }
  return place;
}

}  // namespace

cv::Mat NormalsOf(const SurfaceCells& cells, const cv::Mat& radius) {
  constexpr int kReach = 2;  // cells
  cv::Mat normals(cells.size, CV_32FC3);
  const auto point = [&](int x, int y) {
    x = std::clamp(x, 0, cells.size.width - 1);
    y = std::clamp(y, 0, cells.size.height - 1);
    return cells.Row(y)[x] * radius.at<float>(y, x);
  };
  for (int y = 0; y < cells.size.height; ++y)
    for (int x = 0; x < cells.size.width; ++x) {
      const cv::Vec3f right = point(x + kReach, y) - point(x - kReach, y),
                      down = point(x, y + kReach) - point(x, y - kReach);
      cv::Vec3f normal = right.cross(down);
      const float length = static_cast<float>(cv::norm(normal));
      const cv::Vec3f& d = cells.Row(y)[x];
      normal = length > 0 ? normal / length : -d;
      if (normal.dot(d) > 0) normal = -normal;
      normals.at<cv::Vec3f>(y, x) = normal;
    }
  return normals;
}

LitSurface LitSurfaceOf(const SurfaceCells& cells, const ClosedSurface& closed) {
  constexpr double kLeast = 3;          // cells; standard deviation of the smoothing
  constexpr int kLevels = 7;            // each wider by √2
  constexpr double kSlope = 0.1;        // rad, standard error of a slope that may be shown
  constexpr float kLeastSigma = 5e-5f;  // m
  const double radians_per_cell = RadiansFromDegrees(1 / cells.projection.px_per_deg);
  // Errors of neighbours agree, so that a slope over k cells has the error sigma / (k cells).
  cv::Mat reach(cells.size, CV_32F), weight(cells.size, CV_32F);
  for (int y = 0; y < cells.size.height; ++y)
    for (int x = 0; x < cells.size.width; ++x) {
      const float r = closed.radius.at<float>(y, x),
                  sigma = std::max(kLeastSigma, closed.sigma.at<float>(y, x));
      reach.at<float>(y, x) = sigma / static_cast<float>(kSlope * radians_per_cell) / r;
      const float relative = kLeastSigma / sigma;
      weight.at<float>(y, x) = relative * relative;
    }
  cv::GaussianBlur(reach, reach, {0, 0}, kLeast);
  LitSurface lit{cv::Mat::zeros(cells.size, CV_32F), cv::Mat::zeros(cells.size, CV_32FC3)};
  for (int level = 0; level < kLevels; ++level) {
    const double width = kLeast * std::pow(2, 0.5 * level);
    cv::Mat radius, sum;
    cv::GaussianBlur(closed.radius.mul(weight), radius, {0, 0}, width);
    cv::GaussianBlur(weight, sum, {0, 0}, width);
    radius /= sum;
    const cv::Mat normals = NormalsOf(cells, radius);
    // Between two levels both count, so that no line shows where the level changes.
    for (int y = 0; y < cells.size.height; ++y)
      for (int x = 0; x < cells.size.width; ++x) {
        const double wanted = 2 * std::log2(std::max(1.0, reach.at<float>(y, x) / kLeast));
        const double apart = std::abs(std::min(wanted, kLevels - 1.0) - level);
        if (apart >= 1) continue;
        const auto share = static_cast<float>(1 - apart);
        lit.radius.at<float>(y, x) += share * radius.at<float>(y, x);
        lit.normals.at<cv::Vec3f>(y, x) += share * normals.at<cv::Vec3f>(y, x);
      }
  }
  for (int y = 0; y < cells.size.height; ++y)
    for (int x = 0; x < cells.size.width; ++x) {
      cv::Vec3f& normal = lit.normals.at<cv::Vec3f>(y, x);
      normal /= std::max(1e-6f, static_cast<float>(cv::norm(normal)));
    }
  return lit;
}

Layout LayOverRelief(const std::vector<SurfaceView>& views, const LensProfile& lens,
                     const SurfaceCells& cells, const ClosedSurface& closed,
                     const std::vector<cv::Mat>& visible, const ReliefLayoutRequest& request) {
  Layout layout;
  layout.cells = cells.size;
  layout.cell = request.cell;
  layout.size = cells.size * request.cell;
  const cv::Mat& radius = closed.radius;
  const LitSurface lit = LitSurfaceOf(cells, closed);
  std::vector<float> ranges;
  for (std::size_t v = 0; v < views.size(); ++v)
    for (int y = 0; y < cells.size.height; y += 4)
      for (int x = 0; x < cells.size.width; x += 4)
        if (visible[v].at<std::uint8_t>(y, x))
          ranges.push_back(static_cast<float>(
              cv::norm(cells.Row(y)[x] * radius.at<float>(y, x) - views[v].centre)));
  if (ranges.empty()) return layout;
  std::nth_element(ranges.begin(), ranges.begin() + static_cast<std::ptrdiff_t>(ranges.size() / 2),
                   ranges.end());
  const float usual = ranges[ranges.size() / 2];
  for (std::size_t v = 0; v < views.size(); ++v) {
    // A cell around what is seen, so that interpolation at its border has neighbours.
    const cv::Rect seen = cv::boundingRect(visible[v]);
    if (seen.empty()) continue;
    const cv::Rect box = cv::Rect(seen.x - 1, seen.y - 1, seen.width + 2, seen.height + 2) &
                         cv::Rect({0, 0}, cells.size);
    LaidFrame frame;
    frame.index = request.indices[v];
    frame.composed_from_rectified = cv::Matx33d::eye();
    frame.cells = box;
    frame.surface = PlaceOf(views[v], lens, cells, radius, lit, visible[v], box, usual, request);
    layout.frames.push_back(std::move(frame));
  }
  return layout;
}

}  // namespace arthro::authoring
