// Scenes from and to files [method.md, Scene]. A scene is a folder with scene.json and the files it
// names by relative path, all in metres. Wherever a scene is asked for, the folder, its scene.json
// or an .arthro archive (archive_io.h) may be given. Faults are Error(kBadScene) that names the
// file, the key and the remedy.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "simulation/scene/image.h"
#include "simulation/scene/lens.h"
#include "simulation/scene/scene.h"
#include "simulation/scene/surface_mesh.h"

namespace arthro {

struct LoadedScene {
  Scene scene;
  std::filesystem::path folder;  // what the scene's paths are relative to
  ColourImage panorama;
  DepthMap depth;                     // same size as the panorama, or empty: a bare sphere
  std::vector<SurfaceMesh> surfaces;  // one a tissue, in its own frame, m
  // Holds the folder that an archive was unpacked into, for as long as its files may be read.
  std::shared_ptr<const void> unpacked;
  std::filesystem::path archive;  // that was unpacked, for messages (NamedByArchive); or empty
  std::optional<Lens> lens;       // of the scope; nothing: equisolid
};

// The values alone, checked. Older versions are brought up to date in memory; a newer one is
// refused by name. Of several faults the first is told, with how many more there are.
Scene ReadScene(const std::filesystem::path& scene);

// The scene with its pictures and surfaces; all files that it names are there, and sizes fit.
// Tetrahedra are read by those who use them.
LoadedScene LoadScene(const std::filesystem::path& scene);

// The same, with every fault as a sentence of its own instead of an exception, so that an author
// can mend all of them at once. With faults, `loaded` holds what could be read.
LoadedScene LoadScene(const std::filesystem::path& scene, std::vector<std::string>& faults);

// Writes scene.json, wholly or not at all; a scene that could not be read back is refused before
// the file is touched.
void WriteScene(const std::filesystem::path& scene_json, const Scene& scene);

// Throws Error(kBadScene) where `name` is a link, or lies behind one, that leaves the folder: a
// copy of the scene would carry a file that has nothing to do with it.
void RequireInFolder(const std::filesystem::path& folder, const std::filesystem::path& name);

// The scene.json that a folder or a file name stands for.
std::filesystem::path SceneFile(const std::filesystem::path& scene);

}  // namespace arthro
