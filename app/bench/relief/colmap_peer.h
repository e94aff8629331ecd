// COLMAP on the frames of a clip, for comparison: poses and points of its largest model. It is used
// where it is installed, as a program of its own. Source: Schönberger and Frahm,
// Structure-from-Motion Revisited, 2016, doi:10.1109/CVPR.2016.445.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "authoring/relief/relief_report.h"
#include "simulation/core/progress.h"
#include "simulation/scene/lens.h"

namespace arthro::app {

struct ColmapModel {
  std::string outcome = "done";               // or why there is no model
  std::vector<authoring::PosedFrame> frames;  // those with a pose, by their place in the folder
  std::vector<Eigen::Vector3d> points;        // in the frame and unit of the poses
  double cpu_ms = 0;                          // user and system time of all its steps
};

// First executable of that name in the folders of `path`, which are separated by colons.
std::optional<std::filesystem::path> FindProgram(std::string_view name, std::string_view path);

// `footage`: folder of pictures, which it takes in the order of their names. The lens must be
// equisolid; it is kept. Features are found at a low threshold, without which COLMAP poses few
// frames of smooth tissue. Throws Error(kCancelled).
ColmapModel RunColmap(const std::filesystem::path& program, const std::filesystem::path& footage,
                      const Lens& lens, const Progress& progress);

// Text model of COLMAP: images.txt and points3D.txt. `names`: of the frames, in their order.
ColmapModel ReadColmapModel(const std::filesystem::path& folder,
                            const std::vector<std::string>& names);

}  // namespace arthro::app
