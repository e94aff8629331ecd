// Frames of the files from which surfaces were imported: surfaces of one knee lie in one frame, so
// that a further one can be placed where it belongs beside the others, and all can be moved
// together. Kept while the window is open. m.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/state/editor_state.h"

namespace arthro::app {

struct ImportFrame {
  std::weak_ptr<const SurfaceMesh> surface;
  std::filesystem::path folder;  // folder of its file
  glm::dvec3 origin{0.0};        // m, the own frame's origin in the file
  int group = 0;                 // equal for surfaces that keep their places to one another
};

struct ImportFrames {
  std::vector<ImportFrame> frames;
  bool keeps_place = false;     // the next import lies beside the one that PartnerOfImport names
  bool moves_together = false;  // a group is placed as one
};

// Tissue of the scene beside which an import keeps its place: the chosen one, or the last one that
// was imported; -1: none.
int PartnerOfImport(const EditorState& state);
// True for a file of the same folder that lies within a joint's size of the partner's.
bool IsLikelyPartner(const EditorState& state, const std::filesystem::path& file,
                     const SurfaceMesh& surface, double metres_per_unit);
const ImportFrame* FrameOf(const EditorState& state, int tissue);
// The new surface stands for the old one.
void KeepImportFrame(EditorState& state, const std::shared_ptr<const SurfaceMesh>& old,
                     const std::shared_ptr<const SurfaceMesh>& now);

// The other tissues of its group.
std::vector<int> ImportedTogether(const EditorState& state, int tissue);
// Sets the pose of a tissue, and moves those of its group by the same motion where the author
// wants that; `what` begins the name of the step.
void PlaceTissue(EditorState& state, int tissue, const Pose& pose, const std::string& what);

}  // namespace arthro::app
