#include "authoring/relief/surface/surface_view.h"

#include <cmath>

#include <opencv2/imgproc.hpp>

#include "authoring/panorama/graph/links/parallel.h"

namespace arthro::authoring {
namespace {

// Share of the radius by which a point of a line of sight must lie behind the surface to be hidden:
// more than the errors of the surface on both sides.
constexpr float kBehind = 0.03f;
constexpr int kSteps = 16;  // points of a line of sight that are tried

// Radius of the surface in a direction; 0 outside the grid.
float RadiusAt(const SurfaceCells& cells, const cv::Mat& radius, const cv::Vec3f& point) {
  const auto pixel = PixelFromDirection(cells.projection, {point[0], point[1], point[2]});
  if (!pixel) return 0;
  const int x = static_cast<int>(std::lround(pixel->x)),
            y = static_cast<int>(std::lround(pixel->y));
  if (x < 0 || y < 0 || x >= cells.size.width || y >= cells.size.height) return 0;
  return radius.at<float>(y, x);
}

bool IsHidden(const SurfaceView& view, const SurfaceCells& cells, const cv::Mat& radius,
              const cv::Vec3f& point) {
  const cv::Vec3f ray = point - view.centre;
  // The first half of the way is never behind tissue unless the tip is.
  for (int k = 1; k < kSteps; ++k) {
    const float share = 0.3f + 0.7f * static_cast<float>(k) / static_cast<float>(kSteps);
    const cv::Vec3f at = view.centre + share * ray;
    const float surface = RadiusAt(cells, radius, at);
    if (surface > 0 && static_cast<float>(cv::norm(at)) > (1 + kBehind) * surface) return true;
  }
  return false;
}

}  // namespace

SurfaceCells CellDirections(const Projection& projection, const cv::Size& size) {
  SurfaceCells cells{projection, size, {}};
  cells.directions.reserve(static_cast<std::size_t>(size.area()));
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x) {
      const glm::dvec3 d = DirectionFromPixel(projection, {x, y});
      cells.directions.emplace_back(static_cast<float>(d.x), static_cast<float>(d.y),
                                    static_cast<float>(d.z));
    }
  return cells;
}

std::vector<SurfaceView> ViewsOf(const std::vector<WorkingFrame>& frames,
                                 const Reconstruction& scene, double smoothing) {
  std::vector<SurfaceView> views;
  for (std::size_t f = 0; f < frames.size(); ++f) {
    if (!scene.poses[f]) continue;
    SurfaceView view;
    view.frame = static_cast<int>(f);
    for (int r = 0; r < 3; ++r) {
      for (int c = 0; c < 3; ++c)
        view.camera_from_portal(r, c) = static_cast<float>(scene.poses[f]->world_from_camera(c, r));
      view.centre[r] = static_cast<float>(scene.poses[f]->centre[r]);
    }
    frames[f].grey.convertTo(view.grey, CV_32F);
    if (smoothing > 0) cv::GaussianBlur(view.grey, view.grey, {0, 0}, smoothing);
    view.mask = frames[f].mask;
    views.push_back(std::move(view));
  }
  return views;
}

std::vector<cv::Mat> VisibleCells(const std::vector<SurfaceView>& views, const LensProfile& lens,
                                  const SurfaceCells& cells, const cv::Mat& radius, int threads,
                                  const Progress& progress) {
  std::vector<cv::Mat> visible(views.size());
  ForEachIndex(static_cast<int>(views.size()), threads, progress, "what each frame sees",
               [&](int i) {
                 const SurfaceView& view = views[static_cast<std::size_t>(i)];
                 cv::Mat seen = cv::Mat::zeros(cells.size, CV_8U), hidden = seen.clone();
                 for (int y = 0; y < cells.size.height; ++y) {
                   const cv::Vec3f* d = cells.Row(y);
                   for (int x = 0; x < cells.size.width; ++x) {
                     const float r = radius.at<float>(y, x);
                     double pixel[2];
                     if (!(r > 0) || !PixelOf(view, lens, d[x] * r, pixel)) continue;
                     seen.at<std::uint8_t>(y, x) = 255;
                     if (x % 2 == 0 && y % 2 == 0 && IsHidden(view, cells, radius, d[x] * r))
                       hidden.at<std::uint8_t>(y, x) = 255;
                   }
                 }
                 // Every other cell stands for its neighbours.
                 cv::dilate(hidden, hidden, cv::Mat::ones(3, 3, CV_8U));
                 seen.setTo(0, hidden);
                 visible[static_cast<std::size_t>(i)] = seen;
               });
  return visible;
}

}  // namespace arthro::authoring
