#include "app/steps/tissue/library/tissue_library.h"

#include <algorithm>

#include <fmt/format.h>

#include "app/state/capital.h"
#include "app/state/edits.h"
#include "app/steps/tissue/library/torn_surface.h"
#include "authoring/models/model_in_scene.h"
#include "authoring/tissue/tetrahedra/mesh_budget.h"
#include "simulation/core/error.h"
#include "simulation/core/units.h"
#include "simulation/scene/mesh/mesh_io.h"
#include "simulation/scope/arthroscope.h"

namespace arthro::app {
namespace fs = std::filesystem;

namespace {

const authoring::ModelEntry& EntryOf(authoring::ModelKind kind) {
  return authoring::ModelEntries()[static_cast<std::size_t>(kind)];
}

// Thin layers and solids are touched without tetrahedra.
bool NeedsTetrahedra(const authoring::LibraryModel& model) {
  return !model.is_solid && model.material != "cartilage";
}

// `sight`: a line to its place; none: the middle of the scope's view.
void AddModelAt(EditorState& state, authoring::ModelKind kind,
                const std::optional<authoring::Sight>& sight) {
  const ModelShelf& shelf = *state.steps.tissue->shelf;
  const authoring::KneeSide side = state.document().scene.side == BodySide::kLeft
                                       ? authoring::KneeSide::kLeft
                                       : authoring::KneeSide::kRight;
  const authoring::KneeSize size = shelf.size;
  const authoring::MeshSize mesh_size = state.steps.tissue->mesh_size;
  const std::string title = EntryOf(kind).title;
  // The same model always has the same tetrahedra, so that its file may be written again.
  const fs::path file =
      state.scratch.path() / fmt::format("library-{}-{}-{}-{}.vtu", EntryOf(kind).word,
                                         static_cast<int>(side), static_cast<int>(size),
                                         static_cast<int>(mesh_size));
  state.jobs.Start("Make " + title, [=](const Progress& progress) {
    const authoring::LibraryModel model =
        authoring::MakeModel(authoring::OptionsOfSize(kind, size), side);
    fs::path mesh;
    if (NeedsTetrahedra(model)) {
      authoring::MeshWish wish;
      wish.elements = authoring::BudgetOf(mesh_size).elements;
      wish.fixed = model.fixed;
      authoring::SurfaceSource source;
      source.file = model.name;
      WriteTetMesh(
          file, authoring::TetrahedralizeToBudget(model.surface, source, wish, nullptr, progress));
      mesh = file;
    }
    return [=](EditorState& now) {
      const auto view = simulation::ViewFromPose(now.scope, now.document().scene.scope.view_angle);
      const Pose pose =
          authoring::PoseOnRelief(model, now.document(), sight ? sight->eye : view.tip,
                                  sight ? sight->direction : view.view);
      Edit(now, "Add " + title, "",
           [&](authoring::Document& next) { authoring::AddModel(next, model, pose, {}, mesh); });
      now.tissue = static_cast<int>(now.document().scene.tissues.size()) - 1;
      now.step = Step::kTissue;
      now.steps.tissue->shelf->is_open = false;
      now.message = title + (sight ? " lies on the relief where it was let go."
                                   : " lies on the relief in the middle of the scope's view.");
    };
  });
}

}  // namespace

void AddLibraryModel(EditorState& state, authoring::ModelKind kind) {
  AddModelAt(state, kind, std::nullopt);
}

void DropLibraryModel(EditorState& state, authoring::ModelKind kind,
                      const std::optional<authoring::Sight>& sight) {
  if (sight && authoring::PointOnRelief(state.document(), *sight))
    AddModelAt(state, kind, sight);
  else
    state.message = "Nothing was imaged there; let the model go where the picture shows tissue.";
}

void ChooseTear(EditorState& state, authoring::TearKind kind) {
  ModelShelf& shelf = *state.steps.tissue->shelf;
  shelf.tear = authoring::TearOptions(kind);
  shelf.preview.reset();
}

namespace {

// A displaced handle is another shape of the tissue, which is filled anew.
void DisplaceHandle(EditorState& state) {
  const auto at = static_cast<std::size_t>(state.tissue);
  const Tissue tissue = state.document().scene.tissues.at(at);
  const SharedSurface surface = state.document().surfaces.at(at);
  const authoring::TearOptions tear = state.steps.tissue->shelf->tear;
  authoring::MeshWish wish;
  wish.elements = authoring::BudgetOf(state.steps.tissue->mesh_size).elements;
  wish.fixed = tissue.fixed;
  const fs::path file = state.scratch.NewFile("displaced-handle.vtu");
  state.jobs.Start("Displace the handle of " + tissue.name, [=](const Progress& progress) {
    const SharedSurface displaced =
        Share(DisplacedHandle(OrEmpty(surface), tear, tissue.fixed, nullptr, progress));
    authoring::SurfaceSource source;
    source.file = tissue.name;
    if (!tissue.is_implicit)
      WriteTetMesh(file,
                   authoring::TetrahedralizeToBudget(*displaced, source, wish, nullptr, progress));
    return [=](EditorState& now) {
      const auto& surfaces = now.document().surfaces;
      const auto found = std::find(surfaces.begin(), surfaces.end(), surface);
      if (found == surfaces.end()) return;  // removed or replaced meanwhile
      const auto index = static_cast<std::size_t>(found - surfaces.begin());
      Edit(now, "Displace the handle of " + tissue.name, "", [&](authoring::Document& next) {
        next.surfaces[index] = displaced;
        // The slot is part of the new shape, and is not cut a second time.
        const std::vector<Cut> slot = authoring::TearCuts(OrEmpty(surface), tear);
        std::erase_if(next.scene.tissues[index].cuts, [&](const Cut& cut) {
          return std::find(slot.begin(), slot.end(), cut) != slot.end();
        });
        if (tissue.is_implicit) return;
        const std::string name = "tissues/" + file.filename().string();
        next.scene.tissues[index].mesh = name;
        next.files[name].file = file;
      });
      now.message = fmt::format("Bucket handle of {}, displaced by {:.1f} mm.", tissue.name,
                                MmFromMetres(tear.displacement));
    };
  });
}

}  // namespace

void MakeChosenTear(EditorState& state) {
  const authoring::Document& document = state.document();
  const auto at = static_cast<std::size_t>(state.tissue);
  Tissue changed = document.scene.tissues.at(at);
  if (changed.mesh.empty() && !changed.is_implicit) {
    state.message = changed.name + " has no tetrahedra yet; make them on its Mesh page first.";
    return;
  }
  const authoring::TearOptions& tear = state.steps.tissue->shelf->tear;
  if (tear.displacement > 0) return DisplaceHandle(state);
  for (Cut& cut : authoring::TearCuts(OrEmpty(document.surfaces.at(at)), tear))
    changed.cuts.push_back(std::move(cut));
  const char* title = authoring::TearEntries()[static_cast<std::size_t>(tear.kind)].title;
  SetTissue(state, state.tissue, changed, std::string(title) + " tear of");
  EndDrag(state);
  state.message = fmt::format("{} tear of {}.", title, changed.name);
}

void UpdateTearPreview(EditorState& state) {
  ModelShelf& shelf = *state.steps.tissue->shelf;
  const auto& surface = state.document().surfaces.at(static_cast<std::size_t>(state.tissue));
  if (shelf.preview && shelf.previewed.lock() == surface) return;
  shelf.previewed = surface;
  shelf.preview_fault.clear();
  std::vector<Cut> cuts;
  try {
    cuts = authoring::TearCuts(OrEmpty(surface), shelf.tear);
  } catch (const Error& error) {
    shelf.preview_fault = Capital(error.sentence()) + ".";
  }
  shelf.preview = authoring::ThumbnailOf(OrEmpty(surface), cuts, 900);
}

}  // namespace arthro::app
