// Truth of a clip of a cavity: the surface about the portal, and the pose of every frame. Portal
// frame, m.
#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include <Eigen/Core>

#include "authoring/relief/motion/bundle/bundle.h"
#include "simulation/scene/lens.h"
#include "tests/support/relief/cavity_clip.h"

namespace arthro::test {

struct CavityTruth {
  std::function<double(const Eigen::Vector3d&)> radius;  // m, along a unit direction
  std::vector<authoring::CameraPose> poses;              // one per frame
  Lens lens;                                             // lens of the pictures
  double view_angle = kViewAngle;                        // rad
  Eigen::Vector3d portal = Eigen::Vector3d::Zero();      // mean over the frames: skin gives
};

CavityTruth TruthOf(const CavityOptions& options);

// Truth of a clip in a folder: gt.json with the poses, radius.npy with the surface (float32 or
// float64, azimuthal equidistant about +z, 6 px per degree) and lens.json. Throws Error(kBadData).
CavityTruth ReadCavityTruth(const std::filesystem::path& folder);

// Does a frame see the surface in this direction: inside the round window, and not hidden?
bool Sees(const CavityTruth& truth, std::size_t frame, const Eigen::Vector3d& direction);

}  // namespace arthro::test
