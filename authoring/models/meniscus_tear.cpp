#include "authoring/models/meniscus_tear.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>

#include "authoring/models/crescent_sections.h"
#include "simulation/core/error.h"
#include "simulation/core/option_fields.h"
#include "simulation/scene/mesh/crescent_fit.h"

namespace arthro::authoring {
namespace {

constexpr std::array<TearEntry, 6> kTearEntries = {
    {{TearKind::kLongitudinal, "longitudinal", "Longitudinal"},
     {TearKind::kBucketHandle, "bucket-handle", "Bucket handle"},
     {TearKind::kRadial, "radial", "Radial"},
     {TearKind::kFlap, "flap", "Flap"},
     {TearKind::kHorizontal, "horizontal", "Horizontal"},
     {TearKind::kRoot, "root", "Root"}}};

constexpr double kStep = MetresFromMm(1.5);    // between points of a path
constexpr double kBeyond = MetresFromMm(1.0);  // so far a slot goes on outside of the surface
constexpr double kExit = MetresFromMm(1.5);  // from the free edge to the exit of a horizontal tear
constexpr double kMostSweep = RadiansFromDegrees(345);  // a ring without ends is no crescent

// Crescent with its middle, found on a surface.
struct Meniscus {
  CrescentSections sections;
  glm::dvec3 axis;
  double begin, sweep;  // from the horn of position 0; sweep is negative where the angle falls

  double AngleAt(double position) const { return begin + position * sweep; }
  double ShareOf(double angle) const { return std::abs(angle / sweep); }
};

Meniscus FindMeniscus(const SurfaceMesh& surface) {
  constexpr int kBins = 90;
  const auto fit =
      surface.vertices.size() < 12 ? std::nullopt : FitCrescent(surface.vertices, kBins);
  if (!fit || fit->sweep > kMostSweep)
    throw Error(Code::kBadMesh,
                "this surface is no crescent with two ends, so a tear of a meniscus has no place "
                "on it; click a tear instead");
  const PlaneFit& plane = fit->plane;
  const glm::dmat3 axes(plane.across, plane.along, plane.axis);
  const Rigid3 model_from_crescent{glm::normalize(glm::quat_cast(axes)), plane.middle};
  Meniscus meniscus{CrescentSections(surface, model_from_crescent), plane.axis, fit->begin,
                    fit->sweep};
  const double end = fit->begin + fit->sweep;
  if (meniscus.sections.Place(end, fit->radius, 0).y <
      meniscus.sections.Place(fit->begin, fit->radius, 0).y) {
    meniscus.begin = end;
    meniscus.sweep = -fit->sweep;
  }
  return meniscus;
}

[[noreturn]] void Refuse(const std::string& why) {
  throw Error(Code::kBadArgument, "the tear does not fit into this meniscus: " + why);
}

CrescentSection SectionAt(const Meniscus& meniscus, double position) {
  const CrescentSection section = meniscus.sections.At(meniscus.AngleAt(position));
  if (section.is_empty)
    Refuse(fmt::format("nothing lies at position {:.2f}; use one nearer to 0.5", position));
  return section;
}

// Slot through the whole thickness along points given by position and radius.
TearCut Through(const Meniscus& meniscus, const std::vector<std::pair<double, double>>& points,
                double width) {
  TearCut tear;
  double high = -1e9, low = 1e9;
  for (const auto& [position, radius] : points) {
    const CrescentSection section = SectionAt(meniscus, position);
    high = std::max(high, section.high);
    low = std::min(low, section.low);
  }
  for (const auto& [position, radius] : points)
    tear.path.push_back(meniscus.sections.Place(meniscus.AngleAt(position), radius, high));
  tear.into = -meniscus.axis;
  tear.depth = high - low + kBeyond;
  tear.width = width;
  tear.lead = kBeyond;
  return tear;
}

// Positions along a length of the crescent at a radius, in steps of kStep at most.
std::vector<double> PositionsAlong(const Meniscus& meniscus, double from, double length,
                                   double radius) {
  const double share = meniscus.ShareOf(length / radius);
  const int steps = std::max(2, static_cast<int>(std::ceil(length / kStep)));
  std::vector<double> positions;
  for (int i = 0; i <= steps; ++i) positions.push_back(from + share * i / steps);
  constexpr double kEnd = 0.03;  // share at either end in which a tear has no room
  if (positions.front() < kEnd || positions.back() > 1.0 - kEnd)
    Refuse("it is longer than the crescent there; shorten it or move it towards the middle");
  return positions;
}

// Positions and radii of the middle of a longitudinal slot.
std::vector<std::pair<double, double>> LongitudinalPoints(const Meniscus& meniscus,
                                                          const TearOptions& o) {
  const CrescentSection middle = SectionAt(meniscus, o.position);
  const double radius = middle.outer - o.rim_width;
  if (!(radius > middle.inner + MetresFromMm(1)))
    Refuse("its rim is wider than the meniscus; use a smaller rim width");
  const double half = 0.5 * meniscus.ShareOf(o.length / radius);
  std::vector<std::pair<double, double>> points;
  for (const double position : PositionsAlong(meniscus, o.position - half, o.length, radius)) {
    const CrescentSection section = SectionAt(meniscus, position);
    // Near the horns the crescent is narrow: the tear stays off the free edge.
    points.emplace_back(
        position, std::max(section.outer - o.rim_width, 0.5 * (section.inner + section.outer)));
  }
  return points;
}

std::vector<Cut> Longitudinal(const Meniscus& meniscus, const TearOptions& o) {
  return {Through(meniscus, LongitudinalPoints(meniscus, o), o.width)};
}

// From outside of the free edge to a radius.
std::vector<std::pair<double, double>> RadialPoints(const CrescentSection& section, double position,
                                                    double to) {
  std::vector<std::pair<double, double>> points;
  const double from = section.inner - kBeyond;
  const int steps = std::max(1, static_cast<int>(std::ceil((to - from) / kStep)));
  for (int i = 0; i <= steps; ++i) points.emplace_back(position, from + (to - from) * i / steps);
  return points;
}

double ReachAt(const CrescentSection& section, const TearOptions& o) {
  const double reach = section.inner + o.reach;
  if (!(reach < section.outer - MetresFromMm(0.5)))
    Refuse("it reaches through the outer rim; use a smaller reach");
  return reach;
}

std::vector<Cut> Radial(const Meniscus& meniscus, const TearOptions& o) {
  const CrescentSection section = SectionAt(meniscus, o.position);
  return {Through(meniscus, RadialPoints(section, o.position, ReachAt(section, o)), o.width)};
}

std::vector<Cut> Flap(const Meniscus& meniscus, const TearOptions& o) {
  const CrescentSection section = SectionAt(meniscus, o.position);
  const double radius = ReachAt(section, o);
  auto points = RadialPoints(section, o.position, radius);
  for (const double position : PositionsAlong(meniscus, o.position, o.length, radius)) {
    const CrescentSection at = SectionAt(meniscus, position);
    points.emplace_back(position, std::min(at.inner + o.reach, at.outer - MetresFromMm(1)));
  }
  return {Through(meniscus, points, o.width)};
}

// A level slot in the middle of the wedge, which leaves the tibial side beside the free edge: the
// edge itself is thinner than two leaves and a slot. A slot is deep in one direction, so that the
// crescent needs one for each short part of its length; they start at the deep end, where they
// meet, and overlap towards the free edge.
std::vector<Cut> Horizontal(const Meniscus& meniscus, const TearOptions& o) {
  const CrescentSection middle = SectionAt(meniscus, o.position);
  const double radius = ReachAt(middle, o);
  const double half = 0.5 * meniscus.ShareOf(o.length / radius);
  const std::vector<double> positions =
      PositionsAlong(meniscus, o.position - half, o.length, radius);
  std::vector<Cut> cuts;
  for (std::size_t i = 0; i + 1 < positions.size(); ++i) {
    const auto deep_end = [&](double position) {
      const double angle = meniscus.AngleAt(position);
      const CrescentSection section = SectionAt(meniscus, position);
      const double r = std::min(section.inner + o.reach, section.outer - MetresFromMm(1));
      const CrescentSection there = meniscus.sections.At(angle, r);
      return meniscus.sections.Place(angle, r, 0.5 * (there.low + there.high));
    };
    const double between = 0.5 * (positions[i] + positions[i + 1]);
    const double angle = meniscus.AngleAt(between);
    const CrescentSection section = SectionAt(meniscus, between);
    const double exit = section.inner + kExit;
    const glm::dvec3 exit_place =
        meniscus.sections.Place(angle, exit, meniscus.sections.At(angle, exit).low);
    TearCut tear;
    tear.path = {deep_end(positions[i]), deep_end(positions[i + 1])};
    const glm::dvec3 way = exit_place - 0.5 * (tear.path[0] + tear.path[1]);
    tear.into = glm::normalize(way);
    tear.depth = glm::length(way) + kBeyond;
    tear.width = o.width;
    tear.lead = 0;
    cuts.push_back(tear);
  }
  return cuts;
}

std::vector<Cut> Root(const Meniscus& meniscus, const TearOptions& o) {
  const CrescentSection section = SectionAt(meniscus, o.position);
  return {Through(meniscus, RadialPoints(section, o.position, section.outer + kBeyond), o.width)};
}

// Radius of the slot at a position between the ends of its points.
double RadiusAt(const std::vector<std::pair<double, double>>& points, double position) {
  std::size_t i = 1;
  while (i + 1 < points.size() && points[i].first < position) ++i;
  const auto& [from, from_radius] = points[i - 1];
  const auto& [to, to_radius] = points[i];
  return from_radius + (position - from) / (to - from) * (to_radius - from_radius);
}

}  // namespace

SurfaceMesh WithDisplacedHandle(SurfaceMesh torn, const SurfaceMesh& whole,
                                const TearOptions& options) {
  TearOptions checked = options;
  CheckOptions(checked);
  if (options.kind != TearKind::kBucketHandle)
    throw Error(Code::kBadArgument,
                "only the handle of a bucket-handle tear is displaced; leave the displacement out");
  const Meniscus meniscus = FindMeniscus(whole);
  const auto points = LongitudinalPoints(meniscus, options);
  const double begin = points.front().first, end = points.back().first;
  const CrescentSection middle = SectionAt(meniscus, options.position);
  constexpr double kLeft = MetresFromMm(2);  // left of the notch, beyond the free edge
  if (options.displacement > middle.inner - kLeft)
    Refuse(fmt::format("the notch is {:.1f} mm wide there; displace its handle less",
                       MmFromMetres(middle.inner)));
  const double at_middle = meniscus.AngleAt(0.5 * (begin + end));
  // Unit, from the middle of the tear towards the axis of the crescent.
  const glm::dvec3 inwards =
      meniscus.sections.Place(at_middle, 0.0, 0) - meniscus.sections.Place(at_middle, 1.0, 0);
  for (glm::dvec3& x : torn.vertices) {
    const glm::dvec3 flat = meniscus.sections.InCrescent(x);
    const double turn =
        std::remainder(std::atan2(flat.y, flat.x) - at_middle, 2 * std::numbers::pi);
    const double position = 0.5 * (begin + end) + turn / meniscus.sweep;
    if (position <= begin || position >= end) continue;
    if (std::hypot(flat.x, flat.y) >= RadiusAt(points, position)) continue;
    const double rise = std::sin(std::numbers::pi * (position - begin) / (end - begin));
    x += options.displacement * rise * rise * inwards;
  }
  return torn;
}

std::span<const TearEntry> TearEntries() { return kTearEntries; }

TearOptions::TearOptions(TearKind its_kind) : kind(its_kind) {
  position = kind == TearKind::kRoot           ? 0.94
             : kind == TearKind::kRadial       ? 0.62
             : kind == TearKind::kBucketHandle ? 0.58
                                               : 0.70;
  length = MetresFromMm(kind == TearKind::kBucketHandle ? 42 : kind == TearKind::kFlap ? 7 : 16);
  rim_width = MetresFromMm(kind == TearKind::kBucketHandle ? 4 : 3);
  reach = MetresFromMm(kind == TearKind::kHorizontal ? 6 : 5);
}

std::vector<Cut> TearCuts(const SurfaceMesh& surface, const TearOptions& options) {
  TearOptions checked = options;
  CheckOptions(checked);
  const Meniscus meniscus = FindMeniscus(surface);
  switch (options.kind) {
    case TearKind::kLongitudinal:
    case TearKind::kBucketHandle:
      return Longitudinal(meniscus, options);
    case TearKind::kRadial:
      return Radial(meniscus, options);
    case TearKind::kFlap:
      return Flap(meniscus, options);
    case TearKind::kHorizontal:
      return Horizontal(meniscus, options);
    case TearKind::kRoot:
      break;
  }
  return Root(meniscus, options);
}

}  // namespace arthro::authoring
