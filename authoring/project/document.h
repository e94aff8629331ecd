// An author's scene with the options that its parts were made with. A copy is cheap, since heavy
// parts are shared (simulation/scene/files/loaded_scene.h).
#pragma once

#include "authoring/depth/depth_options.h"
#include "authoring/depth/strokes/depth_stroke.h"
#include "authoring/project/footage_record.h"
#include "simulation/scene/files/loaded_scene.h"

namespace arthro::authoring {

struct Document : LoadedScene {
  // Compiled once, in document.cpp, since most sources copy scenes.
  Document();
  Document(const Document&);
  Document(Document&&) noexcept;
  Document& operator=(const Document&);
  Document& operator=(Document&&) noexcept;
  ~Document();

  DepthOptions depth_options;
  // Strokes that mended the depth map, in order; null: none. The map holds their effect.
  SharedStrokes depth_strokes;
  bool is_depth_imported = false;  // the depth map was not made from panorama and depth_options
  std::shared_ptr<const FootageRecord> footage;  // how the panorama was made; null: not known
};

}  // namespace arthro::authoring
