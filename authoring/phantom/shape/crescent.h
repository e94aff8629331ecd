// Crescent shape of the phantom's meniscus, as formulas over its angle; the fine surface and the
// tetrahedra share it. Plateau frame, m, rad.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "authoring/phantom/shape/cavity.h"
#include "authoring/phantom/shape/phantom_tissue.h"
#include "simulation/core/units.h"

namespace arthro::authoring {

// Dimensions; angles from medial (0) to posterior (90°).
struct Crescent {
  glm::dvec2 centre{0.0};
  double outer_x = 0, outer_y = 0;  // radii of the outer rim
  double from = 0, to = 0;          // anterior and posterior horn
  double body_width = 0, posterior_width = 0, anterior_width = 0;
  double body_height = 0, posterior_height = 0, anterior_height = 0;
  double edge = 0.42 * kMetrePerMillimetre;  // thickness of the free edge
  double film = 0.10 * kMetrePerMillimetre;  // film of fluid between meniscus and plateau
  Rigid3 plateau_from_tissue;
};
Crescent MakeCrescent(const Cavity& cavity);

// Width and height of the wedge at an angle; both taper towards the horns.
struct Wedge {
  double width, height;
};
Wedge WedgeAt(const Crescent& crescent, double angle);

double OuterRadius(const Crescent& crescent, double angle);
// Point of the plateau at a distance from the crescent's centre.
glm::dvec3 OnPlateau(const Cavity& cavity, const Crescent& crescent, double angle, double r,
                     double lift);
// Thickness of the free edge; smaller where the wedge is low.
double EdgeThickness(const Crescent& crescent, const Wedge& wedge);
// Height of the upper face over the plateau at a share q of the width, 0 at the free edge. The face
// is slightly concave and turns over at its outer shoulder.
double TopOf(const Crescent& crescent, const Wedge& wedge, double q);
// Outward bulge of the rim at a share of its height.
double RimBulge(const Wedge& wedge, double up);

// Fills the same crescent with tetrahedra and sets its fixed regions.
void FillMeniscus(const Cavity& cavity, const Crescent& crescent, PhantomTissue& tissue);

}  // namespace arthro::authoring
