#include "app/steps/tissue/import_frames.h"

#include <algorithm>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "app/state/edits.h"
#include "app/steps/tissue/tissue_step.h"
#include "authoring/alignment/place_by_hand.h"

namespace arthro::app {
namespace {

constexpr double kJoint = 0.15;  // m; surfaces of one knee lie within this distance

const ImportFrames& FramesOf(const EditorState& state) { return *state.steps.tissue->imports; }

bool HasTissue(const EditorState& state, int tissue) {
  return tissue >= 0 && tissue < static_cast<int>(state.document().scene.tissues.size());
}

}  // namespace

const ImportFrame* FrameOf(const EditorState& state, int tissue) {
  if (!HasTissue(state, tissue)) return nullptr;
  const auto& surface = state.document().surfaces[static_cast<std::size_t>(tissue)];
  for (const ImportFrame& frame : FramesOf(state).frames)
    if (surface && frame.surface.lock() == surface) return &frame;
  return nullptr;
}

int PartnerOfImport(const EditorState& state) {
  if (FrameOf(state, state.tissue) != nullptr) return state.tissue;
  for (int i = static_cast<int>(state.document().scene.tissues.size()) - 1; i >= 0; --i)
    if (FrameOf(state, i) != nullptr) return i;
  return -1;
}

bool IsLikelyPartner(const EditorState& state, const std::filesystem::path& file,
                     const SurfaceMesh& surface, double metres_per_unit) {
  const ImportFrame* frame = FrameOf(state, PartnerOfImport(state));
  return frame != nullptr && frame->folder == file.parent_path() &&
         glm::distance(frame->origin, metres_per_unit * authoring::MiddleOf(surface)) < kJoint;
}

void KeepImportFrame(EditorState& state, const std::shared_ptr<const SurfaceMesh>& old,
                     const std::shared_ptr<const SurfaceMesh>& now) {
  auto& frames = state.steps.tissue->imports->frames;
  const auto found = std::find_if(frames.begin(), frames.end(), [&](const ImportFrame& frame) {
    return frame.surface.lock() == old;
  });
  if (found == frames.end()) return;
  ImportFrame frame = *found;
  frame.surface = now;
  frames.push_back(frame);
}

std::vector<int> ImportedTogether(const EditorState& state, int tissue) {
  std::vector<int> others;
  const ImportFrame* own = FrameOf(state, tissue);
  if (own == nullptr) return others;
  for (int i = 0; i < static_cast<int>(state.document().scene.tissues.size()); ++i) {
    const ImportFrame* frame = i == tissue ? nullptr : FrameOf(state, i);
    if (frame != nullptr && frame->group == own->group) others.push_back(i);
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
