#include <cmath>
#include <numbers>

#include "authoring/phantom/disc_layer.h"
#include "authoring/phantom/noise.h"
#include "authoring/phantom/phantom_tissue.h"
#include "simulation/core/units.h"

namespace arthro::authoring {
namespace {

constexpr double kMm = kMetrePerMillimetre;
constexpr int kRings = 13;             // spaced by about 0.6 mm
constexpr double kShare = 0.97;        // share of the bed's radius; its rim has no depth to fill
constexpr double kProud = 0.05 * kMm;  // height of the layer's middle over the cartilage around it
constexpr double kGlue = 0.05 * kMm;   // gap between the layer and the bed

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
  tissue.surface = DiscLayer(kRings, kShare, [&](double share, double angle, bool is_top) {
    const double left = share / kShare, reach = share * BedOutline(bed, angle);
    const double x = bed.centre.x + bed.radii.x * reach * std::cos(angle);
    const double y = bed.centre.y + bed.radii.y * reach * std::sin(angle);
    const double z = is_top ? PlateauHeight(plateau, x, y, false) + kProud * (1.0 - left * left)
                            : PlateauHeight(plateau, x, y) + kGlue;
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
