// A small three-dimensional cavity with known truth: a textured surface about the portal, seen by
// an oblique scope that turns about it [method.md, Frames]. As tracks without pictures, and as
// pictures.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "authoring/relief/motion/bundle/bundle.h"
#include "authoring/relief/motion/bundle/tracks.h"
#include "simulation/scene/lens.h"

namespace arthro::test {

enum class ScopeMotion { kSweep, kRoll, kStill, kPlunge };

struct CavityOptions {
  int frames = 14;
  ScopeMotion motion = ScopeMotion::kSweep;
  double noise_px = 0.3;   // standard deviation of an observation
  double outliers = 0.04;  // share of the observations of tracks
  int points = 900;
  double head_turn = 0;        // rad
  double contrast = 0.75;      // range of the share of the light that the texture throws back
  double picture_noise = 1.5;  // grey levels of 255, standard deviation
  unsigned seed = 1;
  // Disturbances.
  double roll = 0.35;         // rad, largest turn of the shaft about itself
  bool head_upright = false;  // the camera head does not follow the shaft's roll
  double slide = 0;           // m, by which the portal jumps half-way
  double breath = 0;          // m, by which the tissue of one side swells and shrinks
  double focal_factor = 1;    // error of the lens file's focal length
  bool two_clips = false;     // the second half is another clip of the same tissue, or
  bool elsewhere = false;     // shows other tissue
  double fold = 0;            // m, height of a fold with a sharp edge
  double glint = 0;           // strength of highlights that move with the light
  double blur = 0;            // share of the way to the next frame during which the shutter is open
  int debris = 0;             // specks that float before the tissue
  double tool = 0;            // px, width of an instrument from the rim
};

inline constexpr double kViewAngle = 0.5236;  // rad

// Distance from the portal to the surface along a unit direction, m. `fold`: height of the fold,
// whose edge lies along x = kFoldEdge z.
double CavityRadius(const Eigen::Vector3d& direction, double fold = 0);
inline constexpr double kFoldEdge = 0.05;

// Distance along a ray from inside to the surface, m.
double CavityRange(const Eigen::Vector3d& from, const Eigen::Vector3d& ray, double fold = 0);

// Equisolid, 240 x 200 px, 90° across the round window.
Lens CavityLens();
// The lens that the lens file describes.
Lens CavityLensFile(const CavityOptions& options);

// True poses in the portal frame, m.
std::vector<authoring::CameraPose> CavityPoses(const CavityOptions& options);

// Median distance from the portal to the tip.
double MedianInsertion(const std::vector<authoring::CameraPose>& poses);

// Turn of the camera head per frame, rad.
std::vector<double> CavityHeadTurns(const CavityOptions& options);

// With rays through the lens file. Points have a descriptor each, so that two clips can be joined.
std::vector<authoring::Track> CavityTracks(const CavityOptions& options);

// Writes the pictures as 000.png and so on.
void WriteCavityClip(const std::filesystem::path& folder, const CavityOptions& options);

// Root mean square distance of the centres after the similarity that fits best, m.
double PathError(const std::vector<std::optional<authoring::CameraPose>>& poses,
                 const std::vector<authoring::CameraPose>& truth);

}  // namespace arthro::test
