// Phantom as a folder: a whole scene (scene.json, panorama, depth.tiff, meniscus.ply,
// cartilage.ply), the ground truth (truth.json, panorama_with_tissue, depth_with_tissue.tiff) and
// trace.csv. Depths are relief in m.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "authoring/phantom/phantom.h"
#include "simulation/scene/scene.h"

namespace arthro::authoring {

// Throws Error(kFile) unless `folder` is new, empty, or holds nothing but an earlier phantom, which
// a phantom may replace. Called before the work starts, so that a refusal costs no time.
void RequirePhantomFolder(const std::filesystem::path& folder);

// Writes more files into the folder and returns their description for "footage" in truth.json; null
// without any. See clip/phantom_footage.h.
using FootageWriter = std::function<nlohmann::json(const std::filesystem::path& folder)>;

// Writes all files or none: into a temporary folder beside, which then takes the name.
void WritePhantom(const std::filesystem::path& folder, const Phantom& phantom,
                  const FootageWriter& footage = {});

Scene SceneOf(const Phantom& phantom);
nlohmann::json TruthOf(const Phantom& phantom);
std::string TraceCsv(const Phantom& phantom);

}  // namespace arthro::authoring
