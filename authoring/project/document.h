// An author's scene with the options that its parts were made with. A copy is cheap, since heavy
// parts are shared (simulation/scene/files/loaded_scene.h).
#pragma once

#include "authoring/depth/depth_options.h"
#include "simulation/scene/files/loaded_scene.h"

namespace arthro::authoring {

struct Document : LoadedScene {
  DepthOptions depth_options;
  bool is_depth_imported = false;  // the depth map was not made from panorama and depth_options
};

}  // namespace arthro::authoring
