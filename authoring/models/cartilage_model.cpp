#include "authoring/models/cartilage_model.h"

#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

#include "authoring/phantom/shape/disc_layer.h"
#include "authoring/tissue/surface/surface_topology.h"
#include "simulation/core/option_fields.h"
#include "simulation/core/units.h"

namespace arthro::authoring {
namespace {

bool IsCondyle(CartilageSite site) {
  return site == CartilageSite::kMedialCondyle || site == CartilageSite::kLateralCondyle;
}
bool IsMedial(CartilageSite site) {
  return site == CartilageSite::kMedialCondyle || site == CartilageSite::kMedialPlateau;
}

// Bone under the cartilage. u and v are shares of half the width and half the length.
glm::dvec3 BoneAt(const CartilageOptions& options, double u, double v) {
  const double x = 0.5 * options.width * u, y = 0.5 * options.length * v;
  switch (options.site) {
    case CartilageSite::kMedialCondyle:
    case CartilageSite::kLateralCondyle: {
      // An ellipse in the sagittal plane, up to 70° to either side, and a circle across it.
      constexpr double kReach = RadiansFromDegrees(70), kFlatness = 0.72, kAcross = 22 * kMm;
      const double a = 0.5 * options.length / std::sin(kReach), b = kFlatness * a;
      const double angle = kReach * v, sine = std::sin(angle), cosine = std::cos(angle);
      const glm::dvec3 outwards = glm::normalize(glm::dvec3(0, b * sine, a * cosine));
      return glm::dvec3(x, a * sine, b * (cosine - 1.0)) - x * x / (2.0 * kAcross) * outwards;
    }
    case CartilageSite::kMedialPlateau:  // a shallow dish
      return {x, y, x * x / (120 * kMm) + y * y / (160 * kMm)};
    case CartilageSite::kLateralPlateau:  // hollow across, round from front to back
      return {x, y, x * x / (140 * kMm) - y * y / (100 * kMm)};
    case CartilageSite::kPatella: {
      // Two facets at a ridge, 54 % of the width from the lateral border (Bone and Joint Journal
      // 95-B, supplement 14, SAOA2012-046).
      constexpr double kRidge = 0.04, kRound = 0.22;
      const double slope = std::tan(RadiansFromDegrees(24));
      const double from_ridge = u - 2 * kRidge;
      const double away = std::sqrt(from_ridge * from_ridge + kRound * kRound) - kRound;
      return {x, y, -0.5 * options.width * slope * away - y * y / (200 * kMm)};
    }
  }
  return {x, y, 0};
}

glm::dvec3 OutwardsAt(const CartilageOptions& options, double u, double v) {
  constexpr double kStep = 1e-4;
  const glm::dvec3 along_u = BoneAt(options, u + kStep, v) - BoneAt(options, u - kStep, v);
  const glm::dvec3 along_v = BoneAt(options, u, v + kStep) - BoneAt(options, u, v - kStep);
  return glm::normalize(glm::cross(along_u, along_v));
}

// Thickness as a share of its middle: even within, thinner in the outer third of the way to the
// border; thickest along the ridge of the patella.
double ThicknessShare(const CartilageOptions& options, double share, double u) {
  constexpr double kBorder = 0.45;
  const double edge = std::pow(share, 6);
  const double ridge =
      options.site == CartilageSite::kPatella ? 0.35 * std::exp(-(u * u) / (0.35 * 0.35)) : 0.0;
  return (1.0 + ridge) * (1.0 - (1.0 - kBorder) * edge);
}

// Outline between an ellipse and a rectangle.
double OutlineAt(double angle) {
  constexpr double kPower = 2.5;
  return std::pow(
      std::pow(std::abs(std::cos(angle)), kPower) + std::pow(std::abs(std::sin(angle)), kPower),
      -1.0 / kPower);
}

SurfaceMesh LayerOf(const CartilageOptions& options, double middle_thickness) {
  constexpr int kRings = 20;
  return DiscLayer(kRings, 1.0, [&](double share, double angle, bool is_top) {
    const double reach = share * OutlineAt(angle);
    const double u = reach * std::cos(angle), v = reach * std::sin(angle);
    const glm::dvec3 bone = BoneAt(options, u, v);
    if (!is_top) return bone;
    return bone + middle_thickness * ThicknessShare(options, share, u) * OutwardsAt(options, u, v);
  });
}

// Volume over the area of the bone's side, whose triangles come second and alternate with the
// top's.
double MeanThickness(const SurfaceMesh& layer) {
  const int side = static_cast<int>(layer.vertices.size()) / 2;
  double area = 0;
  for (const auto& [a, b, c] : layer.triangles) {
    if ((a < side) != (b < side) || (a < side) != (c < side)) continue;
    area += 0.5 * glm::length(glm::cross(layer.vertices[b] - layer.vertices[a],
                                         layer.vertices[c] - layer.vertices[a]));
  }
  return SignedVolume(layer.vertices, layer.triangles) / (0.5 * area);
}

// Balls under the bone's side that reach into the layer by half a millimetre.
std::vector<Ball> HoldsUnder(const CartilageOptions& options) {
  constexpr double kRadius = 5 * kMm, kReach = 0.5 * kMm;
  std::vector<Ball> fixed;
  for (const auto& [count, share] : {std::pair{1, 0.0}, std::pair{6, 0.45}, std::pair{12, 0.85}})
    for (int i = 0; i < count; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / count, reach = share * OutlineAt(angle);
      const double u = reach * std::cos(angle), v = reach * std::sin(angle);
      fixed.push_back(
          {BoneAt(options, u, v) - (kRadius - kReach) * OutwardsAt(options, u, v), kRadius});
    }
  return fixed;
}

}  // namespace

const CartilageSizes& PublishedSizesOf(CartilageSite site) {
  switch (site) {
    case CartilageSite::kMedialCondyle:
      return kMedialCondyleSizes;
    case CartilageSite::kLateralCondyle:
      return kLateralCondyleSizes;
    case CartilageSite::kMedialPlateau:
      return kMedialPlateauSizes;
    case CartilageSite::kLateralPlateau:
      return kLateralPlateauSizes;
    case CartilageSite::kPatella:
      break;
  }
  return kPatellaSizes;
}

CartilageOptions::CartilageOptions(CartilageSite its_site) : site(its_site) {
  const CartilageSizes& sizes = PublishedSizesOf(site);
  length = sizes.length.mean;
  width = sizes.width.mean;
  thickness = sizes.thickness.mean;
}

LibraryModel MakeCartilageModel(const CartilageOptions& options, KneeSide side) {
  CartilageOptions checked = options;
  CheckOptions(checked);
  LibraryModel model;
  model.name = options.site == CartilageSite::kPatella
                   ? std::string("patellar cartilage")
                   : std::string(IsMedial(options.site) ? "medial " : "lateral ") +
                         (IsCondyle(options.site) ? "condyle cartilage" : "plateau cartilage");
  model.material = "cartilage";
  model.colour = {0.86, 0.85, 0.80};
  // The mean thickness grows nearly linearly with that of the middle.
  double middle = options.thickness;
  for (int round = 0; round < 3; ++round)
    middle *= options.thickness / MeanThickness(LayerOf(options, middle));
  model.surface = LayerOf(options, middle);
  model.fixed = HoldsUnder(options);
  glm::dvec3 low(1e9), high(-1e9);
  for (const glm::dvec3& x : model.surface.vertices) {
    low = glm::min(low, x);
    high = glm::max(high, x);
  }
  const CartilageSizes& published = PublishedSizesOf(options.site);
  model.sizes = {{high.y - low.y, &published.length},
                 {high.x - low.x, &published.width},
                 {MeanThickness(model.surface), &published.thickness}};
  // The wider facet of the patella is the lateral one; it is made at negative x of a right knee.
  if ((side == KneeSide::kLeft) !=
      (options.site != CartilageSite::kPatella && !IsMedial(options.site)))
    Mirror(model);
  return model;
}

}  // namespace arthro::authoring
