// The camera that rectified frames were taken with: their RectifiedView, as far as geometry goes.
#pragma once

namespace arthro::authoring {

struct Pinhole {
  double focal_px = 0, cx = 0, cy = 0;  // of the rectified frames at scale 1
};

}  // namespace arthro::authoring
