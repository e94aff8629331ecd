// Step 3: deformable models in the scene; state.tissue is the chosen one.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <set>
#include <span>
#include <string>

#include <glm/vec3.hpp>

#include "app/state/command.h"
#include "app/state/owned.h"
#include "app/steps/tissue/hand_placing.h"
#include "app/steps/tissue/landmark_mode.h"
#include "authoring/tissue/tetrahedra/mesh_budget.h"
#include "simulation/scene/mesh/surface_mesh.h"

namespace arthro::app {

struct Ui;
struct FaultBoard;
struct ImportFrames;
struct ModelShelf;
struct SolidEditing;

// Page of the chosen tissue.
enum class TissuePage { kPlace, kSolid, kMaterial, kMesh, kHold, kCut };
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
  std::set<std::string> hidden;  // names of tissues that the author's views leave out
  LandmarkMode landmarks;
  HandPlacing placing;
  Owned<ModelShelf> shelf;      // library of models and tears (tissue_library.h)
  Owned<SolidEditing> solids;   // the chosen solid and its part (app/steps/solids)
  Owned<FaultBoard> faults;     // faults of its surface (fault_board.h)
  Owned<ImportFrames> imports;  // frames of imported surfaces (import_frames.h)
  int cut = -1, region = -1;    // chosen one of its `cuts` or `regions`, -1 none
  bool shows_sources = false;   // sources of the material's values are listed
  authoring::MeshSize mesh_size = authoring::MeshSize::kDefault;
  std::filesystem::path preset_folder;
};
std::span<const Command> TissueCommands();
std::span<const Command> LibraryCommands();
std::span<const Command> CutCommands();
std::span<const Command> PlacingCommands();
// True where commands may change a tissue that is chosen.
bool IsTissueChosen(const EditorState& state);
// `below_poke`: fields below those of the poke while it runs.
void TissuePanel(Ui& ui, EditorState& state, const std::function<void()>& below_poke);
void TissueCutFields(Ui& ui, EditorState& state, const Tissue& tissue);  // its Cut page
void TissueLibraryFields(Ui& ui, EditorState& state);
void TissueTearFields(Ui& ui, EditorState& state);  // kinds of tears, on the Cut page
void SolidFields(Ui& ui, EditorState& state);       // parts of the chosen solid
void BallFields(Ui& ui, EditorState& state, const Tissue& tissue, BallKind kind);

// The eye of the list of tissues. A practice and an exercise show every tissue.
bool IsHiddenByAuthor(const EditorState& state, int tissue);
void ToggleHidden(EditorState& state, int tissue);

// Asks for the file, then for its unit.
void BrowseForSurface(EditorState& state);
// Reads the file beside the window, then asks for its unit; a likely one is chosen already.
void AskForUnit(EditorState& state, const std::filesystem::path& file);
// Adds a tissue named after the file, on the relief in the middle of the view, or beside the tissue
// with which it keeps its place. Vertices in `unit`: m, cm, mm, um or in. `tetrahedra` that the
// file had beside the surface are kept as those of the tissue; null: none.
void ImportSurface(EditorState& state, const std::filesystem::path& file, SurfaceMesh mesh,
                   const std::string& unit, const TetMesh* tetrahedra = nullptr);
// True where the relief hides nearly all of it from the scope's portal.
bool IsHidden(const EditorState& state, int tissue);
// Moves the chosen tissue to where an imported one is laid, in the middle of the view.
void BringBeforeScope(EditorState& state);
// Makes tetrahedra of the chosen tissue, beside the window.
void TetrahedraliseTissue(EditorState& state);

// Fills state.tissue_presets from state.steps.tissue->preset_folder, once. A fault becomes a
// dialog.
void LoadTissuePresets(EditorState& state);

// The tissue's preset with its own values; nothing where its word is not known.
std::optional<simulation::TissuePreset> PresetOf(const EditorState& state, const Tissue& tissue);

// Another preset; what was said otherwise goes.
void ChoosePreset(EditorState& state, int tissue, const std::string& name);
// The same preset, other values. One that is the preset's own is not kept as said otherwise.
void SetElasticity(EditorState& state, int tissue, Elasticity elasticity, const std::string& what);

// A solid that does not give way is touched as a function; it has no tetrahedra, so those that it
// has are left out with the same step.
void SetSolid(EditorState& state, int tissue, bool is_solid);

}  // namespace arthro::app
