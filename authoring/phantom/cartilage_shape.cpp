#include <algorithm>
#include <cmath>
#include <numbers>

#include "authoring/phantom/noise.h"
#include "authoring/phantom/phantom_tissue.h"
#include "simulation/core/units.h"

namespace arthro::authoring {
namespace {

constexpr double kMm = kMetrePerMillimetre;
constexpr int kRings = 13;  // spaced by about 0.6 mm; ring k has 6k vertices, so triangles are even
constexpr double kProud = 0.04 * kMm;  // height of the layer over the cartilage around it
constexpr double kGlue = 0.05 * kMm;   // gap between the layer and the bed
// The layer covers the lip of its bed, and its rim lies in the bone: neither the wall of the bed
// nor a gap is seen along the seam.
constexpr double kOverLip = 1.03, kRim = 1.07;  // radii of the bed
constexpr double kSunk = 0.08 * kMm;            // m, depth of the rim's top in the bone
constexpr double kLeastThickness = 0.10 * kMm;

int FirstOfRing(int ring) { return ring == 0 ? 0 : 1 + 3 * ring * (ring - 1); }
int OfRing(int ring, int i) { return ring == 0 ? 0 : FirstOfRing(ring) + i % (6 * ring); }
constexpr int kBottom = 1 + 3 * kRings * (kRings + 1);

}  // namespace

PhantomTissue MakeCartilage(const Cavity& cavity) {
  Random random(0xCA277ull + cavity.seed);
  const Plateau& plateau = cavity.plateau;
  const CartilageBed& bed = plateau.bed;
  Rigid3 plateau_from_tissue;
  plateau_from_tissue.rotation =
      glm::angleAxis(RadiansFromDegrees(random.Uniform(-20.0, 20.0)), glm::dvec3(0, 0, 1));
  plateau_from_tissue.translation = {bed.centre.x, bed.centre.y,
                                     PlateauHeight(plateau, bed.centre.x, bed.centre.y, false)};
  const Rigid3 tissue_from_plateau = Inverse(plateau_from_tissue);
  const Rigid3 portal_from_tissue = plateau.portal_from_plateau * plateau_from_tissue;

  PhantomTissue tissue;
  tissue.name = "tibial cartilage";
  tissue.portal_from_tissue = {portal_from_tissue.translation, portal_from_tissue.rotation, 1.0};
  // Top first, then bottom: two discs of rings with the same plan.
  for (const bool top : {true, false})
    for (int ring = 0; ring <= kRings; ++ring)
      for (int i = 0; i < std::max(6 * ring, 1); ++i) {
        const double angle = ring == 0 ? 0.0 : 2.0 * std::numbers::pi * i / (6.0 * ring);
        const bool is_rim = ring == kRings;
        const double share = is_rim ? kRim : kOverLip * ring / (kRings - 1);
        const double reach = share * BedOutline(bed, angle);
        const double x = bed.centre.x + bed.radii.x * reach * std::cos(angle);
        const double y = bed.centre.y + bed.radii.y * reach * std::sin(angle);
        const double top_z = PlateauHeight(plateau, x, y, false) + (is_rim ? -kSunk : kProud);
        const double z =
            top ? top_z : std::min(PlateauHeight(plateau, x, y) + kGlue, top_z - kLeastThickness);
        tissue.surface.vertices.push_back(tissue_from_plateau * glm::dvec3(x, y, z));
      }
  const auto face = [&](int a, int b, int c) {  // given as on the top, mirrored below
    tissue.surface.triangles.push_back({a, b, c});
    tissue.surface.triangles.push_back({kBottom + a, kBottom + c, kBottom + b});
  };
  for (int ring = 1; ring <= kRings; ++ring)
    for (int sextant = 0; sextant < 6; ++sextant)
      for (int i = 0; i < ring; ++i) {
        const int outer = sextant * ring + i, inner = sextant * (ring - 1) + i;
        face(OfRing(ring - 1, inner), OfRing(ring, outer), OfRing(ring, outer + 1));
        if (i + 1 < ring)
          face(OfRing(ring - 1, inner), OfRing(ring, outer + 1), OfRing(ring - 1, inner + 1));
      }
  for (int i = 0; i < 6 * kRings; ++i) {
    const int a = OfRing(kRings, i), b = OfRing(kRings, i + 1);
    tissue.surface.triangles.push_back({a, kBottom + a, kBottom + b});
    tissue.surface.triangles.push_back({a, kBottom + b, b});
  }
  tissue.landmarks.push_back(
      {"cartilage layer, middle of the top", portal_from_tissue * tissue.surface.vertices[0]});
  return tissue;
}

SurfaceMesh InPortal(const PhantomTissue& tissue) {
  SurfaceMesh mesh = tissue.surface;
  for (glm::dvec3& x : mesh.vertices) x = tissue.portal_from_tissue * x;
  return mesh;
}

}  // namespace arthro::authoring
