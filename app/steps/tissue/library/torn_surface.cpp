#include "app/steps/tissue/library/torn_surface.h"

#include <vector>

#include "authoring/tissue/surface/surface_simplify.h"
#include "simulation/tissue/body/body_options.h"
#include "simulation/tissue/cut/cutters.h"
#include "simulation/tissue/field/polygonise.h"

namespace arthro::app {
namespace {

constexpr int kMostTriangles = 8000;  // about as many as the models of the library have

}  // namespace

SurfaceMesh TornSurface(const SurfaceMesh& surface, std::span<const Cut> cuts,
                        std::span<const Ball> fixed, double* removed) {
  simulation::SolidField field =
      simulation::SolidField::FromSurface(surface, simulation::BodyOptions{}.cut_spacing);
  const double whole = field.Volume();
  simulation::MakeCuts(field, cuts, fixed);
  if (removed != nullptr) *removed = whole - field.Volume();
  return simulation::Polygonise(field);
}

SurfaceMesh DisplacedHandle(const SurfaceMesh& surface, const authoring::TearOptions& tear,
                            std::span<const Ball> fixed, double* removed,
                            const Progress& progress) {
  const std::vector<Cut> cuts = authoring::TearCuts(surface, tear);
  SurfaceMesh displaced =
      authoring::WithDisplacedHandle(TornSurface(surface, cuts, fixed, removed), surface, tear);
  authoring::SimplifySurface(displaced, kMostTriangles, progress);
  return displaced;
}

}  // namespace arthro::app
