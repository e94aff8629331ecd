// Bundle adjustment of camera poses and points on pixel residuals through the lens, with the portal
// as an optional soft constraint. The frame is the caller's; its unit is free.
#pragma once

#include <atomic>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "authoring/relief/motion/bundle/lens_profile.h"
#include "authoring/relief/motion/bundle/tracks.h"

namespace arthro::authoring {

struct CameraPose {
  Eigen::Matrix3d world_from_camera = Eigen::Matrix3d::Identity();
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();

  Eigen::Vector3d InCamera(const Eigen::Vector3d& point) const {
    return world_from_camera.transpose() * (point - centre);
  }
};

// The point that all shafts pass. A shaft in its camera's frame is
// s(δ) = (sin α sin δ, sin α cos δ, cos α), with α the view angle and δ the turn of the camera
// head.
struct PivotPrior {
  std::vector<Eigen::Vector3d> points;  // more than one where the portal slid
  std::vector<int> point_of;            // one per frame, which of the points its shaft passes
  std::vector<double> head_turns;       // rad, δ, one per frame
  bool head_wanders = false;  // the turns are unknowns, near each other from frame to frame
  double view_angle = 0;      // rad
  double sigma = 1;           // standard deviation of a shaft's miss
};

Eigen::Vector3d ShaftInCamera(double view_angle, double head_turn);

// A 3-D point and which observations of its track belong to it.
struct TrackPoint {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  int track = 0;
  std::vector<bool> uses;  // one per observation of the track
};

struct Reconstruction {
  std::vector<std::optional<CameraPose>> poses;  // one per frame
  std::vector<TrackPoint> points;
};

struct BundleOptions {
  int iterations = 30;
  int fixed_frame = -1;  // the gauge; -1: the first posed frame
  // Ends the adjustment after the iteration at hand once it is set; the caller then stops. May be
  // null.
  const std::atomic<bool>* stop = nullptr;
  double* focal = nullptr;  // factor of the focal length, an unknown if given
};

// Moves poses and points, and the pivot where there is one, with its turns of the head where they
// wander. Returns the rms of the residuals, px.
double AdjustBundle(const std::vector<Track>& tracks, const LensProfile& lens,
                    const BundleOptions& options, Reconstruction& scene, PivotPrior* pivot);

// Refines one pose over points that stay. False where it does not converge.
bool AdjustPose(const std::vector<Eigen::Vector3d>& points,
                const std::vector<Eigen::Vector2d>& pixels, const LensProfile& lens,
                CameraPose& pose);

}  // namespace arthro::authoring
