// Pose of the scope at each moment of a clip. The plane is the panorama: x right, y down, unit one
// panorama pixel; the scope is `distance` in front of it. Camera frame as in scene/lens.h.
#pragma once

#include <opencv2/core.hpp>

#include "authoring/phantom/clip/clip_options.h"

namespace arthro::authoring {

struct ScopePose {
  cv::Point2d at;       // px, foot of the scope's perpendicular on the plane
  double distance = 0;  // px
  cv::Matx33d plane_from_camera = cv::Matx33d::eye();  // a rotation
};

// Maps homogeneous (x, y, 1) on a camera's plane at unit distance to panorama pixels.
cv::Matx33d PanoramaFromRay(const ScopePose& pose);

// Rotation about x, then y, then z; rad.
cv::Matx33d RotationOf(double x, double y, double z);

class ClipPathway {
 public:
  // Path on a plane of `world` px, with a window of `radius` px and a lens of `focal` px. A frame
  // at the nominal distance shows the middle of the plane at scale 1.
  ClipPathway(const ClipOptions& options, cv::Size2d world, double radius, double focal);

  // Pose during the exposure of `frame`; `t` in frames, near `frame`.
  ScopePose At(double t, int frame) const;

  // Moves the origin of the plane's pixels to `origin`.
  void MoveOrigin(cv::Point2d origin) { centre_ -= origin; }

 private:
  struct Wave {
    double amplitude = 0, slow = 0, fast = 0, phase = 0, phase_fast = 0;
    double At(double t) const;
  };
  cv::Point2d PlaceAt(double t) const;

  ClipOptions options_;
  double radius_ = 0, focal_ = 0;
  cv::Point2d centre_, reach_;  // reach: half the room for the middle of a frame
  cv::Point2d jump_;
  Wave tilt_x_, tilt_y_, turn_, zoom_;
  double start_ = 0;      // rad, start of a loop
  double phase_[4] = {};  // phases of a random path
  double wander_scale_ = 1;
};

}  // namespace arthro::authoring
