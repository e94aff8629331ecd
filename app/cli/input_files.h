// Files that an input of a job stands for beside itself: those of a scene, or the frames of
// footage.
#pragma once

#include <filesystem>
#include <vector>

#include "app/cli/job_files.h"

namespace arthro::app {

// scene.json and every file that it names, or the archive. A scene that cannot be read names
// nothing; the job says so itself.
std::vector<std::filesystem::path> FilesOfScene(const std::filesystem::path& scene);

// Every frame of a folder or pattern, or the video.
std::vector<std::filesystem::path> FilesOfFootage(const std::filesystem::path& footage);
// True for a file that would be a frame in a folder of footage, judged by its name.
bool IsFrameName(const std::filesystem::path& file);

inline constexpr InputKind kSceneInput{FilesOfScene, nullptr};
inline constexpr InputKind kFootageInput{FilesOfFootage, IsFrameName};

}  // namespace arthro::app
