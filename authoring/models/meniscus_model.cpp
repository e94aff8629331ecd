#include "authoring/models/meniscus_model.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include <glm/geometric.hpp>

#include "authoring/models/crescent_sections.h"
#include "authoring/phantom/shape/crescent_skin.h"
#include "simulation/core/option_fields.h"
#include "simulation/core/units.h"

namespace arthro::authoring {
namespace {

// Angle at which the horns are measured: their full width, before they taper to the roots.
constexpr double kHornAngle = 85.0 * kRadianPerDegree;
constexpr double kEdge = MetresFromMm(0.6);  // thickness of the free edge
constexpr double kBulge = 0.16;              // RimBulge at half the height, per height
constexpr double kTopShare = 0.93;           // largest TopOf per height of the wedge

glm::dvec3 OnLevelGround(double angle, double r, double lift) {
  return {r * std::cos(angle), r * std::sin(angle), lift};
}

// Returns x in [low, high] at which a growing function is 0; a limit where it has no zero.
double Bisect(double low, double high, const std::function<double(double)>& growing) {
  constexpr int kHalvings = 60;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    (growing(middle) < 0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

double ExtentInX(const Crescent& c) {
  double least = 0;
  constexpr int kSteps = 64;
  for (int i = 0; i <= kSteps; ++i) {
    const double angle = c.from + (c.to - c.from) * i / kSteps;
    least = std::min(least, OuterRadius(c, angle) * std::cos(angle));
  }
  return c.outer_x + kBulge * c.body_height - least;
}

double HornDistance(const Crescent& c) {
  const auto middle = [&](double angle) {
    return OnLevelGround(angle, OuterRadius(c, angle) - 0.5 * WedgeAt(c, angle).width, 0);
  };
  return glm::distance(middle(c.from), middle(c.to));
}

// Ball whose surface passes through the middle of a section, at right angles to the crescent: its
// inside is the crescent beyond the section.
Ball BallBeyond(const Crescent& c, double angle, bool is_anterior) {
  constexpr double kRadius = MetresFromMm(16);
  const double r = OuterRadius(c, angle) - 0.5 * WedgeAt(c, angle).width;
  const glm::dvec3 along(-std::sin(angle), std::cos(angle), 0);
  return {OnLevelGround(angle, r, 0.3 * c.body_height) + (is_anterior ? -kRadius : kRadius) * along,
          kRadius};
}

std::vector<MeasuredSize> MeasuredSizes(const SurfaceMesh& surface, const Crescent& c,
                                        const MeniscusSizes& published) {
  glm::dvec3 low(1e9), high(-1e9);
  for (const glm::dvec3& x : surface.vertices) {
    low = glm::min(low, x);
    high = glm::max(high, x);
  }
  const CrescentSections sections(surface, {});
  const CrescentSection anterior = sections.At(-kHornAngle), body = sections.At(0),
                        posterior = sections.At(kHornAngle);
  return {{high.y - low.y, &published.length},
          {high.x - low.x, &published.width},
          {HornDistance(c), &published.horn_distance},
          {sections.BorderLength(c.from, c.to, true), &published.outer_border},
          {sections.BorderLength(c.from, c.to, false), &published.inner_border},
          {anterior.outer - anterior.inner, &published.anterior_width},
          {body.outer - body.inner, &published.body_width},
          {posterior.outer - posterior.inner, &published.posterior_width},
          {anterior.high - anterior.low, &published.anterior_height},
          {body.high - body.low, &published.body_height},
          {posterior.high - posterior.low, &published.posterior_height}};
}

void NameParts(const Crescent& c, const std::vector<double>& rims, LibraryModel& model) {
  model.thirds.names = {"anterior horn", "body", "posterior horn"};
  model.zones.names = {"red-red zone", "red-white zone", "white-white zone"};
  // Rim widths of the zones in the classification of meniscal tears by ISAKOS: below 3 mm, 3 to 5
  // mm, above 5 mm.
  constexpr double kRed = MetresFromMm(3), kWhite = MetresFromMm(5);
  const double third = (c.to - c.from) / 3;
  for (std::size_t i = 0; i < model.surface.vertices.size(); ++i) {
    const glm::dvec3& x = model.surface.vertices[i];
    const double angle = std::atan2(x.y, x.x);
    model.thirds.of_vertex.push_back(angle < c.from + third ? 0 : angle < c.to - third ? 1 : 2);
    const double from_rim = (1.0 - rims[i]) * WedgeAt(c, std::clamp(angle, c.from, c.to)).width;
    model.zones.of_vertex.push_back(from_rim < kRed ? 0 : from_rim < kWhite ? 1 : 2);
  }
  model.regions = {{"anterior horn", BallBeyond(c, c.from + third, true)},
                   {"posterior horn", BallBeyond(c, c.to - third, false)},
                   {"body", {glm::dvec3(0), 1.2 * std::max(c.outer_x, c.outer_y)}}};
}

}  // namespace

MeniscusOptions::MeniscusOptions(Compartment its_compartment) : compartment(its_compartment) {
  const MeniscusSizes& sizes = PublishedSizesOf(compartment);
  length = sizes.length.mean;
  width = sizes.width.mean;
  horn_distance = sizes.horn_distance.mean;
  anterior_width = sizes.anterior_width.mean;
  body_width = sizes.body_width.mean;
  posterior_width = sizes.posterior_width.mean;
  anterior_height = sizes.anterior_height.mean;
  body_height = sizes.body_height.mean;
  posterior_height = sizes.posterior_height.mean;
}

Crescent CrescentOf(const MeniscusOptions& options) {
  Crescent c;
  c.film = 0;
  c.edge = kEdge;
  c.anterior_height = options.anterior_height / kTopShare;
  c.body_height = options.body_height / kTopShare;
  c.posterior_height = options.posterior_height / kTopShare;
  const auto wedge_width = [](double width, double height) {
    return width - kBulge * height - 0.45 * kEdge;
  };
  c.anterior_width = wedge_width(options.anterior_width, c.anterior_height);
  c.body_width = wedge_width(options.body_width, c.body_height);
  c.posterior_width = wedge_width(options.posterior_width, c.posterior_height);
  c.outer_y = 0.5 * (options.length - kBulge * (c.anterior_height + c.posterior_height));
  // The horns end where their distance is as wished, and the radius to the side follows.
  constexpr double kLeastTurn = RadiansFromDegrees(15), kMostTurn = RadiansFromDegrees(75);
  const auto with_ends = [&](double turn) {
    Crescent at = c;
    at.from = -(kQuarterTurn + turn);
    at.to = kQuarterTurn + turn;
    at.outer_x = Bisect(0.4 * options.width, options.width, [&](double radius) {
      at.outer_x = radius;
      return ExtentInX(at) - options.width;
    });
    return at;
  };
  return with_ends(Bisect(kLeastTurn, kMostTurn, [&](double turn) {
    return options.horn_distance - HornDistance(with_ends(turn));
  }));
}

LibraryModel MakeMeniscusModel(const MeniscusOptions& options, KneeSide side) {
  MeniscusOptions checked = options;
  CheckOptions(checked);
  const bool is_medial = options.compartment == Compartment::kMedial;
  const Crescent c = CrescentOf(options);
  LibraryModel model;
  model.name = std::string(is_medial ? "medial" : "lateral") + " meniscus";
  model.material = "meniscus";
  model.colour = {0.78, 0.70, 0.57};
  const CrescentGround ground = OnLevelGround;
  CrescentSkin skin = SkinOf(c, ground);
  model.surface = std::move(skin.surface);
  model.fixed = HoldsOf(
      c, [&](double angle, double q, double t) { return PlaceInCrescent(c, ground, angle, q, t); });
  NameParts(c, skin.rims, model);
  model.sizes = MeasuredSizes(model.surface, c, PublishedSizesOf(options.compartment));
  // The crescent opens away from x: it is the medial one of the right knee.
  if (is_medial == (side == KneeSide::kLeft)) Mirror(model);
  return model;
}

}  // namespace arthro::authoring
