// Scenes from and to files [method.md, Scene]. A scene is a folder with scene.json and the files it
// names by relative path, all in metres. Wherever a scene is asked for, the folder, its scene.json
// or an .arthro archive (archive_io.h) may be given. Faults are Error(kBadScene) that names the
// file, the key and the remedy.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "simulation/scene/files/loaded_scene.h"

namespace arthro {

// Values of scene.json alone, checked. An older version is migrated in memory; a newer one is
// refused by name. The message states the first fault and the number of further faults.
Scene ReadScene(const std::filesystem::path& scene);

// Scene with its pictures and surfaces. All files that it names exist, and picture sizes agree.
// Tetrahedra are read where they are used (simulation/practice/living_tissues.h).
LoadedScene LoadScene(const std::filesystem::path& scene);

// The same, but appends one sentence per fault to `faults` instead of throwing, so that an author
// can correct all of them at once. The result holds all parts that could be read.
LoadedScene LoadScene(const std::filesystem::path& scene, std::vector<std::string>& faults);

// Writes scene.json, wholly or not at all; a scene that could not be read back is refused before
// the file is touched.
void WriteScene(const std::filesystem::path& scene_json, const Scene& scene);

// False where `name` is a link, or lies behind one, that leaves the folder or leads nowhere. The
// name need not exist: then the question is where it would be written.
bool IsInFolder(const std::filesystem::path& folder, const std::filesystem::path& name);
// Throws Error(kBadScene) where it is not. A scene reads and writes only what lies in its folder,
// since it may come from a stranger.
void RequireInFolder(const std::filesystem::path& folder, const std::filesystem::path& name);

// The scene.json that a folder or a file name stands for.
std::filesystem::path SceneFile(const std::filesystem::path& scene);

}  // namespace arthro
