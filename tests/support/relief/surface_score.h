// Distance of a surface about the portal from the true one of a clip, over a grid of directions.
// Surfaces are maps of radii in m, NaN where nothing is known, in the portal frame of the truth.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include <glm/vec2.hpp>

#include "authoring/panorama/clip/panorama_report.h"
#include "authoring/relief/make/make_relief.h"
#include "simulation/scene/image.h"
#include "tests/support/relief/cavity_truth.h"
#include "tests/support/relief/pose_score.h"

namespace arthro::test {

// True radii over directions within 60 degrees of +z.
struct TrueSurface {
  Projection projection;
  DepthMap radius;
  std::vector<std::uint8_t> seen_by;  // frames per direction, 255 at most

  Eigen::Vector3d Direction(int x, int y) const;
};
TrueSurface SurfaceOf(const CavityTruth& truth);

struct FoundSurface {
  DepthMap radius, sigma;  // sigma is empty where no error is known
};

// A measured relief, moved into the frame of the truth by the similarity that fits its cameras
// best; no value where fewer than two frames are posed.
std::optional<FoundSurface> SurfaceOf(const authoring::ReliefResult& result,
                                      const CavityTruth& truth, const TrueSurface& surface);

// Points of another reconstruction whose cameras fit so: the median of those in a cell, and no
// value in a cell without one.
FoundSurface SurfaceOf(const std::vector<Eigen::Vector3d>& points, const CameraFit& fit,
                       const TrueSurface& surface);

// Mean place of each direction in a panorama of homographies, px, and the mean distance from there
// at which its frames show it; NaN where fewer than two frames do.
struct PanoramaPlaces {
  std::vector<glm::dvec2> pixel;
  std::vector<double> spread;
};
PanoramaPlaces PlacesOf(const authoring::PanoramaReport& report, const CavityTruth& truth,
                        const TrueSurface& surface);

// A depth map over that panorama as radii, by the affine law that fits the truth best: brightness
// has neither scale nor origin.
FoundSurface SurfaceOf(const DepthMap& depth, const PanoramaPlaces& places,
                       const TrueSurface& surface);

struct SurfaceScore {
  double coverage = 0;          // share of the directions that three frames see
  double rmse = 0, median = 0;  // m, of the error of the radius
  double within_1mm = 0;        // share of the covered directions
  double spearman = 0;          // with the true radius
};
SurfaceScore ScoreSurface(const FoundSurface& found, const TrueSurface& surface);

}  // namespace arthro::test
