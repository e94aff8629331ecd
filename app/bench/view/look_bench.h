// Statistics of the pictures of a scene beside those of real frames [method.md, Statistics of a
// picture]: 24 fixed poses, drawn as `view` draws them, and up to 24 frames spread over a clip.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "app/view/exposure/picture_statistics.h"
#include "simulation/core/progress.h"
#include "simulation/scene/files/loaded_scene.h"
#include "simulation/scope/rod_pose.h"

namespace arthro::app {

// Poses of the scope over the imaged part of the panorama: the centre of the view lies on a grid of
// four longitudes and three latitudes, from two depths, at the scene's own view angle.
std::vector<simulation::RodPose> LookPoses(const LoadedScene& loaded);

struct LookRow {
  std::string words;  // "scene", "real frames"
  PictureStatistics mean;
  std::vector<PictureStatistics> pictures;
};

struct LookBench {
  std::string scene, frames, drawn_by;
  std::vector<simulation::RodPose> poses;  // those of the pictures of the first row
  std::vector<LookRow> rows;
};

// `frames`: folder of pictures or a clip; empty: none. Throws Error(kDisplay) where nothing can
// draw, and Error for a scene or frames that cannot be read.
LookBench RunLookBench(const std::filesystem::path& scene, const std::filesystem::path& frames,
                       const Progress& progress);

std::string TableOf(const LookBench& bench);
nlohmann::json JsonOf(const LookBench& bench);

}  // namespace arthro::app
