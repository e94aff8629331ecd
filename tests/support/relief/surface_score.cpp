#include "tests/support/relief/surface_score.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Dense>

#include "simulation/core/units.h"
#include "tests/support/depth_score.h"

namespace arthro::test {
namespace {

using Eigen::Vector3d;

constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();
constexpr int kHalfDeg = 60;
constexpr double kPxPerDeg = 2;
constexpr int kSide = static_cast<int>(2 * kHalfDeg * kPxPerDeg) + 1;
constexpr int kLeastFrames = 3;

// x_true = scale · rotation · x_found + shift
struct Similarity {
  double scale = 1;
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Vector3d shift = Vector3d::Zero();
};

// Fits the centres and points 4 mm along the axes of each camera: the centres alone say little
// about the rotation.
std::optional<Similarity> TrueFromFound(const authoring::ReliefReport& report,
                                        const CavityTruth& truth) {
  constexpr double kAxis = 4e-3;  // m
  Similarity fit;
  // The length of the axes depends on the scale: first by the centres alone, then again.
  for (int round = 0; round < 13; ++round) {
    std::vector<Vector3d> from, to;
    for (const authoring::PosedFrame& frame : report.frames) {
      if (!frame.is_posed || static_cast<std::size_t>(frame.index) >= truth.poses.size()) continue;
      const authoring::CameraPose& pose = truth.poses[static_cast<std::size_t>(frame.index)];
      const Eigen::Map<const Vector3d> centre(frame.centre.data());
      const Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> axes(
          frame.rotation.data());
      from.push_back(centre);
      to.push_back(pose.centre);
      for (int axis = 0; axis < 3 && round > 0; ++axis) {
        from.push_back(centre + kAxis / fit.scale * axes.col(axis));
        to.push_back(pose.centre + kAxis * pose.world_from_camera.col(axis));
      }
    }
    if (from.size() < 2) return std::nullopt;
    const auto columns = [](const std::vector<Vector3d>& points) {
      return Eigen::Map<const Eigen::Matrix3Xd>(points.front().data(), 3,
                                                static_cast<Eigen::Index>(points.size()));
    };
    if (round == 0) {
      const Eigen::Matrix3Xd a = columns(from).colwise() - columns(from).rowwise().mean(),
                             b = columns(to).colwise() - columns(to).rowwise().mean();
      if (!(a.norm() > 1e-9) || !(b.norm() > 1e-9)) return std::nullopt;  // nothing moved
      fit.scale = b.norm() / a.norm();
      continue;
    }
    const Eigen::Matrix4d matrix = Eigen::umeyama(columns(from), columns(to), true);
    fit.scale = matrix.col(0).head<3>().norm();
    fit.rotation = matrix.topLeftCorner<3, 3>() / fit.scale;
    fit.shift = matrix.topRightCorner<3, 1>();
  }
  return fit;
}

// Bilinear; NaN beside an unknown value and outside.
double Sample(const DepthMap& map, const glm::dvec2& at) {
  const int x = static_cast<int>(std::floor(at.x)), y = static_cast<int>(std::floor(at.y));
  if (!(at.x >= 0 && at.y >= 0) || x + 1 >= map.width || y + 1 >= map.height)
    return std::numeric_limits<double>::quiet_NaN();
  const double f = at.x - x, g = at.y - y;
  return (1 - g) * ((1 - f) * map.at(x, y) + f * map.at(x + 1, y)) +
         g * ((1 - f) * map.at(x, y + 1) + f * map.at(x + 1, y + 1));
}

}  // namespace

Vector3d TrueSurface::Direction(int x, int y) const {
  const glm::dvec3 d = DirectionFromPixel(projection, {x, y});
  return {d.x, d.y, d.z};
}

TrueSurface SurfaceOf(const CavityTruth& truth) {
  TrueSurface surface;
  surface.projection.type = ProjectionType::kEquirectangular;
  surface.projection.px_per_deg = kPxPerDeg;
  surface.projection.centre_px = {(kSide - 1) / 2.0, (kSide - 1) / 2.0};
  surface.radius = DepthMap(kSide, kSide);
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) {
      const Vector3d direction = surface.Direction(x, y);
      surface.radius.at(x, y) = static_cast<float>(truth.radius(direction));
      int frames = 0;
      for (std::size_t i = 0; i < truth.poses.size(); ++i) frames += Sees(truth, i, direction);
      surface.seen_by.push_back(static_cast<std::uint8_t>(std::min(frames, 255)));
    }
  return surface;
}

std::optional<FoundSurface> SurfaceOf(const authoring::ReliefResult& result,
                                      const CavityTruth& truth, const TrueSurface& surface) {
  const auto fit = TrueFromFound(result.report, truth);
  if (!fit || result.relief.empty()) return std::nullopt;
  FoundSurface found{DepthMap(kSide, kSide, kUnknown), DepthMap()};
  if (!result.sigma.empty()) found.sigma = found.radius;
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) {
      const Vector3d direction = surface.Direction(x, y);
      // The portals lie a little apart, so the direction in the other frame depends on the radius.
      double radius = static_cast<double>(surface.radius.at(x, y)), sigma = 0;
      for (int round = 0; round < 6 && std::isfinite(radius); ++round) {
        const Vector3d local =
            fit->rotation.transpose() * (radius * direction - fit->shift) / fit->scale;
        const auto pixel =
            PixelFromDirection(result.report.projection, {local.x(), local.y(), local.z()});
        const double h = pixel ? Sample(result.relief, *pixel) : kUnknown;
        sigma = pixel && !result.sigma.empty() ? Sample(result.sigma, *pixel) * fit->scale : 0;
        const Vector3d there =
            fit->scale * (fit->rotation * ((result.report.radius - h) * local.normalized())) +
            fit->shift;
        radius = direction.dot(there);
      }
      found.radius.at(x, y) = static_cast<float>(radius);
      if (!found.sigma.empty()) found.sigma.at(x, y) = static_cast<float>(sigma);
    }
  return found;
}

PanoramaPlaces PlacesOf(const authoring::PanoramaReport& report, const CavityTruth& truth,
                        const TrueSurface& surface) {
  constexpr double kNowhere = std::numeric_limits<double>::quiet_NaN();
  PanoramaPlaces places;
  const authoring::PinholeView& view = report.rectified;
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) {
      const Vector3d direction = surface.Direction(x, y);
      const Vector3d point = static_cast<double>(surface.radius.at(x, y)) * direction;
      std::vector<glm::dvec2> shown;
      glm::dvec2 mean(0.0);
      for (const authoring::FrameReport& frame : report.frames) {
        const auto i = static_cast<std::size_t>(frame.index);
        if (!frame.is_placed || i >= truth.poses.size() || !Sees(truth, i, direction)) continue;
        const Vector3d c = truth.poses[i].InCamera(point);
        const double u = view.cx + view.focal_px * c.x() / c.z(),
                     v = view.cy + view.focal_px * c.y() / c.z();
        const auto& m = frame.panorama_from_rectified;
        const double w = m[6] * u + m[7] * v + m[8];
        shown.push_back({(m[0] * u + m[1] * v + m[2]) / w, (m[3] * u + m[4] * v + m[5]) / w});
        mean += shown.back();
      }
      if (shown.size() < 2) {
        places.pixel.push_back({kNowhere, kNowhere});
        places.spread.push_back(kNowhere);
        continue;
      }
      mean /= static_cast<double>(shown.size());
      double spread = 0;
      for (const glm::dvec2& at : shown) spread += std::hypot(at.x - mean.x, at.y - mean.y);
      places.pixel.push_back(mean);
      places.spread.push_back(spread / static_cast<double>(shown.size()));
    }
  return places;
}

FoundSurface SurfaceOf(const DepthMap& depth, const PanoramaPlaces& places,
                       const TrueSurface& surface) {
  FoundSurface found{DepthMap(kSide, kSide, kUnknown), DepthMap()};
  double n = 0, sh = 0, sr = 0, shh = 0, shr = 0;
  for (std::size_t i = 0; i < places.pixel.size(); ++i) {
    const double h = std::isfinite(places.pixel[i].x) ? Sample(depth, places.pixel[i]) : kUnknown;
    found.radius.relief[i] = static_cast<float>(h);
    if (!std::isfinite(h) || surface.seen_by[i] < kLeastFrames) continue;
    const double r = static_cast<double>(surface.radius.relief[i]);
    n += 1, sh += h, sr += r, shh += h * h, shr += h * r;
  }
  const double spread = n * shh - sh * sh;
  const double slope = spread > 1e-30 ? (n * shr - sh * sr) / spread : 0,
               base = n > 0 ? (sr - slope * sh) / n : 0;
  for (float& h : found.radius.relief)
    h = static_cast<float>(base + slope * static_cast<double>(h));
  return found;
}

SurfaceScore ScoreSurface(const FoundSurface& found, const TrueSurface& surface) {
  std::vector<double> errors, is, should;
  double seen = 0, squares = 0, right = 0;
  for (std::size_t i = 0; i < found.radius.relief.size(); ++i) {
    if (surface.seen_by[i] < kLeastFrames) continue;
    ++seen;
    const double r = static_cast<double>(found.radius.relief[i]),
                 truth = static_cast<double>(surface.radius.relief[i]);
    if (!std::isfinite(r)) continue;
    errors.push_back(std::abs(r - truth));
    squares += (r - truth) * (r - truth);
    right += errors.back() < 1e-3 ? 1 : 0;
    is.push_back(r);
    should.push_back(truth);
  }
  SurfaceScore score;
  score.rmse = score.median = score.within_1mm = score.spearman =
      std::numeric_limits<double>::quiet_NaN();
  if (errors.empty() || seen == 0) return score;
  const auto count = static_cast<double>(errors.size());
  score.coverage = count / seen;
  score.rmse = std::sqrt(squares / count);
  score.within_1mm = right / count;
  score.spearman = RankCorrelation(is, should);
  const auto middle = errors.begin() + static_cast<std::ptrdiff_t>(errors.size() / 2);
  std::nth_element(errors.begin(), middle, errors.end());
  score.median = *middle;
  return score;
}

}  // namespace arthro::test
