// Shape of a digital knee: the front of the medial compartment of a right knee, seen through
// the anterolateral portal. Every surface is a closed formula, so that its depth is known exactly.
// Portal frame, m [method.md, Frames]: (+z into the joint, +x to the viewer's right and medial, +y
// down).
//
//   femur         ellipsoids with fillets between them: medial and lateral condyle, trochlea
//   plateau       height field in its own frame (plateau.h)
//   ligaments     bundles of cylinders with round ends: the anterior cruciate ligament from the
//                 plateau to the lateral condyle, the posterior one from the medial condyle to the
//                 back of the plateau, the popliteus tendon
//   capsule, fat  star-shaped about the portal: distance = R(direction), folds and lobes in R
#pragma once

#include <array>
#include <cstdint>

#include <glm/gtc/quaternion.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "authoring/phantom/shape/plateau.h"

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

struct Bundle {
  glm::dvec3 from{0.0}, to{0.0};
  double radius = 0;
};

// Bundles in their order: anterior cruciate ligament, posterior one, popliteus tendon.
constexpr std::size_t kAnteriorBundles = 7, kPosteriorBundles = 4;
constexpr std::size_t kBundles = kAnteriorBundles + kPosteriorBundles + 1;

struct Cavity {
  std::uint32_t seed = 0;
  double radius = 0.05;  // D, radius of the backdrop sphere
  double capsule_side = 0, capsule_front = 0, fold_height = 0;
  double overhang = 0, fat_distance = 0, lobe_height = 0;
  Ellipsoid condyle, lateral_condyle, trochlea;
  Plateau plateau;
  std::array<Bundle, kBundles> ligament;
};

Cavity MakeCavity(std::uint32_t seed);

// Distances of the two star-shaped surfaces in a unit direction. A direction without fat gives a
// distance behind the capsule.
double CapsuleDistance(const Cavity& cavity, const glm::dvec3& direction);
// The capsule's distance without its folds.
double CapsuleBase(const Cavity& cavity, const glm::dvec3& direction);
double FatDistance(const Cavity& cavity, const glm::dvec3& direction);
// Height of the fat's lobules: 0 in the creases between them to 1 on their tops.
double FatLobule(const Cavity& cavity, const glm::dvec3& direction);

// Distance along a unit direction at which a ray from the portal enters the ellipsoid; infinite
// when it misses.
double CastEllipsoid(const Ellipsoid& ellipsoid, const glm::dvec3& direction);

// Bundle of the ligaments that is nearest to a point; a place on its axis as a share of its length.
struct BundlePlace {
  std::size_t bundle = 0;
  double share = 0;
};
BundlePlace NearestBundle(const Cavity& cavity, const glm::dvec3& x);

// Distance of capsule or fat in a unit direction, whichever is nearer.
double WallDistance(const Cavity& cavity, const glm::dvec3& direction);

// Nearest surface along a unit direction from the portal.
struct CavityHit {
  double distance = 0;
  Surface surface = Surface::kCapsule;
};
CavityHit CastFromPortal(const Cavity& cavity, const glm::dvec3& direction);

// Unit, towards the free space.
glm::dvec3 NormalAt(const Cavity& cavity, Surface surface, const glm::dvec3& x,
                    bool with_bed = true);

// Approximate distance from a point in the free space to the nearest surface, without folds and
// lobes; negative inside tissue. Exact near the surfaces, elsewhere too small rather than too
// large.
double Clearance(const Cavity& cavity, const glm::dvec3& x, bool with_bed = true);

// Distance of a point from the femur, as in Clearance: both condyles and the trochlea, with fillets
// between them; 0 on its surface.
double FemurClearance(const Cavity& cavity, const glm::dvec3& x);

// Distance of a point from the condyle, as in Clearance.
double EllipsoidClearance(const Ellipsoid& ellipsoid, const glm::dvec3& x);

}  // namespace arthro::authoring
