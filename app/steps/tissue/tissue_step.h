// Step 3: deformable models in the scene; state.tissue is the chosen one.
#pragma once

#include <filesystem>
#include <optional>
#include <span>

#include <glm/vec3.hpp>

#include "app/state/command.h"
#include "authoring/tissue/mesh_budget.h"

namespace arthro::app {

struct Ui;

// Page of the chosen tissue.
enum class TissuePage { kPlace, kMaterial, kMesh, kHold, kCut };
// Meaning of a ball on a tissue: it is held there, or probed there.
enum class BallKind { kHeld, kProbed };

// How the author cuts and names next: what a click on tissue in the overview does on its Cut page.
// Sizes in m of the joint.
struct CutBrush {
  // A tear begins this far outside of the clicked points, so that it is open between them where the
  // surface is round.
  static constexpr double kLead = 1.5e-3;

  enum class Kind { kNone, kTear, kBite, kRegion } kind = Kind::kNone;
  double depth = 8e-3;  // deeper than a meniscus is thick: through
  double width = 6e-4, radius = 1.7e-3, region_radius = 5e-3;
  // The first point of a tear that has no second one yet.
  std::optional<glm::dvec3> start;
  int start_tissue = -1;
  bool goes_on = false;  // the next point lengthens the chosen tear
};

struct TissueStep {
  TissuePage page = TissuePage::kPlace;
  int ball = -1;                  // chosen one of those that the page is about, -1 none
  std::optional<BallKind> brush;  // a click on tissue in the overview puts a ball there
  double ball_radius = 2e-3;      // m, of the next one
  CutBrush cut_brush;
  int cut = -1, region = -1;   // chosen one of its `cuts` or `regions`, -1 none
  bool shows_sources = false;  // sources of the material's values are listed
  authoring::MeshSize mesh_size = authoring::MeshSize::kDefault;
  std::filesystem::path preset_folder;
};
std::span<const Command> TissueCommands();
void TissuePanel(Ui& ui, EditorState& state);
void TissueCutFields(Ui& ui, EditorState& state, const Tissue& tissue);  // its Cut page
void BallFields(Ui& ui, EditorState& state, const Tissue& tissue, BallKind kind);

}  // namespace arthro::app
