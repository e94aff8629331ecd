#include <algorithm>
#include <cmath>

#include "authoring/phantom/shape/disc_layer.h"
#include "authoring/phantom/shape/noise.h"
#include "authoring/phantom/shape/phantom_tissue.h"
#include "simulation/core/units.h"

namespace arthro::authoring {
namespace {

constexpr int kRings = 13;             // spaced by about 0.6 mm
constexpr double kProud = 0.04 * kMm;  // height of the layer over the cartilage around it
constexpr double kGlue = 0.05 * kMm;   // gap between the layer and the bed
// The layer covers the lip of its bed, and its rim lies in the bone: neither the wall of the bed
// nor a gap is seen along the seam.
constexpr double kOverLip = 1.03, kRim = 1.07;  // radii of the bed
constexpr double kSunk = 0.08 * kMm;            // m, depth of the rim's top in the bone
constexpr double kLeastThickness = 0.10 * kMm;

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
  tissue.surface = DiscLayer(kRings, kRings, [&](double ring, double angle, bool is_top) {
    const bool is_rim = ring == kRings;
    const double share = is_rim ? kRim : kOverLip * ring / (kRings - 1);
    const double reach = share * BedOutline(bed, angle);
    const double x = bed.centre.x + bed.radii.x * reach * std::cos(angle);
    const double y = bed.centre.y + bed.radii.y * reach * std::sin(angle);
    const double top_z = PlateauHeight(plateau, x, y, false) + (is_rim ? -kSunk : kProud);
    const double z =
        is_top ? top_z : std::min(PlateauHeight(plateau, x, y) + kGlue, top_z - kLeastThickness);
    return tissue_from_plateau * glm::dvec3(x, y, z);
  });
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
