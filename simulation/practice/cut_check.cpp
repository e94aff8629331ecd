#include "simulation/practice/cut_check.h"

#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "simulation/core/error.h"
#include "simulation/practice/living_tissues.h"
#include "simulation/tissue/body/body_options.h"
#include "simulation/tissue/cut/cutters.h"

namespace arthro::simulation {
namespace {

void LookAtCuts(const Tissue& tissue, const SurfaceMesh& surface, SceneFindings& findings) {
  const std::string what = fmt::format("tissue \"{}\"", tissue.name);
  constexpr double kMm3PerM3 = 1e9;
  const BodyPlaces places = PlacesOf(tissue, surface);
  SolidField field = SolidField::FromSurface(places.surface, BodyOptions{}.cut_spacing);

  for (const Region& region : places.regions) {
    const FieldGrid& grid = field.grid();
    bool holds_some = false;
    for (int k = 0; k < grid.count[2]; ++k)
      for (int j = 0; j < grid.count[1]; ++j)
        for (int i = 0; i < grid.count[0]; ++i)
          holds_some |=
              field.values()[grid.Index(i, j, k)] < 0 &&
              glm::distance(grid.Place(i, j, k), region.ball.centre) <= region.ball.radius;
    if (!holds_some)
      findings.warnings.push_back(
          fmt::format("{}: region \"{}\" holds nothing of it; move its ball onto the tissue", what,
                      region.name));
  }

  if (places.cuts.empty()) return;
  const MadeCuts made = MakeCuts(field, places.cuts, places.fixed);
  double removed = made.washed.edit.removed;
  for (std::size_t i = 0; i < made.removed.size(); ++i) {
    removed += made.removed[i];
    if (!(made.removed[i] > 0.0))
      findings.warnings.push_back(fmt::format(
          "{}: cut {} of \"cuts\" misses it: it takes nothing; move or remove it", what, i + 1));
  }
  findings.found.push_back(fmt::format("{}: {} cut{} take{} {:.1f} mm3 of it before practice", what,
                                       made.removed.size(), made.removed.size() == 1 ? "" : "s",
                                       made.removed.size() == 1 ? "s" : "", removed * kMm3PerM3));
  if (made.washed.crumbs > 0)
    findings.hints.push_back(
        fmt::format("{}: its cuts leave {} small loose piece{}, washed away before practice", what,
                    made.washed.crumbs, made.washed.crumbs == 1 ? "" : "s"));
  if (places.fixed.empty()) return;
  const FieldPieces pieces = PiecesOf(field);
  const std::vector<unsigned char> is_held = HeldPieces(field, pieces, places.fixed);
  for (std::size_t i = 0; i < is_held.size(); ++i)
    if (is_held[i] == 0)
      findings.warnings.push_back(
          fmt::format("{}: its cuts leave a piece of {:.1f} mm3 that no ball of \"fixed\" holds: "
                      "it will drift when it is touched",
                      what, pieces.volume[i] * kMm3PerM3));
}

}  // namespace

void CheckCuts(const LoadedScene& loaded, SceneFindings& findings) {
  const auto& tissues = loaded.scene.tissues;
  for (std::size_t i = 0; i < std::min(tissues.size(), loaded.surfaces.size()); ++i) {
    const Tissue& tissue = tissues[i];
    if (tissue.cuts.empty() && tissue.regions.empty()) continue;
    if (tissue.mesh.empty()) {
      findings.warnings.push_back(
          fmt::format("tissue \"{}\": it has no tetrahedra, so its \"cuts\" and \"regions\" do "
                      "nothing; `arthroscene tetrahedralize` makes them",
                      tissue.name));
      continue;
    }
    const SurfaceMesh& surface = OrEmpty(loaded.surfaces[i]);
    if (surface.triangles.empty()) continue;  // CheckScene reports it
    try {
      LookAtCuts(tissue, surface, findings);
    } catch (const Error& error) {
      findings.errors.push_back(fmt::format("tissue \"{}\": {}", tissue.name, error.sentence()));
    }
  }
}

}  // namespace arthro::simulation
