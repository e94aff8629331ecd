// The shape of a digital knee: the front of the medial compartment of a right knee, seen through
// the anterolateral portal. Every surface is a closed formula, so that its depth is known exactly.
// Portal frame, m [method.md, Frames]: (+z into the joint, +x to the viewer's right and medial, +y
// down).
//
//   condyle                    an ellipsoid
//   plateau                    a height field z = H(x, y) in its own frame (x medial, y posterior,
//   z up): a
//                              dish with a tibial spine, a rim that rolls off, and the bed of the
//                              cartilage
//   ligament                   bundles of cylinders with round ends
//   capsule, fat               star-shaped about the portal: distance = R(direction), folds and
//   lobes in R
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
  kCartilage,  // likewise
};

struct Ellipsoid {
  glm::dvec3 centre{0.0}, radii{1.0};
  glm::dquat portal_from_body{1.0, 0.0, 0.0, 0.0};
};

// Where the cartilage layer lies in the plateau; plateau frame. The bed is `depth` deep, with walls
// that rise over the outer `wall` share of its radii.
struct CartilageBed {
  glm::dvec2 centre{0.0}, radii{1.0};
  glm::dvec2 wobble{0.0};  // rad; phases of the outline's two- and three-fold waves
  double depth = 0.0, wall = 0.16;
};

struct Plateau {
  Rigid3 portal_from_plateau;
  double curvature_x = 0, curvature_y = 0;  // 1/m, of the dish
  double half_width_medial = 0, half_width_lateral = 0, half_depth = 0;
  double roll_off = 0;  // m a unit of (share past the rim)²
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
  double radius = 0.05;  // D, of the backdrop sphere
  double capsule_side = 0, capsule_front = 0, fold_height = 0;
  double overhang = 0, fat_distance = 0, lobe_height = 0;
  Ellipsoid condyle;
  Plateau plateau;
  std::array<Bundle, 5> ligament;
};

Cavity MakeCavity(std::uint32_t seed);

// Height of the plateau, with and without the bed; plateau frame.
double PlateauHeight(const Plateau& plateau, double x, double y, bool with_bed = true);
// The bed's outline, as a factor on its radii; `angle` is that of the point scaled by them.
double BedOutline(const CartilageBed& bed, double angle);
// Share of the bed's radius at which a point lies: 0 in its middle, 1 at its rim.
double BedShare(const CartilageBed& bed, double x, double y);
double BedDepth(const CartilageBed& bed, double share);

// Distances of the two star-shaped surfaces in a unit direction; the fat lies behind the capsule
// where there is none.
double CapsuleDistance(const Cavity& cavity, const glm::dvec3& direction);
double FatDistance(const Cavity& cavity, const glm::dvec3& direction);
// The lobules of the fat: 0 in the creases between them to 1 on their tops.
double FatLobule(const Cavity& cavity, const glm::dvec3& direction);

// Distance along a unit direction at which a ray from the portal enters the ellipsoid; infinite if
// it misses.
double CastEllipsoid(const Ellipsoid& ellipsoid, const glm::dvec3& direction);

// The nearest surface along a unit direction from the portal.
struct CavityHit {
  double distance = 0;
  Surface surface = Surface::kCapsule;
  double wall_distance = 0;  // of capsule or fat in this direction, whichever is nearer
};
CavityHit CastFromPortal(const Cavity& cavity, const glm::dvec3& direction);

// Unit, towards the free space.
glm::dvec3 NormalAt(const Cavity& cavity, Surface surface, const glm::dvec3& x,
                    bool with_bed = true);

// About how far the nearest surface is from a point in the free space, folds and lobes smoothed
// away; negative inside tissue. Good near the surfaces, too small rather than too large elsewhere.
double Clearance(const Cavity& cavity, const glm::dvec3& x, bool with_bed = true);

// How far outside the condyle a point lies, as Clearance does.
double EllipsoidClearance(const Ellipsoid& ellipsoid, const glm::dvec3& x);

}  // namespace arthro::authoring
