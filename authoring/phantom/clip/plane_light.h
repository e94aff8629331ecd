// Light reflected by the plane along one ray of the scope.
#pragma once

#include <algorithm>
#include <cmath>

#include <opencv2/core.hpp>

#include "authoring/phantom/clip/clip_path.h"
#include "authoring/phantom/clip/plane_texture.h"

namespace arthro::authoring {

class PlaneLight {
 public:
  PlaneLight(const PlaneTexture& texture, const ClipOptions& options, double radius, double focal);

  struct View {  // pose in single precision
    cv::Matx33f plane_from_camera;
    float x = 0, y = 0, distance = 0;
  };
  static View ViewOf(const ScopePose& pose);

  // Linear RGB; `off_axis` is the share of half the field of view. `smooth` interpolates by cubics;
  // otherwise linearly, which is sufficient when several samples are averaged.
  cv::Vec3f Along(const View& view, const cv::Vec3f& ray, float off_axis, bool smooth) const;

 private:
  cv::Vec3f AlbedoAt(float x, float y, bool smooth) const;

  const PlaneTexture& texture_;
  float relief_ = 0, per_focal_ = 1, falloff_ = 1, vignette_ = 0, bumps_ = 0, highlights_ = 0;
  bool plain_falloff_ = true;
};

}  // namespace arthro::authoring
