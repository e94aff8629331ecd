// Imported surfaces of one knee lie in one frame (authoring/alignment/placing_notes.h), so that a
// further one can be placed where it belongs beside the others, and all can be moved together. m.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "app/state/editor_state.h"
#include "authoring/alignment/placing_notes.h"

namespace arthro::app {

struct ImportFrames {
  bool keeps_place = false;     // the next import lies beside the one that PartnerOfImport names
  bool moves_together = false;  // a group is placed as one
  // Folder of the file of each tissue that was imported here.
  std::map<std::string, std::filesystem::path> folders;
};

// Tissue of the scene beside which an import keeps its place: the chosen one, or the last one that
// was imported; -1: none.
int PartnerOfImport(const EditorState& state);
// True for a file of the same folder that lies within a joint's size of the partner's.
bool IsLikelyPartner(const EditorState& state, const std::filesystem::path& file,
                     const SurfaceMesh& surface, double metres_per_unit);
std::optional<authoring::ImportFrame> FrameOf(const EditorState& state, int tissue);
// Adds a tissue with its frame, as one step of the history. `mesh`: file of its tetrahedra; empty:
// none.
void AddImported(EditorState& state, Tissue tissue, const SharedSurface& surface,
                 authoring::ImportFrame frame, const std::filesystem::path& mesh = {});

// The other tissues of its group.
std::vector<int> ImportedTogether(const EditorState& state, int tissue);
// Sets the pose of a tissue, and moves those of its group by the same motion where the author
// wants that; `what` begins the name of the step.
void PlaceTissue(EditorState& state, int tissue, const Pose& pose, const std::string& what);

}  // namespace arthro::app
