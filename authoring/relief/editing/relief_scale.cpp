#include "authoring/relief/editing/relief_scale.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "simulation/core/error.h"
#include "simulation/core/units.h"

namespace arthro::authoring {
namespace {

constexpr double kShortest = 0.5e-3, kLongest = 0.2;  // m, of a length inside a joint
constexpr double kMostFactor = 10;          // a joint is neither a tenth nor ten times as large
constexpr double kMostRelativeSigma = 0.2;  // share of the distance between the two points
// Relative error of a click and of the length itself, which no reading knows.
constexpr double kClickSigma = 0.02;

ReliefReading MeasuredAt(const ReliefView& view, const glm::dvec2& pixel, const char* which) {
  const ReliefReading reading = ReadRelief(view, pixel);
  const bool is_guessed = !view.origin.empty() && reading.origin != ReliefOrigin::kMeasured;
  if (!std::isfinite(reading.range) || is_guessed)
    throw Error(Code::kBadArgument,
                fmt::format("nothing was measured at the {} point; choose two points in the part "
                            "that the map shows as measured",
                            which));
  return reading;
}

}  // namespace

ScalePart ScaleFromLength(const ReliefView& view, const KnownLength& known) {
  if (!(known.metres >= kShortest && known.metres <= kLongest))
    throw Error(
        Code::kBadArgument,
        fmt::format("a length of {:g} mm does not fit into a joint; give one from {:g} to "
                    "{:g} mm",
                    MmFromMetres(known.metres), MmFromMetres(kShortest), MmFromMetres(kLongest)));
  const ReliefReading a = MeasuredAt(view, known.from, "first");
  const ReliefReading b = MeasuredAt(view, known.to, "second");
  const double distance = glm::distance(a.point, b.point);
  if (!(distance > 0))
    throw Error(Code::kBadArgument, "the two points are the same; choose two that differ");

  // Only the part of a range's error that lies along the connection changes the distance.
  const glm::dvec3 along = (b.point - a.point) / distance;
  const auto error_of = [&](const ReliefReading& reading) {
    return std::isfinite(reading.sigma)
               ? reading.sigma * glm::dot(reading.point, along) / reading.range
               : 0.0;
  };
  const double sigma = std::hypot(error_of(a), error_of(b));
  if (sigma > kMostRelativeSigma * distance)
    throw Error(Code::kBadArgument,
                fmt::format("the two points are {:.1f} ± {:.1f} mm apart, which is too uncertain; "
                            "choose two points that are further apart",
                            MmFromMetres(distance), MmFromMetres(sigma)));
  const double factor = known.metres / distance;
  if (factor > kMostFactor || factor * kMostFactor < 1)
    throw Error(Code::kBadArgument,
                fmt::format("the two points are {:.1f} mm apart now, and {:g} mm would change the "
                            "scene by a factor of {:.3g}; check the length and the points",
                            MmFromMetres(distance), MmFromMetres(known.metres), factor));
  return {"length", known.metres, factor, std::hypot(sigma / distance, kClickSigma)};
}

DepthMap ScaledMap(const DepthMap& map, double factor) {
  DepthMap scaled = map;
  for (float& value : scaled.relief)
    value = static_cast<float>(factor * static_cast<double>(value));
  return scaled;
}

}  // namespace arthro::authoring
