// Footage of a phantom: a scope moves over its panorama picture as over a plane, so every frame has
// an exact homography to panorama.png. Includes a grid and the lens, for calibration and
// rectification.
#pragma once

#include <filesystem>

#include "authoring/phantom/clip/clip.h"
#include "authoring/phantom/phantom.h"

namespace arthro::authoring {

struct PhantomFootageOptions {
  int footage_frames = 24;
  template <class V>
  void Visit(V&& v) {
    v("footage_frames", footage_frames, Range{0, 2000}, "",
      "Frames of a clip over the panorama, with its lens, a grid and every frame's truth; 0 writes "
      "none.");
  }
};

Clip FootageClip(const Phantom& phantom, const PhantomFootageOptions& options);

// Writes the phantom (phantom_io.h) with footage/0000.png (or .jpg) …, grid.png and lens.json,
// which truth.json describes as
//   footage:{lens, rectified:{width,height,focal_px,cx,cy},
//            frames:[{file, panorama_from_rectified:[9]}],
//            grid:{file, spacing, pose:{at:[2], distance, board_from_camera:[9]}}}
void WritePhantomWithFootage(const std::filesystem::path& folder, const Phantom& phantom,
                             const PhantomFootageOptions& options, const Progress& progress = {});

}  // namespace arthro::authoring
