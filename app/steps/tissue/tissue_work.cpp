#include <algorithm>

#include <fmt/format.h>

#include "app/state/edits.h"
#include "app/steps/tissue/tissue_step.h"
#include "authoring/tissue/likely_unit.h"
#include "authoring/tissue/tetrahedra/mesh_budget.h"
#include "simulation/core/box3.h"
#include "simulation/core/file_name.h"
#include "simulation/core/units.h"
#include "simulation/scene/backdrop/hidden_share.h"
#include "simulation/scene/mesh/mesh_io.h"
#include "simulation/scope/arthroscope.h"

namespace arthro::app {
namespace fs = std::filesystem;

namespace {

// In front of the scope, where it is seen at once; portal frame, m.
glm::dvec3 PlaceBeforeScope(const EditorState& state) {
  const Scene& scene = state.document().scene;
  const auto view = simulation::ViewFromPose(state.scope, scene.scope.view_angle);
  return view.tip + 0.35 * scene.backdrop.radius * view.view;
}

}  // namespace

bool IsHidden(const EditorState& state, int tissue) {
  constexpr double kNearlyAll = 0.95;
  const authoring::Document& document = state.document();
  const auto at = static_cast<std::size_t>(tissue);
  if (!document.panorama || at >= document.surfaces.size() || !document.surfaces[at]) return false;
  return HiddenShare(*document.surfaces[at], document.scene.tissues[at].pose,
                     OrEmpty(document.depth), document.scene.backdrop) >= kNearlyAll;
}

void BringBeforeScope(EditorState& state) {
  Tissue changed = state.document().scene.tissues.at(static_cast<std::size_t>(state.tissue));
  changed.pose.position = PlaceBeforeScope(state);
  SetTissue(state, state.tissue, changed, "Move");
  EndDrag(state);
}

void BrowseForSurface(EditorState& state) {
  Browse(state, BrowseFor::kOpenFile, "Import a surface", "Import",
         {{"Surfaces", {".stl", ".obj", ".ply", ".off", ".vtp"}}, {"All files", {}}}, AskForUnit);
}

void AskForUnit(EditorState& state, const fs::path& file) {
  state.jobs.Start("Read " + file.filename().string(), [file](const Progress&) {
    auto surface = std::make_shared<const SurfaceMesh>(ReadSurface(file, 1.0));
    const double longest_side = authoring::LongestSide(*surface);
    return [dialog = UnitDialog{file, surface, longest_side, authoring::LikelyUnit(longest_side)}](
               EditorState& now) { now.dialogs.push_back(dialog); };
  });
}

void ImportSurface(EditorState& state, const std::string& name, SurfaceMesh mesh,
                   const std::string& unit) {
  const double metres_per_unit = MetresPerUnit(unit).value_or(1.0);
  // Its own origin becomes its middle, so that turning turns it on the spot.
  Box3 box = kEmptyBox;
  for (const auto& x : mesh.vertices) box = Union(box, {x, x});
  const glm::dvec3 middle = 0.5 * (box.low + box.high);
  for (auto& x : mesh.vertices) x = metres_per_unit * (x - middle);
  Tissue tissue;
  tissue.name = name;
  tissue.pose.position = PlaceBeforeScope(state);
  AddTissue(state, std::move(tissue), std::make_shared<const SurfaceMesh>(std::move(mesh)));
  state.step = Step::kTissue;
}

void TetrahedraliseTissue(EditorState& state) {
  const int index = state.tissue;
  const authoring::Document& document = state.document();
  const Tissue tissue = document.scene.tissues.at(static_cast<std::size_t>(index));
  const auto surface = document.surfaces.at(static_cast<std::size_t>(index));
  if (!surface) return;
  authoring::MeshWish wish;
  wish.elements = authoring::BudgetOf(state.steps.tissue->mesh_size).elements;
  wish.fixed = tissue.fixed;
  wish.probed = tissue.probed;
  // Kept beside the window until the scene is saved; saving copies it into the scene's folder.
  const fs::path file = state.scratch.NewFile(FileNameFrom(tissue.name, "tissue") + ".vtu");
  state.jobs.Start("Make tetrahedra of " + tissue.name, [=](const Progress& progress) {
    authoring::SurfaceSource source;
    source.file = tissue.name;
    source.unit = "mm";
    source.metres_per_unit = kMetrePerMillimetre;
    authoring::TetrahedralizeReport report;
    const TetMesh mesh =
        authoring::TetrahedralizeToBudget(*surface, source, wish, &report, progress);
    WriteTetMesh(file, mesh);
    return [=](EditorState& now) {
      // The list may have changed meanwhile.
      const auto& tissues = now.document().scene.tissues;
      const auto found = std::find_if(tissues.begin(), tissues.end(),
                                      [&](const Tissue& t) { return t.name == tissue.name; });
      if (found == tissues.end()) return;
      const auto at = static_cast<std::size_t>(found - tissues.begin());
      if (now.document().surfaces[at] != surface) return;
      Edit(now, "Make tetrahedra of " + tissue.name, "", [&](authoring::Document& next) {
        const std::string name = "tissues/" + file.filename().string();
        next.scene.tissues[at].mesh = name;
        next.scene.tissues[at].is_implicit = false;  // it gives way now
        next.files[name].file = file;
      });
      now.message = fmt::format("{}: {} curved tetrahedra, volume off by {:.1f} %", tissue.name,
                                report.elements, 100 * report.volume_error);
    };
  });
}

}  // namespace arthro::app
