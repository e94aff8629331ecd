#include "authoring/relief/make/relief_picture.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include <opencv2/imgproc.hpp>

#include "authoring/panorama/chosen_pictures.h"
#include "authoring/relief/median.h"
#include "authoring/relief/surface/relief_layout.h"
#include "simulation/core/units.h"

namespace arthro::authoring {
namespace {

// Widths of a cell in the panorama: the bands of the detail halve a cell twice.
constexpr int kScales[] = {4, 8, 16};
constexpr double kMostPixels = 16e6;
constexpr double kEnough = 0.8;  // share of the frames' resolution that the panorama keeps

std::vector<int> FootageIndices(const MeasuredRelief& made) {
  std::vector<int> indices;
  for (const ClipRow& row : made.clip.rows)
    if (row.reason.empty()) indices.push_back(row.index);
  return indices;
}

// The least scale at which the panorama has about the pixels of the frames.
int ScaleOf(const MeasuredRelief& made, const FinishedSurface& finished) {
  std::vector<double> ratios;  // radius over range
  for (std::size_t v = 0; v < finished.views.size(); ++v)
    for (int y = 0; y < finished.cells.size.height; y += 8)
      for (int x = 0; x < finished.cells.size.width; x += 8) {
        if (!finished.visible[v].at<std::uint8_t>(y, x)) continue;
        const float r = finished.closed.radius.at<float>(y, x);
        ratios.push_back(r / cv::norm(finished.cells.Row(y)[x] * r - finished.views[v].centre));
      }
  const double wanted =
      RadiansFromDegrees(1) * made.lens.focal_px() / made.clip.scale * Median(ratios);
  int scale = kScales[0];
  for (const int next : kScales) {
    if (next * static_cast<double>(next) * finished.cells.size.area() > kMostPixels) break;
    scale = next;
    if (next * finished.cells.projection.px_per_deg >= kEnough * wanted) break;
  }
  return scale;
}

// Radius of the surface in a direction, between the cells; 0 outside the grid.
double RadiusAt(const FinishedSurface& finished, const cv::Vec3d& direction) {
  const auto pixel =
      PixelFromDirection(finished.cells.projection, {direction[0], direction[1], direction[2]});
  if (!pixel) return 0;
  const int x = static_cast<int>(std::floor(pixel->x)), y = static_cast<int>(std::floor(pixel->y));
  const cv::Mat& radius = finished.closed.radius;
  if (x < 0 || y < 0 || x + 1 >= radius.cols || y + 1 >= radius.rows) return 0;
  const double fx = pixel->x - x, fy = pixel->y - y;
  return (1 - fy) * ((1 - fx) * radius.at<float>(y, x) + fx * radius.at<float>(y, x + 1)) +
         fy * ((1 - fx) * radius.at<float>(y + 1, x) + fx * radius.at<float>(y + 1, x + 1));
}

// Finds the pixel of the maps at which a ray from inside meets the surface; false where it leaves
// the grid.
bool Meet(const FinishedSurface& finished, const cv::Vec3d& from, const cv::Vec3d& ray,
          double longest, cv::Point2d& pixel) {
  constexpr int kSteps = 40, kHalvings = 14;
  double low = 0, high = -1;
  for (int k = 1; k <= kSteps; ++k) {
    const double t = longest * k / kSteps;
    const cv::Vec3d at = from + t * ray;
    const double radius = RadiusAt(finished, at);
    if (radius > 0 && cv::norm(at) >= radius) {
      high = t;
      break;
    }
    low = t;
  }
  if (high < 0) return false;
  for (int k = 0; k < kHalvings; ++k) {
    const double t = 0.5 * (low + high);
    const cv::Vec3d at = from + t * ray;
    const double radius = RadiusAt(finished, at);
    (radius > 0 && cv::norm(at) >= radius ? high : low) = t;
  }
  const cv::Vec3d at = from + high * ray;
  const auto found = PixelFromDirection(finished.cells.projection, {at[0], at[1], at[2]});
  if (!found) return false;
  pixel = {found->x, found->y};
  return true;
}

// Distances of one frame, summed.
struct FrameDistances {
  double apart = 0, noise = 0;
  int count = 0;
};

// How far apart the frames lay a tracked point: the tracks were not used to find the surface, so
// that the distances between their places are those of the panorama, and noise of the tracks. That
// noise is the distance to where the adjusted point would be laid.
std::map<int, double> ErrorsOf(const MeasuredRelief& made, const FinishedSurface& finished,
                               const std::vector<int>& indices, int scale) {
  double most = 0;
  cv::minMaxLoc(finished.closed.radius, nullptr, &most);
  std::map<int, FrameDistances> sums;
  struct Place {
    int frame;
    cv::Point2d seen, adjusted;
  };
  std::vector<Place> places;
  for (const TrackPoint& point : made.motion.scene.points) {
    const Track& track = made.tracks[static_cast<std::size_t>(point.track)];
    places.clear();
    cv::Point2d middle(0, 0);
    for (std::size_t k = 0; k < track.seen.size(); ++k) {
      const int f = track.seen[k].frame;
      const auto& pose = made.motion.scene.poses[static_cast<std::size_t>(f)];
      if (!pose || !point.uses[k]) continue;
      const Eigen::Vector3d& c = pose->centre;
      const auto meet = [&](const Eigen::Vector3d& ray, cv::Point2d& pixel) {
        if (!Meet(finished, {c[0], c[1], c[2]}, {ray[0], ray[1], ray[2]}, c.norm() + most, pixel))
          return false;
        pixel *= scale;
        return true;
      };
      Place place{f, {}, {}};
      if (!meet(pose->world_from_camera * track.seen[k].ray.normalized(), place.seen) ||
          !meet((point.position - c).normalized(), place.adjusted))
        continue;
      places.push_back(place);
      middle += place.seen;
    }
    if (places.size() < 2) continue;
    middle *= 1.0 / static_cast<double>(places.size());
    for (const Place& place : places) {
      FrameDistances& sum = sums[indices[static_cast<std::size_t>(place.frame)]];
      sum.apart += cv::norm(place.seen - middle);
      sum.noise += cv::norm(place.seen - place.adjusted);
      ++sum.count;
    }
  }
  std::map<int, double> errors;
  for (const auto& [index, sum] : sums) {
    // A third of the noise stays: so much the poses may have followed it.
    const double apart = sum.apart / sum.count, noise = sum.noise / sum.count;
    errors[index] = std::sqrt(std::max(apart * apart - noise * noise, noise * noise / 9));
  }
  return errors;
}

}  // namespace

ReliefPicture DrawOverRelief(const std::filesystem::path& footage, const MeasuredRelief& made,
                             const FinishedSurface& finished, const ReliefOptions&,
                             const Progress& progress) {
  ReliefPicture drawn;
  drawn.scale = ScaleOf(made, finished);
  const std::vector<int> indices = FootageIndices(made);
  progress.Step("distances in the panorama", 0.0);
  drawn.error_px = ErrorsOf(made, finished, indices, drawn.scale);
  ReliefLayoutRequest request;
  request.picture_scale = 1 / made.clip.scale;
  request.cell = drawn.scale;
  std::set<int> wanted;
  for (const SurfaceView& view : finished.views) {
    request.indices.push_back(indices[static_cast<std::size_t>(view.frame)]);
    wanted.insert(request.indices.back());
  }
  progress.Step("placing the frames", 0.0);
  const Layout layout = LayOverRelief(finished.views, made.lens, finished.cells, finished.closed,
                                      finished.visible, request);
  ChosenPictures pictures(footage, wanted);
  FramePicture picture;
  picture.draw = [](const cv::Mat& raw, cv::Mat& as_is) { as_is = raw; };
  const Footage raw = Footage::Open(footage);
  cv::resize(made.clip.window, picture.mask, {raw.info().width, raw.info().height}, 0, 0,
             cv::INTER_NEAREST);
  drawn.rgba = ComposeLayout([&](int& index, cv::Mat& rgb) { return pictures(index, rgb); },
                             picture, layout, {}, nullptr, progress)
                   .rgba;
  return drawn;
}

}  // namespace arthro::authoring
