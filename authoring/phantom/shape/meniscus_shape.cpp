#include <numbers>
#include <utility>

#include "authoring/phantom/shape/crescent.h"
#include "authoring/phantom/shape/crescent_skin.h"
#include "authoring/phantom/shape/phantom_tissue.h"

namespace arthro::authoring {

PhantomTissue MakeMeniscus(const Cavity& cavity) {
  const Crescent c = MakeCrescent(cavity);
  const Rigid3& portal_from_plateau = cavity.plateau.portal_from_plateau;
  const Rigid3& plateau_from_tissue = c.plateau_from_tissue;
  const Rigid3 tissue_from_plateau = Inverse(plateau_from_tissue);
  const Rigid3 portal_from_tissue = portal_from_plateau * plateau_from_tissue;

  PhantomTissue tissue;
  tissue.name = "medial meniscus";
  tissue.portal_from_tissue = {portal_from_tissue.translation, portal_from_tissue.rotation, 1.0};
  FillMeniscus(cavity, c, tissue);
  const CrescentGround ground = [&](double angle, double r, double lift) {
    return OnPlateau(cavity, c, angle, r, lift);
  };
  CrescentSkin skin = SkinOf(c, ground);
  for (const glm::dvec3& x : skin.surface.vertices)
    tissue.surface.vertices.push_back(tissue_from_plateau * x);
  tissue.surface.triangles = std::move(skin.surface.triangles);
  tissue.rims = std::move(skin.rims);

  const auto landmark = [&](const char* name, double angle, auto place) {
    tissue.landmarks.push_back({name, portal_from_plateau * place(c, ground, angle)});
  };
  landmark("meniscus anterior horn", c.from, ShoulderAt);
  landmark("meniscus posterior horn", c.to, ShoulderAt);
  landmark("meniscus body, free edge", 0.0, FreeEdgeAt);
  landmark("meniscus body, outer rim", 0.0, ShoulderAt);
  landmark("meniscus posterior, free edge", 0.5 * std::numbers::pi, FreeEdgeAt);
  landmark("meniscus posterior, outer rim", 0.5 * std::numbers::pi, ShoulderAt);
  return tissue;
}

}  // namespace arthro::authoring
