// Camera of the rectified frames: the geometry of their RectifiedView.
#pragma once

namespace arthro::authoring {

struct Pinhole {
  double focal_px = 0, cx = 0, cy = 0;  // rectified frames at scale 1
};

}  // namespace arthro::authoring
