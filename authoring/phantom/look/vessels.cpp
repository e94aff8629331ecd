#include "authoring/phantom/look/vessels.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

#include "authoring/phantom/shape/noise.h"
#include "simulation/core/units.h"

namespace arthro::authoring {
namespace {

constexpr double kStep = RadiansFromDegrees(0.45);  // length of one segment
constexpr double kThinnest =
    RadiansFromDegrees(0.06);      // a capillary of 0.04 mm at 40 mm; thinner is not drawn
constexpr int kLongest = 90;       // segments of one branch
constexpr int kGenerations = 6;    // generations of branches
constexpr double kSoftness = 2.2;  // blur of a deep vessel, in radii

// Cells of two degrees over the whole sphere.
constexpr int kWebColumns = 180, kWebRows = 90;

int WebColumn(double longitude) {
  const int column =
      static_cast<int>(std::floor((longitude / (2.0 * std::numbers::pi) + 0.5) * kWebColumns));
  return ((column % kWebColumns) + kWebColumns) % kWebColumns;
}
int WebRow(double latitude) {
  return std::clamp(static_cast<int>(std::floor((latitude / std::numbers::pi + 0.5) * kWebRows)), 0,
                    kWebRows - 1);
}
double LatitudeOfRay(const glm::dvec3& d) { return -std::asin(std::clamp(d.y, -1.0, 1.0)); }

}  // namespace

VesselTrees::VesselTrees(std::uint32_t seed) {
  Random random(0x7E55E1ull + seed);
  // Deep trunks first: few, broad, blurred. Then the sharp network on the surface.
  constexpr int kDeepTrees = 14, kSurfaceTrees = 110;
  constexpr double kLongitude = 115.0, kLatitude = 80.0;  // degrees, limits of the roots
  for (int i = 0; i < kDeepTrees + kSurfaceTrees; ++i) {
    const bool deep = i < kDeepTrees;
    const double longitude = RadiansFromDegrees(random.Uniform(-kLongitude, kLongitude));
    const double latitude = RadiansFromDegrees(random.Uniform(-kLatitude, kLatitude));
    const glm::dvec3 at(std::cos(latitude) * std::sin(longitude), -std::sin(latitude),
                        std::cos(latitude) * std::cos(longitude));
    const glm::dvec3 other(random.Uniform(-1, 1), random.Uniform(-1, 1), random.Uniform(-1, 1));
    const glm::dvec3 heading = glm::normalize(glm::cross(at, other));
    // Radii in degrees of the sphere; depths from 0 on the surface to 1.
    const double radius =
        RadiansFromDegrees(deep ? random.Uniform(0.26, 0.46) : random.Uniform(0.08, 0.21));
    Grow(random.Next(), at, heading, radius,
         deep ? random.Uniform(0.7, 1.0) : random.Uniform(0.0, 0.3), 0);
  }
  Sort();
}

void VesselTrees::Grow(std::uint64_t seed, glm::dvec3 at, glm::dvec3 heading, double radius,
                       double depth, int generation) {
  Random random(seed);
  const auto turned = [&at](const glm::dvec3& from, double angle) {
    return std::cos(angle) * from + std::sin(angle) * glm::cross(at, from);
  };
  constexpr double kMemory = 0.80, kBend = 0.11;       // curvature: memory per step; change, rad
  constexpr double kTaper = 0.962, kStraight = 0.996;  // range of the radius ratio per step
  double curl = 0.0;                                   // rad per step
  int until_branch = static_cast<int>(random.Uniform(5.0, 14.0));  // steps
  for (int step = 0; step < kLongest && radius > kThinnest; ++step) {
    // A vessel meanders: its curvature, not its heading, is random.
    curl = kMemory * curl + random.Uniform(-kBend, kBend);
    heading = turned(heading, curl);
    const glm::dvec3 next = std::cos(kStep) * at + std::sin(kStep) * heading;
    const double thinner = radius * random.Uniform(kTaper, kStraight);
    // A trunk comes up through the tissue; a branch that reaches its greatest length runs out.
    constexpr double kRise = 12.0, kRunOut = 25.0;  // steps
    const double up = generation == 0 ? SmoothStep(0.0, kRise, step + 0.5) : 1.0;
    const double shown = up * SmoothStep(kLongest, kLongest - kRunOut, step);
    segments_.push_back({at, next, radius, thinner, depth + (1.0 - depth) * (1.0 - up), shown});
    heading = glm::normalize(heading - glm::dot(heading, next) * next);
    at = next;
    radius = thinner;
    if (--until_branch > 0 || generation >= kGenerations) continue;
    // The cube of a radius is the sum of the cubes of its branches' radii [Murray 1926].
    const double share = random.Uniform(0.18, 0.5);
    const double side = random.Uniform(0.0, 1.0) < 0.5 ? -1.0 : 1.0;
    const double angle = random.Uniform(0.4, 0.95);  // rad between the smaller branch and the trunk
    Grow(random.Next(), at, turned(heading, side * angle), radius * std::cbrt(share), depth,
         generation + 1);
    heading = turned(heading, -side * angle * share * 0.6);
    radius *= std::cbrt(1.0 - share);
    until_branch = static_cast<int>(random.Uniform(4.0, 13.0));
  }
}

void VesselTrees::Sort() {
  cells_.resize(static_cast<std::size_t>(kWebColumns) * kWebRows);
  for (std::size_t i = 0; i < segments_.size(); ++i) {
    const VesselSegment& s = segments_[i];
    const double reach = 0.5 * kStep + kSoftness * s.from_radius + 0.01;
    const glm::dvec3 middle = glm::normalize(s.from + s.to);
    const double latitude = LatitudeOfRay(middle), longitude = std::atan2(middle.x, middle.z);
    const double widest = std::max(std::abs(latitude - reach), std::abs(latitude + reach));
    const double stretch = std::cos(std::min(widest, 1.55));
    const double across = std::min(reach / std::max(stretch, 0.05), std::numbers::pi);
    const int row_from = WebRow(latitude - reach), row_to = WebRow(latitude + reach);
    const int columns = std::min(
        static_cast<int>(std::ceil(2.0 * across / (2.0 * std::numbers::pi) * kWebColumns)) + 1,
        kWebColumns);
    const int column_from = WebColumn(longitude - across);
    for (int row = row_from; row <= row_to; ++row)
      for (int k = 0; k < columns; ++k)
        cells_[static_cast<std::size_t>(row) * kWebColumns + (column_from + k) % kWebColumns]
            .push_back(static_cast<std::uint32_t>(i));
  }
}

VesselTrees::Cover VesselTrees::At(const glm::dvec3& d) const {
  const auto& cell = cells_[static_cast<std::size_t>(WebRow(LatitudeOfRay(d))) * kWebColumns +
                            WebColumn(std::atan2(d.x, d.z))];
  Cover cover;
  for (const std::uint32_t index : cell) {
    const VesselSegment& s = segments_[index];
    const glm::dvec3 along = s.to - s.from;
    const double t = std::clamp(glm::dot(d - s.from, along) / glm::dot(along, along), 0.0, 1.0);
    const double distance = glm::length(d - s.from - t * along);
    const double radius = s.from_radius + t * (s.to_radius - s.from_radius);
    const double inner = radius * (0.75 - 0.75 * s.depth),
                 outer = radius * (1.25 + (kSoftness - 1.25) * s.depth);
    if (distance >= outer) continue;
    // Thin vessels are fainter: they hold less blood.
    constexpr double kFaintest = 0.02, kFullRadius = RadiansFromDegrees(0.22);
    const double strength =
        s.strength * std::min(1.0, kFaintest + radius / kFullRadius) * (1.0 - 0.45 * s.depth);
    const double amount = strength * SmoothStep(outer, inner, distance);
    if (amount > cover.amount) cover = {amount, s.depth};
  }
  return cover;
}

}  // namespace arthro::authoring
