#include <algorithm>
#include <cctype>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "app/state/edits.h"
#include "app/steps/tissue/import_frames.h"
#include "app/steps/tissue/tissue_step.h"
#include "authoring/alignment/place_by_hand.h"
#include "authoring/models/model_in_scene.h"
#include "authoring/project/files/file_ending.h"
#include "authoring/tissue/likely_unit.h"
#include "authoring/tissue/tetrahedra/mesh_budget.h"
#include "simulation/core/folders/file_name.h"
#include "simulation/core/units.h"
#include "simulation/scene/backdrop/hidden_share.h"
#include "simulation/scene/mesh/mesh_io.h"
#include "simulation/scene/mesh/tet_surface.h"
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

// On the relief in the middle of the view; before the scope where nothing was imaged.
Pose PoseOfImport(const EditorState& state, const SurfaceMesh& surface) {
  const authoring::Document& document = state.document();
  const auto view = simulation::ViewFromPose(state.scope, document.scene.scope.view_angle);
  Pose pose;
  pose.position = PlaceBeforeScope(state);
  constexpr double kReach = 4e-3;  // m, over which the relief's normal is averaged
  const auto point = authoring::FindOnRelief(document, view.tip, view.view, kReach);
  if (!point) return pose;
  // An open sheet is laid with the side to the portal that its triangles face; the mean normal of
  // a closed surface is zero.
  const glm::dvec3 facing = authoring::FacingOf(surface);
  if (glm::dot(facing, view.view) > 0) {
    const glm::dvec3 axis =
        glm::cross(facing, std::abs(facing.x) < 0.7 * glm::length(facing) ? glm::dvec3(1, 0, 0)
                                                                          : glm::dvec3(0, 1, 0));
    pose.quaternion = glm::angleAxis(std::numbers::pi, glm::normalize(axis));
  }
  pose =
      authoring::LaidOnRelief(authoring::MakeReliefTarget(document), surface, pose, point->place);
  return authoring::Uncovered(surface, pose, document, point->normal, view.view);
}

// Word of a preset that a file's name holds, such as "cartilage"; empty: none.
std::string MaterialInName(const EditorState& state, std::string name) {
  for (char& c : name) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  for (const simulation::TissuePreset& preset : state.tissue_presets)
    for (const std::string& word : preset.words)
      if (name.find(word) != std::string::npos) return word;
  return "";
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
         {{"Surfaces", {".stl", ".obj", ".ply", ".off", ".vtp", ".vtu"}}, {"All files", {}}},
         AskForUnit);
}

void AskForUnit(EditorState& state, const fs::path& file) {
  state.jobs.Start("Read " + file.filename().string(), [file](const Progress&) {
    std::shared_ptr<const TetMesh> tetrahedra;
    if (authoring::LowerExtension(file) == ".vtu")
      tetrahedra = std::make_shared<const TetMesh>(ReadTetMesh(file));
    auto surface = std::make_shared<const SurfaceMesh>(tetrahedra ? SurfaceOf(*tetrahedra)
                                                                  : ReadSurface(file, 1.0));
    const double longest_side = authoring::LongestSide(*surface);
    return [dialog = UnitDialog{file, surface, tetrahedra, longest_side,
                                authoring::LikelyUnit(longest_side)}](EditorState& now) {
      now.steps.tissue->imports->keeps_place = IsLikelyPartner(
          now, dialog.file, *dialog.surface, MetresPerUnit(dialog.unit).value_or(1.0));
      now.dialogs.push_back(dialog);
    };
  });
}

void ImportSurface(EditorState& state, const fs::path& file, SurfaceMesh mesh,
                   const std::string& unit, const TetMesh* tetrahedra) {
  const double metres_per_unit = MetresPerUnit(unit).value_or(1.0);
  ImportFrames& imports = *state.steps.tissue->imports;
  const int partner = imports.keeps_place ? PartnerOfImport(state) : -1;
  authoring::ImportFrame frame;
  Tissue tissue;
  tissue.name = file.stem().string();
  if (const std::string material = MaterialInName(state, tissue.name); !material.empty())
    tissue.material = material;
  if (partner >= 0) {
    const authoring::ImportFrame beside = *FrameOf(state, partner);
    frame.origin = beside.origin;
    frame.group = beside.group;
    tissue.pose = state.document().scene.tissues[static_cast<std::size_t>(partner)].pose;
  } else {
    // Its own origin becomes its middle, so that turning turns it on the spot.
    frame.origin = metres_per_unit * authoring::MiddleOf(mesh);
    for (const authoring::ImportFrame& other : authoring::NotesOf(state.document().scene).imports)
      frame.group = std::max(frame.group, other.group + 1);
  }
  for (auto& x : mesh.vertices) x = metres_per_unit * x - frame.origin;
  if (partner < 0) tissue.pose = PoseOfImport(state, mesh);
  fs::path mesh_file;  // until the scene is saved, beside the window
  if (tetrahedra != nullptr) {
    TetMesh own = *tetrahedra;
    for (auto& x : own.rest_positions) x = metres_per_unit * x - frame.origin;
    mesh_file = state.scratch.NewFile(FileNameFrom(tissue.name, "tissue") + ".vtu");
    WriteTetMesh(mesh_file, own);
  }
  AddImported(state, std::move(tissue), std::make_shared<const SurfaceMesh>(std::move(mesh)), frame,
              mesh_file);
  imports.folders[state.document().scene.tissues.back().name] = file.parent_path();
  state.step = Step::kTissue;
  state.steps.tissue->page = TissuePage::kPlace;  // it is placed before anything else
  if (partner >= 0)
    state.message +=
        fmt::format(", in its place beside {}",
                    state.document().scene.tissues[static_cast<std::size_t>(partner)].name);
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

bool IsHiddenByAuthor(const EditorState& state, int tissue) {
  const auto& tissues = state.document().scene.tissues;
  return InEditor(state) && state.step != Step::kPractice && state.step != Step::kExercises &&
         tissue >= 0 && tissue < static_cast<int>(tissues.size()) &&
         state.steps.tissue->hidden.contains(tissues[static_cast<std::size_t>(tissue)].name);
}

void ToggleHidden(EditorState& state, int tissue) {
  std::set<std::string>& hidden = state.steps.tissue->hidden;
  const std::string& name =
      state.document().scene.tissues.at(static_cast<std::size_t>(tissue)).name;
  if (hidden.erase(name) == 0) hidden.insert(name);
}

}  // namespace arthro::app
