#include "app/steps/tissue/library/tissue_library.h"

#include <fmt/format.h>

#include "app/state/edits.h"
#include "authoring/models/model_in_scene.h"
#include "authoring/tissue/tetrahedra/mesh_budget.h"
#include "simulation/core/error.h"
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

}  // namespace

void AddLibraryModel(EditorState& state, authoring::ModelKind kind) {
  const ModelShelf& shelf = *state.steps.tissue->shelf;
  const authoring::KneeSide side = shelf.side;
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
      const Pose pose = authoring::PoseOnRelief(model, now.document(), view.tip, view.view);
      Edit(now, "Add " + title, "",
           [&](authoring::Document& next) { authoring::AddModel(next, model, pose, {}, mesh); });
      now.tissue = static_cast<int>(now.document().scene.tissues.size()) - 1;
      now.step = Step::kTissue;
      now.steps.tissue->shelf->is_open = false;
      now.message = title + " lies on the relief in the middle of the scope's view.";
    };
  });
}

void ChooseTear(EditorState& state, authoring::TearKind kind) {
  ModelShelf& shelf = *state.steps.tissue->shelf;
  shelf.tear = authoring::TearOptions(kind);
  shelf.preview.reset();
}

void MakeChosenTear(EditorState& state) {
  const authoring::Document& document = state.document();
  const auto at = static_cast<std::size_t>(state.tissue);
  Tissue changed = document.scene.tissues.at(at);
  if (changed.mesh.empty() && !changed.is_implicit) {
    state.message = changed.name + " has no tetrahedra yet; make them on its Mesh page first.";
    return;
  }
  const authoring::TearOptions& tear = state.steps.tissue->shelf->tear;
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
    shelf.preview_fault = error.sentence();
  }
  shelf.preview = authoring::ThumbnailOf(OrEmpty(surface), cuts, 900);
}

}  // namespace arthro::app
