// Shape of the phantom's tibial plateau as a height field z = H(x, y) in its own frame (x medial,
// y posterior, z up), m. Bone: a dish with the two tubercles of the intercondylar eminence, a rim
// that rolls off, and the bed of the cartilage layer. Soft tissue on it: the roots of the medial
// meniscus, the capsule that rises around both menisci, the lateral meniscus with the popliteus
// hiatus behind it, and the lobules of the fat pad in front. Sizes are chosen, not measured.
#pragma once

#include <array>
#include <cstdint>
#include <limits>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "simulation/core/frames.h"

namespace arthro::authoring {

// Place of the cartilage layer in the plateau. The bed is `depth` deep, with walls that rise over
// the outer `wall` share of its radii.
struct CartilageBed {
  glm::dvec2 centre{0.0}, radii{1.0};
  glm::dvec2 wobble{0.0};  // rad; phases of the outline's two- and three-fold waves
  double depth = 0.0, wall = 0.22;
};

struct Tubercle {
  glm::dvec2 centre{0.0}, radii{1.0};
  double height = 0;
};

// Ridge of fibres from the horn of a meniscus to its insertion; it fans out and sinks into the
// bone.
struct MeniscalRoot {
  glm::dvec2 from{0.0}, to{0.0};
  double half_width = 0, height = 0;  // at `from`
};

// Capsule around the plateau: an ellipse about the medial compartment, a straight line behind the
// eminence, an ellipse about the lateral compartment.
struct CapsuleBorder {
  glm::dvec2 medial{0.0}, medial_radii{1.0};
  double lateral_x = 0, lateral_radius = 1;
  double height = 0, front_height = 0;  // behind and beside the menisci; in front of them
  double reach = 1;                     // distance over which the wall rises
  double hiatus_depth = 0;              // recess behind the popliteus tendon
  double hiatus_angle = 0;              // rad, about the lateral ellipse's centre
};

struct LateralMeniscus {
  double width = 0, height = 0;
};

struct Plateau {
  std::uint32_t seed = 0;
  Rigid3 portal_from_plateau;
  double curvature_x = 0, curvature_y = 0;  // 1/m, curvature of the dish
  double half_width_medial = 0, half_width_lateral = 0, half_depth = 0;
  double roll_off = 0;               // m per (share past the rim)²
  std::array<Tubercle, 2> eminence;  // medial, lateral
  Tubercle footprint;                // mound at the foot of the anterior cruciate ligament
  CartilageBed bed;
  std::array<MeniscalRoot, 2> roots;  // anterior, posterior
  CapsuleBorder border;
  LateralMeniscus lateral_meniscus;
  double lobule_height = 0;
};

// Height of the plateau with its soft tissue, with and without the bed.
double PlateauHeight(const Plateau& plateau, double x, double y, bool with_bed = true);
// Height of the bone and cartilage alone; the medial meniscus lies on it.
double BoneHeight(const Plateau& plateau, double x, double y, bool with_bed = true);

// Approximate distance of a point from the plateau, positive above it; too small rather than too
// large beside the capsule's steep wall. Exact near level parts. A point further off than `enough`
// may give less than its clearance, but not less than `enough`: the lobules need no noise there.
double PlateauClearance(const Plateau& plateau, const glm::dvec3& x, bool with_bed = true,
                        double enough = std::numeric_limits<double>::infinity());

// Share of the way to the rim: 0 in the middle, 1 at the rim, more beyond.
double RimShare(const Plateau& plateau, double x, double y);

// Shares of the soft tissues that cover a point, each 0 to 1, and the direction of their fibres.
struct PlateauCover {
  double capsule = 0;   // synovium of the capsule's wall
  double fibre = 0;     // roots and lateral meniscus
  double hiatus = 0;    // recess of the popliteus
  double eminence = 0;  // slopes of the tubercles
  double lobule = 0;    // fat pad
  glm::dvec2 along{1.0, 0.0};
};
PlateauCover CoverAt(const Plateau& plateau, double x, double y);

// Height of the fat pad's lobules on the front slope: 0 in the creases to 1 on their tops.
double SlopeLobule(const Plateau& plateau, double x, double y);

// Outline of the bed, as a factor on its radii; `angle` is measured on the point scaled by them.
double BedOutline(const CartilageBed& bed, double angle);
// Share of the bed's radius at a point: 0 in the middle, 1 at the rim.
double BedShare(const CartilageBed& bed, double x, double y);
double BedDepth(const CartilageBed& bed, double share);

}  // namespace arthro::authoring
