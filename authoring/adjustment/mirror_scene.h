// The same scene for the other knee: backdrop, relief, tissues, cuts, portals and side, mirrored in
// the plane x = 0 of the portal frame.
#pragma once

#include <filesystem>
#include <functional>

#include "authoring/project/document.h"
#include "simulation/scene/mesh/tet_mesh.h"

namespace arthro::authoring {

// Gives the name of a new file that outlives the document's next save.
using NewFile = std::function<std::filesystem::path(const std::filesystem::path& name)>;

// Mirrored twice, a scene is what it was, bit by bit: each number changes its sign, or is measured
// from the other edge of the picture, which is exact for a projection whose centre is a multiple of
// kCentreStep. Another centre is rounded to it at the first time. The lens and the devices' mounts
// belong to the room and stay. Titles and texts stay as they are written. Throws Error for
// tetrahedra that cannot be read.
inline constexpr double kCentreStep = 1.0 / 1024;  // px
void MirrorScene(Document& document, const NewFile& new_file);

TetMesh Mirrored(TetMesh mesh);

}  // namespace arthro::authoring
