#include "authoring/phantom/shape/plateau.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

#include "authoring/phantom/shape/noise.h"
#include "simulation/core/units.h"

namespace arthro::authoring {
namespace {

// Noise channels: each draws its own values from the plateau's seed.
enum PlateauNoise : std::uint32_t { kSlopeLobules = 201, kWallLumps = 202 };

constexpr double kRollFrom = 0.9;  // share of the way to the rim from which the plateau rolls off
// Shares of the way to the rim between which fat covers the front slope.
constexpr double kLobuleFrom = 0.86, kLobuleTo = 1.04;

double RollOff(const Plateau& plateau, double x, double y) {
  const double past = RimShare(plateau, x, y) - kRollFrom;
  return past > 0.0 ? plateau.roll_off * past * past : 0.0;
}

// Distance from an axis-parallel ellipse along the ray from its centre; negative inside.
double EllipseDistance(const glm::dvec2& from_centre, const glm::dvec2& radii) {
  const double share = glm::length(from_centre / radii), r = glm::length(from_centre);
  return share > 1e-9 ? r * (1.0 - 1.0 / share) : -std::min(radii.x, radii.y);
}

double AngleAbout(const glm::dvec2& d) {
  const double angle = std::atan2(d.y, d.x);
  return angle < -0.5 * std::numbers::pi ? angle + 2.0 * std::numbers::pi : angle;
}

double HiatusShare(const CapsuleBorder& border, double x, double y) {
  constexpr double kHalfAngle = 0.26;  // rad
  const glm::dvec2 d(x - border.lateral_x, y - border.medial.y);
  if (d.y <= 0.0) return 0.0;
  const double off = (AngleAbout(d) - border.hiatus_angle) / kHalfAngle;
  return std::exp(-off * off);
}

struct Wall {
  double distance, height;  // outward distance from the wall's foot; full height of the wall there
};
Wall WallAt(const CapsuleBorder& border, double x, double y) {
  const glm::dvec2 d = glm::dvec2(x, y) - border.medial;
  const double hiatus = border.hiatus_depth * HiatusShare(border, x, y);
  if (d.x >= 0.0) {
    constexpr double kFrontAngle = -0.8, kSideAngle = -0.1;  // rad, between front and full wall
    const double full = SmoothStep(kFrontAngle, kSideAngle, std::atan2(d.y, d.x));
    return {EllipseDistance(d, border.medial_radii) - hiatus,
            border.front_height + full * (border.height - border.front_height)};
  }
  if (x >= border.lateral_x) {
    constexpr double kFrontEnd = -8.0 * kMm;  // lateral end of the front wall
    return d.y >= 0.0 ? Wall{d.y - border.medial_radii.y - hiatus, border.height}
                      : Wall{-d.y - border.medial_radii.y,
                             border.front_height * SmoothStep(kFrontEnd, 0.0, d.x)};
  }
  const glm::dvec2 radii(border.lateral_radius, border.medial_radii.y);
  return {EllipseDistance({x - border.lateral_x, d.y}, radii) - hiatus,
          border.height * SmoothStep(-0.1, 0.5, d.y / radii.y)};
}

double WallHeight(const Plateau& plateau, double x, double y) {
  const Wall wall = WallAt(plateau.border, x, y);
  if (wall.distance <= 0.0 || wall.height <= 0.0) return 0.0;
  const double lumps =
      GradientNoise(glm::dvec3(x, y, 0.0) / (4.0 * kMm), plateau.seed + kWallLumps);
  // Beyond the steep part the wall rises on towards the capsule, and the rim does not roll off.
  constexpr double kBeyond = 0.6;  // slope
  const double full = wall.height / plateau.border.height;
  return wall.height * (1.0 + 0.18 * lumps) *
             (1.0 - std::exp(-wall.distance / plateau.border.reach)) +
         full * full *
             (kBeyond * wall.distance +
              RollOff(plateau, x, y) * SmoothStep(0.0, plateau.border.reach, wall.distance));
}

// Place on the lateral meniscus: distance beyond its rim, negative on it, and the share of its
// section that is left beside the horns.
struct OnLateral {
  double distance, section;
  glm::dvec2 along;
};
OnLateral LateralAt(const Plateau& plateau, double x, double y) {
  constexpr double kGap = 1.3 * kMm;  // from rim to capsule
  const glm::dvec2 d(x - plateau.border.lateral_x, y - plateau.border.medial.y);
  const glm::dvec2 radii =
      glm::dvec2(plateau.border.lateral_radius, plateau.border.medial_radii.y) - kGap;
  const double angle = AngleAbout(d);
  constexpr double kBack[] = {0.35, 0.95}, kFront[] = {3.9, 3.4};  // rad; ends of the horns
  return {EllipseDistance(d, radii),
          SmoothStep(kBack[0], kBack[1], angle) * SmoothStep(kFront[0], kFront[1], angle),
          {-std::sin(angle), std::cos(angle)}};
}

double LateralHeight(const Plateau& plateau, const OnLateral& at) {
  const LateralMeniscus& m = plateau.lateral_meniscus;
  if (at.section <= 0.0 || m.width <= 0.0) return 0.0;
  constexpr double kEdgeShare = 0.1;    // thickness of the free edge as a share of the height
  constexpr double kEdge = 0.25 * kMm;  // over which the free edge rounds off
  constexpr double kBack = 0.8 * kMm;   // over which the rim falls to the capsule
  const double width = m.width * (0.45 + 0.55 * at.section), q = 1.0 + at.distance / width;
  if (q < -0.2) return 0.0;
  const double face =
      kEdgeShare * SmoothStep(-kEdge, kEdge, q * width) + 0.9 * std::pow(std::max(q, 0.0), 1.35);
  const double past = std::max(at.distance, 0.0) / kBack;
  return m.height * at.section * std::min(face, 1.0) * std::exp(-past * past);
}

// Place beside a root: share of its length and of its half width.
struct OnRoot {
  double share, aside;
  double height;
};
double Bump(double share) {
  const double left = std::max(1.0 - share * share, 0.0);
  return left * left;
}
OnRoot RootAt(const MeniscalRoot& root, double x, double y) {
  const glm::dvec2 axis = root.to - root.from, d = glm::dvec2(x, y) - root.from;
  const double length = glm::length(axis);
  if (length < 1e-9) return {2.0, 2.0, 0.0};
  const glm::dvec2 along = axis / length;
  const double t = glm::dot(d, along), aside = std::abs(d.x * along.y - d.y * along.x);
  constexpr double kFan = 0.8;          // growth of the width over the root's length
  constexpr double kStart = 1.3 * kMm;  // over which the root rises around the horn
  const double share = t / length;
  const double width = root.half_width * (1.0 + kFan * std::clamp(share, 0.0, 1.0));
  const double profile = SmoothStep(-kStart, 0.3 * kMm, t) * SmoothStep(1.0, 0.05, share);
  return {share, aside / width, root.height * profile * Bump(aside / width)};
}

double TubercleShare(const Tubercle& tubercle, double x, double y) {
  const glm::dvec2 s = (glm::dvec2(x, y) - tubercle.centre) / tubercle.radii;
  const double s2 = glm::dot(s, s);
  return s2 < 16.0 ? std::exp(-s2) : 0.0;
}

}  // namespace

double RimShare(const Plateau& plateau, double x, double y) {
  const double u = x / (x > 0.0 ? plateau.half_width_medial : plateau.half_width_lateral),
               v = y / plateau.half_depth;
  // Rounded box.
  return std::sqrt(std::sqrt(u * u * u * u + v * v * v * v));
}

double BedOutline(const CartilageBed& bed, double angle) {
  return 1.0 + 0.07 * std::cos(2.0 * angle + bed.wobble.x) +
         0.05 * std::cos(3.0 * angle + bed.wobble.y);
}

double BedShare(const CartilageBed& bed, double x, double y) {
  const double u = (x - bed.centre.x) / bed.radii.x, v = (y - bed.centre.y) / bed.radii.y;
  const double r2 = u * u + v * v;
  if (r2 < 1e-12 || r2 > 4.0) return std::sqrt(r2);
  return std::sqrt(r2) / BedOutline(bed, std::atan2(v, u));
}

double BedDepth(const CartilageBed& bed, double share) {
  return bed.depth * SmoothStep(1.0, 1.0 - bed.wall, share);
}

double BoneHeight(const Plateau& plateau, double x, double y, bool with_bed) {
  double z = 0.5 * plateau.curvature_x * x * x + 0.5 * plateau.curvature_y * y * y -
             RollOff(plateau, x, y);
  for (const Tubercle& tubercle : plateau.eminence)
    z += tubercle.height * TubercleShare(tubercle, x, y);
  z += plateau.footprint.height * TubercleShare(plateau.footprint, x, y);
  if (with_bed) {
    const double share = BedShare(plateau.bed, x, y);
    if (share < 1.0) z -= BedDepth(plateau.bed, share);
  }
  return z;
}

double SlopeLobule(const Plateau& plateau, double x, double y) {
  constexpr double kSize = 4.2 * kMm;
  // The third coordinate follows the slope down, so that lobules keep their size on it.
  return LobeNoise(glm::dvec3(x, y, -RollOff(plateau, x, y)) / kSize, plateau.seed + kSlopeLobules);
}

namespace {

double LobuleShare(const Plateau& plateau, double x, double y) {
  return y < 0.0 ? SmoothStep(kLobuleFrom + 0.08, kLobuleTo + 0.15, RimShare(plateau, x, y)) : 0.0;
}

// Height without the capsule's wall and the lobules.
double FloorHeight(const Plateau& plateau, double x, double y, bool with_bed) {
  double z = BoneHeight(plateau, x, y, with_bed) + LateralHeight(plateau, LateralAt(plateau, x, y));
  for (const MeniscalRoot& root : plateau.roots) z += RootAt(root, x, y).height;
  return z;
}

double HeightWithoutWall(const Plateau& plateau, double x, double y, bool with_bed) {
  const double share = LobuleShare(plateau, x, y);
  return FloorHeight(plateau, x, y, with_bed) +
         (share > 0.0 ? plateau.lobule_height * share * SlopeLobule(plateau, x, y) : 0.0);
}

double ClearanceAbove(const Plateau& plateau, const glm::dvec3& x, double floor) {
  constexpr double kLevel = 0.9;  // cosine of the steepest level part
  const Wall wall = WallAt(plateau.border, x.x, x.y);
  if (wall.height <= 0.0) return kLevel * (x.z - floor);
  if (wall.distance <= 0.0)
    return std::min(kLevel * (x.z - floor),
                    std::hypot(wall.distance, std::max(x.z - floor - wall.height, 0.0)));
  const double slope =
      wall.height / plateau.border.reach * std::exp(-wall.distance / plateau.border.reach) +
      wall.height / plateau.border.height;
  return (x.z - floor - WallHeight(plateau, x.x, x.y)) * kLevel / std::hypot(1.0, slope);
}

}  // namespace

double PlateauHeight(const Plateau& plateau, double x, double y, bool with_bed) {
  return HeightWithoutWall(plateau, x, y, with_bed) + WallHeight(plateau, x, y);
}

double PlateauClearance(const Plateau& plateau, const glm::dvec3& x, bool with_bed, double enough) {
  const double floor = FloorHeight(plateau, x.x, x.y, with_bed);
  const double lobules = plateau.lobule_height * LobuleShare(plateau, x.x, x.y);
  const double under_tops = ClearanceAbove(plateau, x, floor + lobules);
  if (lobules == 0.0 || under_tops >= enough) return under_tops;
  return ClearanceAbove(plateau, x, floor + lobules * SlopeLobule(plateau, x.x, x.y));
}

PlateauCover CoverAt(const Plateau& plateau, double x, double y) {
  PlateauCover cover;
  const Wall wall = WallAt(plateau.border, x, y);
  if (wall.height > 0.0)
    cover.capsule = SmoothStep(-0.4 * kMm, 1.0 * kMm, wall.distance) *
                    SmoothStep(0.0, 0.4 * plateau.border.front_height, wall.height);
  cover.hiatus = HiatusShare(plateau.border, x, y) *
                 SmoothStep(-1.0 * kMm, 0.5 * kMm, wall.distance + plateau.border.hiatus_depth);
  const OnLateral lateral = LateralAt(plateau, x, y);
  if (const double height = LateralHeight(plateau, lateral); height > 0.0) {
    cover.fibre = SmoothStep(0.1 * kMm, 0.5 * kMm, height);
    cover.along = lateral.along;
  }
  for (const MeniscalRoot& root : plateau.roots) {
    const OnRoot at = RootAt(root, x, y);
    const double share = SmoothStep(0.02, 0.25, at.height / std::max(root.height, 1e-9));
    if (share <= cover.fibre) continue;
    cover.fibre = share;
    cover.along = glm::normalize(root.to - root.from);
  }
  for (const Tubercle& tubercle : plateau.eminence)
    cover.eminence = std::max(cover.eminence, TubercleShare(tubercle, x, y));
  if (y < 0.0)
    cover.lobule = SmoothStep(kLobuleFrom, kLobuleTo, RimShare(plateau, x, y)) *
                   (1.0 - SmoothStep(0.3, 0.55, wall.height / plateau.border.height));
  return cover;
}

}  // namespace arthro::authoring
