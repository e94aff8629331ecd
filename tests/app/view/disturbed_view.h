// View of a flat wall or of the small joint, with disturbances.
#pragma once

#include <algorithm>
#include <cstdint>

#include "app/view/drawing/disturbances.h"
#include "tests/app/view/view_scene.h"

namespace arthro::test {

inline constexpr int kDisturbedSize = 256;

class DisturbedView : public ViewTest {
 protected:
  // A panorama seen along its middle from 10 mm behind the portal, with every place at one
  // distance.
  void ShowWall(const ColourImage& panorama, double distance) {
    Backdrop backdrop = MakeViewScene(16, 16).scene.backdrop;
    backdrop.projection.centre_px = {(panorama.width - 1) / 2.0, (panorama.height - 1) / 2.0};
    backdrop.projection.focal_px = 0.3 * panorama.width;
    const auto relief = static_cast<float>(backdrop.radius - kTip - distance);
    view_->SetBackdrop(panorama, DepthMap(panorama.width, panorama.height, relief), backdrop);
  }
  void ShowJoint() {
    const LoadedScene loaded = MakeViewScene();
    view_->SetBackdrop(*loaded.panorama, *loaded.depth, loaded.scene.backdrop);
    view_->SetTissues(loaded.scene.tissues, loaded.surfaces);
  }
  ColourImage Draw(const app::Disturbances& disturbances, int size = kDisturbedSize) {
    picture_.disturbances = disturbances;
    view_->Render(picture_, size);
    return view_->ReadPixels();
  }

  static constexpr double kTip = 2e-3;
  app::Picture picture_ = app::PictureFromPose({0, 0, 0, kTip}, 0.0, 1.4);
};

inline ColourImage Grey(std::uint8_t level) {
  ColourImage image(256, 256);
  std::ranges::fill(image.rgb, level);
  return image;
}

}  // namespace arthro::test
