// View of a flat wall or of the small joint, with disturbances.
#pragma once

#include <algorithm>
#include <cstdint>

#include <glm/vec2.hpp>

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

// Pixels that differ between two pictures, and those of them where no change is expected.
struct ChangedPixels {
  int all = 0, elsewhere = 0;
};
// `is_expected` takes a place in the window, right and up, in window radii.
template <class IsExpected>
ChangedPixels ChangedBetween(const ColourImage& before, const ColourImage& after,
                             const IsExpected& is_expected) {
  ChangedPixels changed;
  const double half = 0.5 * after.width;
  for (int y = 0; y < after.height; ++y)
    for (int x = 0; x < after.width; ++x) {
      if (std::equal(after.at(x, y), after.at(x, y) + 3, before.at(x, y))) continue;
      ++changed.all;
      changed.elsewhere +=
          is_expected(glm::dvec2((x + 0.5) / half - 1.0, 1.0 - (y + 0.5) / half)) ? 0 : 1;
    }
  return changed;
}

inline ColourImage Grey(std::uint8_t level) {
  ColourImage image(256, 256);
  std::ranges::fill(image.rgb, level);
  return image;
}

}  // namespace arthro::test
