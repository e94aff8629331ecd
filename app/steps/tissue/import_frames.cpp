#include "app/steps/tissue/import_frames.h"

#include <algorithm>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "app/state/edits.h"
#include "app/steps/tissue/tissue_step.h"
#include "authoring/alignment/place_by_hand.h"
#include "authoring/project/free_tissue_name.h"

namespace arthro::app {
namespace {

constexpr double kJoint = 0.15;  // m; surfaces of one knee lie within this distance

const ImportFrames& FramesOf(const EditorState& state) { return *state.steps.tissue->imports; }

bool HasTissue(const EditorState& state, int tissue) {
  return tissue >= 0 && tissue < static_cast<int>(state.document().scene.tissues.size());
}

}  // namespace

std::optional<authoring::ImportFrame> FrameOf(const EditorState& state, int tissue) {
  if (!HasTissue(state, tissue)) return std::nullopt;
  const Scene& scene = state.document().scene;
  const authoring::PlacingNotes notes = authoring::NotesOf(scene);
  const auto* found =
      authoring::FrameOf(notes, scene.tissues[static_cast<std::size_t>(tissue)].name);
  return found != nullptr ? std::optional(*found) : std::nullopt;
}

int PartnerOfImport(const EditorState& state) {
  if (FrameOf(state, state.tissue)) return state.tissue;
  for (int i = static_cast<int>(state.document().scene.tissues.size()) - 1; i >= 0; --i)
    if (FrameOf(state, i)) return i;
  return -1;
}

bool IsLikelyPartner(const EditorState& state, const std::filesystem::path& file,
                     const SurfaceMesh& surface, double metres_per_unit) {
  const auto frame = FrameOf(state, PartnerOfImport(state));
  if (!frame) return false;
  const auto folder = FramesOf(state).folders.find(frame->tissue);
  return folder != FramesOf(state).folders.end() && folder->second == file.parent_path() &&
         glm::distance(frame->origin, metres_per_unit * authoring::MiddleOf(surface)) < kJoint;
}

void AddImported(EditorState& state, Tissue tissue, const SharedSurface& surface,
                 authoring::ImportFrame frame, const std::filesystem::path& mesh) {
  tissue.name = frame.tissue = authoring::FreeTissueName(state.document().scene, tissue.name);
  Edit(state, "Add " + tissue.name, "", [&](authoring::Document& next) {
    next.scene.tissues.push_back(tissue);
    next.surfaces.push_back(surface);
    if (!mesh.empty()) {
      const std::string name = "tissues/" + mesh.filename().string();
      next.scene.tissues.back().mesh = name;
      next.files[name].file = mesh;
    }
    authoring::PlacingNotes notes = authoring::NotesOf(next.scene);
    authoring::Put(notes, frame);
    authoring::PutNotes(next.scene, notes);
  });
  state.tissue = static_cast<int>(state.document().scene.tissues.size()) - 1;
}

std::vector<int> ImportedTogether(const EditorState& state, int tissue) {
  std::vector<int> others;
  const auto own = FrameOf(state, tissue);
  if (!own) return others;
  const Scene& scene = state.document().scene;
  const authoring::PlacingNotes notes = authoring::NotesOf(scene);
  for (int i = 0; i < static_cast<int>(scene.tissues.size()); ++i) {
    const auto* frame = authoring::FrameOf(notes, scene.tissues[static_cast<std::size_t>(i)].name);
    if (i != tissue && frame != nullptr && frame->group == own->group) others.push_back(i);
  }
  return others;
}

void PlaceTissue(EditorState& state, int tissue, const Pose& pose, const std::string& what) {
  if (!HasTissue(state, tissue)) return;
  Tissue changed = state.document().scene.tissues[static_cast<std::size_t>(tissue)];
  const Pose before = changed.pose;
  const std::vector<int> others =
      FramesOf(state).moves_together ? ImportedTogether(state, tissue) : std::vector<int>{};
  changed.pose = pose;
  if (others.empty() || pose == before) return SetTissue(state, tissue, changed, what);
  const double growth = pose.scale / before.scale;
  const glm::dquat turn = glm::normalize(pose.quaternion * glm::conjugate(before.quaternion));
  Edit(state, what + " " + changed.name + " and what belongs to it",
       "group of " + std::to_string(tissue) + "." + what, [&](authoring::Document& next) {
         next.scene.tissues[static_cast<std::size_t>(tissue)] = changed;
         for (const int i : others) {
           Pose& other = next.scene.tissues[static_cast<std::size_t>(i)].pose;
           other.position = pose.position + growth * (turn * (other.position - before.position));
           other.quaternion = glm::normalize(turn * other.quaternion);
           other.scale *= growth;
         }
       });
}

}  // namespace arthro::app
