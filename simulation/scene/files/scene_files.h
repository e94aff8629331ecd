// Files that a scene names, relative to its folder. Whoever packs, copies or guards a scene asks
// here, so that a new field is not forgotten by one of them.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "simulation/scene/scene.h"

namespace arthro {

// Key of a scene that names an imported depth map as it was before strokes mended it: an object of
// the names of its files, "depth", "sigma" and "origin".
inline constexpr const char* kUnmendedDepthKey = "x-depth-unmended";
// Those files by these words; none where the key is missing or holds something else.
std::map<std::string, std::filesystem::path> UnmendedFilesOf(const Scene& scene);

// File of an exercise: the key that names it, and the name itself in the scene.
struct ExerciseFile {
  std::string key;
  std::filesystem::path* name = nullptr;
  bool is_picture = false;  // false: the recording of an expert
};
// Files that the exercises name. The names can be changed.
std::vector<ExerciseFile> ExerciseFilesOf(Scene& scene);

// Panorama, depth map with its standard error and origins, also as it was before strokes, lens,
// surfaces, meshes, and pictures and recordings of exercises, as the scene writes them; empty ones
// left out.
std::vector<std::filesystem::path> FilesNamedBy(const Scene& scene);

}  // namespace arthro
