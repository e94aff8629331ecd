#include "simulation/practice/cut_skin.h"

#include <utility>

#include "simulation/core/error.h"
#include "simulation/practice/living_tissues.h"
#include "simulation/tissue/body/body_options.h"
#include "simulation/tissue/cut/cutters.h"
#include "simulation/tissue/field/carved_skin.h"

namespace arthro::simulation {

bool HasCutsMade(const Tissue& tissue) {
  return !tissue.cuts.empty() && (!tissue.mesh.empty() || tissue.is_implicit);
}

SolidField WholeField(const Tissue& tissue, const SurfaceMesh& surface) {
  try {
    return SolidField::FromSurface(PlacesOf(tissue, surface).surface, BodyOptions{}.cut_spacing);
  } catch (const Error& error) {
    throw Error(error.code(), tissue.name + ": " + error.sentence());
  }
}

BodySkin CutSkin(const Tissue& tissue, const SurfaceMesh& surface, const SolidField& whole) {
  try {
    const BodyPlaces places = PlacesOf(tissue, surface);
    SolidField field = whole;
    MakeCuts(field, places.cuts, places.fixed);
    CarvedSkin carved = SkinCarver(places.surface, whole).Carve(field);
    BodySkin skin{std::move(carved.surface), std::move(carved.is_fresh)};
    for (glm::dvec3& x : skin.surface.vertices) x /= tissue.pose.scale;
    return skin;
  } catch (const Error& error) {
    throw Error(error.code(), tissue.name + ": " + error.sentence());
  }
}

BodySkin CutSkin(const Tissue& tissue, const SurfaceMesh& surface) {
  return CutSkin(tissue, surface, WholeField(tissue, surface));
}

}  // namespace arthro::simulation
