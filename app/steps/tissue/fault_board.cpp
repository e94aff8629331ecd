#include "app/steps/tissue/fault_board.h"

#include <algorithm>

#include <fmt/format.h>

#include "app/state/edits.h"
#include "app/steps/tissue/import_frames.h"
#include "app/steps/tissue/tissue_step.h"
#include "simulation/core/units.h"

namespace arthro::app {
namespace {

SharedSurface SurfaceToShow(const EditorState& state) {
  const auto& surfaces = state.document().surfaces;
  const bool is_there = state.tissue >= 0 && state.tissue < static_cast<int>(surfaces.size()) &&
                        state.step == Step::kTissue && !state.practice;
  return is_there ? surfaces[static_cast<std::size_t>(state.tissue)] : nullptr;
}

// Puts the result of `mend` in the place of the chosen surface.
void Replace(EditorState& state, const std::string& what,
             std::function<SurfaceMesh(const SurfaceMesh&, std::string*, const Progress&)> mend) {
  const SharedSurface surface = SurfaceToShow(state);
  if (!surface) return;
  const std::string name =
      state.document().scene.tissues[static_cast<std::size_t>(state.tissue)].name;
  state.jobs.Start(what + " " + name, [=, mend = std::move(mend)](const Progress& progress) {
    std::string words;
    SharedSurface mended = Share(mend(*surface, &words, progress));
    return [=](EditorState& now) {
      const auto& surfaces = now.document().surfaces;
      const auto found = std::find(surfaces.begin(), surfaces.end(), surface);
      if (found == surfaces.end()) return;  // removed or replaced meanwhile
      const auto at = static_cast<std::size_t>(found - surfaces.begin());
      const bool had_mesh = !now.document().scene.tissues[at].mesh.empty();
      Edit(now, what + " " + name, "", [&](authoring::Document& next) {
        next.surfaces[at] = mended;
        next.scene.tissues[at].mesh.clear();
      });
      now.message =
          fmt::format("{}: {}.{}", name, words, had_mesh ? " Make its tetrahedra anew." : "");
    };
  });
}

}  // namespace

bool KeepFaultsFresh(EditorState& state) {
  FaultBoard& board = *state.steps.tissue->faults;
  const bool has_changed = board.jobs.busy() && board.jobs.Finish(state);
  const SharedSurface surface = SurfaceToShow(state);
  if (board.jobs.busy() || !surface || board.of == surface) return has_changed;
  board.jobs.Start("Check the surface", [surface](const Progress& progress) {
    auto found = std::make_shared<const authoring::SurfaceFaults>(
        authoring::FindSurfaceFaults(*surface, progress));
    return [surface, found](EditorState& now) {
      now.steps.tissue->faults->of = surface;
      now.steps.tissue->faults->found = found;
    };
  });
  return has_changed;
}

std::shared_ptr<const authoring::SurfaceFaults> FaultsOfChosen(const EditorState& state) {
  const FaultBoard& board = *state.steps.tissue->faults;
  const SharedSurface surface = SurfaceToShow(state);
  return surface && board.of == surface ? board.found : nullptr;
}

std::shared_ptr<const authoring::SurfaceFaults> ShownFaults(const EditorState& state) {
  return state.steps.tissue->page == TissuePage::kMesh ? FaultsOfChosen(state) : nullptr;
}

bool CanMendTissue(const EditorState& state) {
  const auto found = FaultsOfChosen(state);
  return found && found->CanBeMended() && !state.jobs.busy();
}

bool CanMakeLayer(const EditorState& state) {
  const auto found = FaultsOfChosen(state);
  return found && found->Has(authoring::FaultKind::kSheet) && !state.jobs.busy();
}

void MendTissue(EditorState& state) {
  Replace(state, "Mend",
          [](const SurfaceMesh& surface, std::string* words, const Progress& progress) {
            return authoring::MendSurface(surface, words, progress);
          });
}

void MakeTissueLayer(EditorState& state) {
  Replace(state, "Make a layer of",
          [thickness = state.steps.tissue->faults->thickness](
              const SurfaceMesh& surface, std::string* words, const Progress& progress) {
            *words = fmt::format("a layer of {:.1f} mm", MmFromMetres(thickness));
            return authoring::MakeLayer(surface, thickness, progress);
          });
}

glm::dvec3 ColourOf(authoring::FaultKind kind) {
  using authoring::FaultKind;
  switch (kind) {
    case FaultKind::kUntidy:
      return {0.75, 0.55, 0.95};
    case FaultKind::kHole:
      return {0.30, 0.85, 0.45};
    case FaultKind::kSheet:
      return {0.30, 0.70, 1.00};
    case FaultKind::kBranching:
      return {1.00, 0.55, 0.15};
    case FaultKind::kCrossing:
      return {1.00, 0.25, 0.25};
    case FaultKind::kSliver:
      break;
  }
  return {1.00, 0.90, 0.30};
}

}  // namespace arthro::app
