// Clicks into the overview that place a tissue by landmarks at a pose that is known beforehand: the
// scene points form the same triangle on the relief as the model points on the surface. Portal
// frame, m; clicks in px from the middle of the overview, which is fitted to a backdrop.
#pragma once

#include <string>
#include <vector>

#include <glm/vec2.hpp>

#include "authoring/alignment/landmark_alignment.h"
#include "simulation/scene/files/loaded_scene.h"

namespace arthro::test {

// The overview after *Fit*, `width` x `height` px at scale 1 (app/view/overview/overview.cpp).
class OverviewEye {
 public:
  OverviewEye(double backdrop_radius, int width, int height);
  authoring::Sight Through(const glm::ivec2& from_middle) const;
  int width() const { return width_; }
  int height() const { return height_; }

 private:
  glm::dvec3 position_, right_, down_, forward_;
  double focal_px_;
  int width_, height_;
};

struct LandmarkClicks {
  Pose portal_from_tissue;  // the pose on which the pairs agree
  double misfit = 0;        // m, largest difference of two sides of the triangles
  // First the point of the model, then its place on the relief.
  struct Pair {
    glm::ivec2 model{0}, scene{0};
  };
  std::vector<Pair> pairs;
  std::string Script() const;  // two clicks per pair
};

// Three pairs for a tissue at `scale` times its present size. Prefers the pose that turns it least.
LandmarkClicks ClicksToPlace(const LoadedScene& scene, int tissue, double scale,
                             const OverviewEye& eye);

}  // namespace arthro::test
