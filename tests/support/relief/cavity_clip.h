// A small three-dimensional cavity with known truth: a textured surface about the portal, seen by
// an oblique scope that turns about it [method.md, Frames]. As tracks without pictures, and as
// pictures.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "authoring/relief/bundle.h"
#include "authoring/relief/tracks.h"
#include "simulation/scene/lens.h"

namespace arthro::test {

enum class ScopeMotion { kSweep, kRoll, kStill };

struct CavityOptions {
  int frames = 14;
  ScopeMotion motion = ScopeMotion::kSweep;
  double noise_px = 0.3;   // standard deviation of an observation
  double outliers = 0.04;  // share of the observations of tracks
  int points = 900;
  double head_turn = 0;        // rad
  double contrast = 0.75;      // share of the light that the texture modulates
  double picture_noise = 1.5;  // grey levels of 255, standard deviation
  unsigned seed = 1;
};

inline constexpr double kViewAngle = 0.5236;  // rad

// Distance from the portal to the surface along a unit direction, m.
double CavityRadius(const Eigen::Vector3d& direction);

// Equisolid, 240 x 200 px, 90° across the round window.
Lens CavityLens();

// True poses in the portal frame, m.
std::vector<authoring::CameraPose> CavityPoses(const CavityOptions& options);

// Median distance from the portal to the tip.
double MedianInsertion(const std::vector<authoring::CameraPose>& poses);

std::vector<authoring::Track> CavityTracks(const CavityOptions& options);

// Writes the pictures as 000.png and so on.
void WriteCavityClip(const std::filesystem::path& folder, const CavityOptions& options);

// Root mean square distance of the centres after the similarity that fits best, m.
double PathError(const std::vector<std::optional<authoring::CameraPose>>& poses,
                 const std::vector<authoring::CameraPose>& truth);

}  // namespace arthro::test
