// Time of one picture by stage, in s: until OpenGL has finished the stage, not only taken it.
#pragma once

namespace arthro::app {

struct PictureCost {
  double scene = 0;         // backdrop, tissues and instrument
  double occlusion = 0;     // short-range shade
  double disturbances = 0;  // haze, bubbles and the like
  double camera = 0;        // exposure, grain, sharpness, fringe and edges
};

}  // namespace arthro::app
