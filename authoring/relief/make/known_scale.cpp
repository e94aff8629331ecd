#include "authoring/relief/make/known_scale.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>
#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "simulation/core/error.h"
#include "simulation/core/units.h"

namespace arthro::authoring {
namespace {

constexpr double kLeastSigma = 0.005;  // sigma of the logarithm; half a percent

float RadiusAt(const SweptSurface& surface, const glm::dvec2& pixel) {
  const int x = static_cast<int>(std::lround(pixel.x)), y = static_cast<int>(std::lround(pixel.y));
  const bool is_inside = x >= 0 && y >= 0 && x < surface.radius.cols && y < surface.radius.rows;
  return is_inside ? surface.radius.at<float>(y, x) : 0;
}

// Point of the surface at a pixel of the relief.
Eigen::Vector3d PointAt(const SweptSurface& surface, const glm::dvec2& pixel) {
  const float radius = RadiusAt(surface, pixel);
  if (!(radius > 0))
    throw Error(Code::kBadArgument,
                fmt::format("nothing was measured at pixel {:g},{:g} of the relief of {} x {} px; "
                            "name two pixels that have a value",
                            pixel.x, pixel.y, surface.radius.cols, surface.radius.rows));
  const glm::dvec3 d = DirectionFromPixel(surface.projection, pixel);
  return Eigen::Vector3d(d.x, d.y, d.z) * static_cast<double>(radius);
}

// Distance from a camera along a ray to the surface; nothing where none was measured.
std::optional<double> RangeAlong(const SweptSurface& surface, const Eigen::Vector3d& centre,
                                 const Eigen::Vector3d& ray) {
  double largest = 0;
  for (int y = 0; y < surface.radius.rows; ++y)
    for (int x = 0; x < surface.radius.cols; ++x)
      largest = std::max<double>(largest, surface.radius.at<float>(y, x));
  constexpr int kSteps = 400;
  const double furthest = centre.norm() + largest;
  bool was_inside = false;
  for (int i = 1; i <= kSteps; ++i) {
    const double range = furthest * i / kSteps;
    const Eigen::Vector3d point = centre + range * ray;
    const double distance = point.norm();
    const auto pixel = PixelFromDirection(surface.projection,
                                          glm::dvec3(point.x(), point.y(), point.z()) / distance);
    const float radius = pixel ? RadiusAt(surface, *pixel) : 0;
    const bool is_known = radius > 0;
    if (is_known && distance >= radius && was_inside) return range;
    was_inside = is_known && distance < radius;
  }
  return std::nullopt;
}

}  // namespace

ScalePart ScaleOf(const KnownLength& length, const SweptSurface& surface) {
  const Eigen::Vector3d from = PointAt(surface, length.from), to = PointAt(surface, length.to);
  const double distance = (from - to).norm();
  if (!(distance > 0))
    throw Error(Code::kBadArgument, "the two pixels of a known length must differ");
  // Each end is named to half a cell.
  const double cell = RadiansFromDegrees(1 / surface.projection.px_per_deg);
  const double off = 0.5 * cell * std::hypot(from.norm(), to.norm());
  return {"length", length.metres, length.metres / distance, std::max(kLeastSigma, off / distance)};
}

ScalePart ScaleOf(const KnownInstrument& instrument, const Lens& lens, const CameraPose& pose,
                  const SweptSurface& surface) {
  const auto ray_at = [&](const glm::dvec2& pixel) {
    const auto ray = RayFromPixel(lens, pixel);
    if (!ray)
      throw Error(Code::kBadArgument,
                  fmt::format("the lens shows nothing at pixel {:g},{:g} of frame {}; name the two "
                              "edges of the instrument inside the round window",
                              pixel.x, pixel.y, instrument.frame));
    return Eigen::Vector3d(ray->x, ray->y, ray->z);
  };
  const Eigen::Vector3d a = ray_at(instrument.from), b = ray_at(instrument.to);
  const double half = 0.5 * std::atan2(a.cross(b).norm(), a.dot(b));
  if (!(half > 0))
    throw Error(Code::kBadArgument, "the two edges of an instrument must be two pixels");
  const auto range =
      RangeAlong(surface, pose.centre, pose.world_from_camera * (a + b).normalized());
  if (!range)
    throw Error(
        Code::kBadArgument,
        fmt::format("nothing was measured behind the instrument at pixel {:g},{:g} of frame "
                    "{}; name a frame in which it touches tissue that was measured",
                    0.5 * (instrument.from.x + instrument.to.x),
                    0.5 * (instrument.from.y + instrument.to.y), instrument.frame));
  // Two planes through the camera touch a cylinder of radius r, whose axis lies r before the
  // tissue: range · factor = r / sin(half the angle) + r.
  const double radius = 0.5 * instrument.metres;
  const double factor = radius * (1 + 1 / std::sin(half)) / *range;
  // Each edge is named to one pixel.
  const double width = glm::length(instrument.to - instrument.from);
  return {"instrument", instrument.metres, factor, std::max(kLeastSigma, std::sqrt(2.0) / width)};
}

}  // namespace arthro::authoring
