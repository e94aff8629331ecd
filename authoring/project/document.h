// An author's scene with the options that its parts were made with. A copy is cheap, since heavy
// parts are shared (simulation/scene/files/loaded_scene.h).
#pragma once

#include "authoring/depth/depth_options.h"
#include "authoring/depth/strokes/depth_stroke.h"
#include "authoring/project/footage_record.h"
#include "simulation/scene/files/loaded_scene.h"

namespace arthro::authoring {

// An imported depth map as it was before the strokes, and the files that hold it. Without a depth
// no stroke was made, or the scene is one whose map holds its strokes for good.
struct UnmendedDepth {
  std::shared_ptr<const DepthMap> depth, sigma;
  std::shared_ptr<const OriginMap> origin;
  std::filesystem::path depth_file, sigma_file, origin_file;
};

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
  UnmendedDepth unmended;          // imported map before its strokes
  bool is_depth_imported = false;  // the depth map was not made from panorama and depth_options
  std::shared_ptr<const FootageRecord> footage;  // how the panorama was made; null: not known
};

}  // namespace arthro::authoring
