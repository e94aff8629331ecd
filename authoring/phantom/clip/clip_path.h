// Where the scope is at each moment of a clip. The plane is the panorama: x right, y down, unit one
// panorama pixel; the scope stands `distance` in front of it. Camera frame as in scene/lens.h.
#pragma once

#include <opencv2/core.hpp>

#include "authoring/phantom/clip/clip_options.h"

namespace arthro::authoring {

struct ScopePose {
  cv::Point2d at;       // the foot of the scope's perpendicular on the plane, px
  double distance = 0;  // px
  cv::Matx33d plane_from_camera = cv::Matx33d::eye();  // a rotation
};

// Takes homogeneous (x, y, 1) on a camera's plane at unit distance to panorama pixels.
cv::Matx33d PanoramaFromRay(const ScopePose& pose);

// About x, then y, then z; rad.
cv::Matx33d RotationOf(double x, double y, double z);

class ClipPathway {
 public:
  // On a plane of `world` px, with a window of `radius` px and a lens of `focal` px. A frame at the
  // nominal distance shows the plane one to one in its middle.
  ClipPathway(const ClipOptions& options, cv::Size2d world, double radius, double focal);

  // During the exposure of `frame`; `t` in frames, near `frame`.
  ScopePose At(double t, int frame) const;

  // Counts the plane's pixels from `origin` on.
  void MoveOrigin(cv::Point2d origin) { centre_ -= origin; }

 private:
  struct Wave {
    double amplitude = 0, slow = 0, fast = 0, phase = 0, phase_fast = 0;
    double At(double t) const;
  };
  cv::Point2d PlaceAt(double t) const;

  ClipOptions options_;
  double radius_ = 0, focal_ = 0;
  cv::Point2d centre_, reach_;  // reach: half the room that the middle of a frame may use
  cv::Point2d jump_;
  Wave tilt_x_, tilt_y_, turn_, zoom_;
  double start_ = 0;      // rad, where a loop begins
  double phase_[4] = {};  // of a wander
  double wander_scale_ = 1;
};

}  // namespace arthro::authoring
