#include "tests/support/relief/surface_score.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

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
  const auto fit = FitCameras(result.report.frames, truth.poses);
  if (!fit || result.relief.empty()) return std::nullopt;
  FoundSurface found{DepthMap(kSide, kSide, kUnknown), DepthMap()};
  if (!result.sigma.empty()) found.sigma = found.radius;
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) {
      const Vector3d direction = surface.Direction(x, y);
      // The portals lie a little apart, so the direction in the other frame depends on the radius.
      double radius = static_cast<double>(surface.radius.at(x, y)), sigma = 0;
      for (int round = 0; round < 6 && std::isfinite(radius); ++round) {
        const Vector3d local = fit->Found(radius * direction);
        const auto pixel =
            PixelFromDirection(result.report.projection, {local.x(), local.y(), local.z()});
        const double h = pixel ? Sample(result.relief, *pixel) : kUnknown;
        sigma = pixel && !result.sigma.empty() ? Sample(result.sigma, *pixel) * fit->scale : 0;
        const Vector3d there = fit->True((result.report.radius - h) * local.normalized());
        radius = direction.dot(there);
      }
      found.radius.at(x, y) = static_cast<float>(radius);
      if (!found.sigma.empty()) found.sigma.at(x, y) = static_cast<float>(sigma);
    }
  return found;
}

FoundSurface SurfaceOf(const std::vector<Vector3d>& points, const CameraFit& fit,
                       const TrueSurface& surface) {
  FoundSurface found{DepthMap(kSide, kSide, kUnknown), DepthMap()};
  std::map<std::size_t, std::vector<double>> by_cell;
  for (const Vector3d& point : points) {
    const Vector3d there = fit.True(point);
    const auto pixel = PixelFromDirection(surface.projection, {there.x(), there.y(), there.z()});
    if (!pixel) continue;
    const auto x = std::lround(pixel->x), y = std::lround(pixel->y);
    if (x < 0 || y < 0 || x >= kSide || y >= kSide) continue;
    by_cell[static_cast<std::size_t>(y * kSide + x)].push_back(there.norm());
  }
  for (auto& [cell, radii] : by_cell) {
    const auto middle = radii.begin() + static_cast<std::ptrdiff_t>(radii.size() / 2);
    std::nth_element(radii.begin(), middle, radii.end());
    found.radius.relief[cell] = static_cast<float>(*middle);
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
