// Shape of a digital knee: the front of the medial compartment of a right knee, seen through
// the anterolateral portal. Every surface is a closed formula, so that its depth is known exactly.
// Portal frame, m [method.md, Frames]: (+z into the joint, +x to the viewer's right and medial, +y
// down).
//
//   condyle       ellipsoid
//   plateau       height field z = H(x, y) in its own frame (x medial, y posterior, z up): a dish
//                 with a tibial spine, a rim that rolls off, and the bed of the cartilage
//   ligament      bundles of cylinders with round ends
//   capsule, fat  star-shaped about the portal: distance = R(direction), folds and lobes in R
#pragma once

#include <array>
#include <cstdint>

#include <glm/gtc/quaternion.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "simulation/core/frames.h"

namespace arthro::authoring {

enum class Surface : std::uint8_t {
  kCapsule,
  kFat,
  kCondyle,
  kPlateau,
  kLigament,
  kMeniscus,   // only in the picture with the tissues in place
  kCartilage,  // only in the picture with the tissues in place
};

struct Ellipsoid {
  glm::dvec3 centre{0.0}, radii{1.0};
  glm::dquat portal_from_body{1.0, 0.0, 0.0, 0.0};
};

// Place of the cartilage layer in the plateau; plateau frame. The bed is `depth` deep, with walls
// that rise over the outer `wall` share of its radii.
struct CartilageBed {
  glm::dvec2 centre{0.0}, radii{1.0};
  glm::dvec2 wobble{0.0};  // rad; phases of the outline's two- and three-fold waves
  double depth = 0.0, wall = 0.16;
};

struct Plateau {
  Rigid3 portal_from_plateau;
  double curvature_x = 0, curvature_y = 0;  // 1/m, curvature of the dish
  double half_width_medial = 0, half_width_lateral = 0, half_depth = 0;
  double roll_off = 0;  // m per (share past the rim)²
  glm::dvec2 spine{0.0};
  glm::dvec2 spine_radii{1.0};
  double spine_height = 0;
  CartilageBed bed;
};

struct Bundle {
  glm::dvec3 from{0.0}, to{0.0};
  double radius = 0;
};

struct Cavity {
  std::uint32_t seed = 0;
  double radius = 0.05;  // D, radius of the backdrop sphere
  double capsule_side = 0, capsule_front = 0, fold_height = 0;
  double overhang = 0, fat_distance = 0, lobe_height = 0;
  Ellipsoid condyle;
  Plateau plateau;
  std::array<Bundle, 5> ligament;
};

Cavity MakeCavity(std::uint32_t seed);

// Height of the plateau, with and without the bed; plateau frame.
double PlateauHeight(const Plateau& plateau, double x, double y, bool with_bed = true);
// Outline of the bed, as a factor on its radii; `angle` is measured on the point scaled by them.
double BedOutline(const CartilageBed& bed, double angle);
// Share of the bed's radius at a point: 0 in the middle, 1 at the rim.
double BedShare(const CartilageBed& bed, double x, double y);
double BedDepth(const CartilageBed& bed, double share);

// Distances of the two star-shaped surfaces in a unit direction. A direction without fat gives a
// distance behind the capsule.
double CapsuleDistance(const Cavity& cavity, const glm::dvec3& direction);
double FatDistance(const Cavity& cavity, const glm::dvec3& direction);
// Height of the fat's lobules: 0 in the creases between them to 1 on their tops.
double FatLobule(const Cavity& cavity, const glm::dvec3& direction);

// Distance along a unit direction at which a ray from the portal enters the ellipsoid; infinite
// when it misses.
double CastEllipsoid(const Ellipsoid& ellipsoid, const glm::dvec3& direction);

// Nearest surface along a unit direction from the portal.
struct CavityHit {
  double distance = 0;
  Surface surface = Surface::kCapsule;
  double wall_distance = 0;  // distance of capsule or fat in this direction, whichever is nearer
};
CavityHit CastFromPortal(const Cavity& cavity, const glm::dvec3& direction);

// Unit, towards the free space.
glm::dvec3 NormalAt(const Cavity& cavity, Surface surface, const glm::dvec3& x,
                    bool with_bed = true);

// Approximate distance from a point in the free space to the nearest surface, without folds and
// lobes; negative inside tissue. Exact near the surfaces, elsewhere too small rather than too
// large.
double Clearance(const Cavity& cavity, const glm::dvec3& x, bool with_bed = true);

// Distance of a point from the condyle, as in Clearance.
double EllipsoidClearance(const Ellipsoid& ellipsoid, const glm::dvec3& x);

}  // namespace arthro::authoring
