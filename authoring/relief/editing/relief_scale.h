// Scale of a measured scene from lengths that its author knows. Motion measures ratios only, so the
// backdrop's radius and its relief are multiplied by one factor [method.md, Relief from motion].
#pragma once

#include <span>

#include "authoring/relief/editing/relief_view.h"

namespace arthro::authoring {

// A distance between the tissue, or the instrument, at two pixels of the panorama.
struct KnownDistance {
  glm::dvec2 from{0.0}, to{0.0};
  double metres = 0;
};

// Factor that makes a known distance true, and its relative standard error.
struct ScaleFactor {
  double factor = 1;
  double relative_sigma = 0;
};

// Throws Error(kBadArgument) for a length outside 0.5 mm to 200 mm, a point that was not measured,
// points that are too near for their uncertainty, and a factor beyond a tenth or ten.
ScaleFactor ScaleFromDistance(const ReliefView& view, const KnownDistance& known);

// One factor for all known distances: the mean of the logarithms, weighted by the variances. Throws
// Error(kBadArgument) where two of them disagree by more than 10 %.
double JoinScales(std::span<const ScaleFactor> scales);

// Every value times the factor.
DepthMap ScaledMap(const DepthMap& map, double factor);

}  // namespace arthro::authoring
