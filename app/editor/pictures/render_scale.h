// How a picture is drawn while things move, from how long frames take: as finely as they keep to
// kFrameTime. First the features of the camera step back one by one, then the resolution; the
// geometry of the picture never does. It changes in steps and reluctantly, since a change of
// resolution makes the picture's textures anew and shows.
#pragma once

#include <array>
#include <cstddef>

#include "app/view/drawing/picture.h"

namespace arthro::app {

class RenderScale {
 public:
  static constexpr double kFrameTime = 1.0 / 30;  // s

  // Share of the full edge, 0.5 to 1.
  double value() const;
  CameraFeatures features() const;
  // Even a steady picture of full size would keep the user waiting.
  bool is_slow() const { return step_ > 0; }
  // A frame that drew a picture at value() took so long, handing over included, s. What is no time
  // is passed over.
  void Note(double seconds);

 private:
  // The median of so many frames counts: a frame that had to load something is not the rule.
  static constexpr std::size_t kFrames = 5;

  int step_ = 0;
  std::array<double, kFrames> seconds_{};
  std::size_t noted_ = 0;  // since the last change
};

}  // namespace arthro::app
