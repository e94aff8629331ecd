// Pose of a tissue from its surface: trimmed iterative closest point [Chetverikov et al. 2005] of
// one side, or of a patch, to the relief, by distances to tangent planes [Chen & Medioni 1992].
// Rigid; m, portal frame.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "authoring/alignment/relief_distance.h"
#include "simulation/core/options.h"
#include "simulation/scene/tissue_parts.h"

namespace arthro::authoring {

// Side of a tissue that is laid onto the relief. The relief shows the front of a tissue that is in
// the picture, and what lies behind a tissue that is not: a meniscus that the clip did not see has
// its back on the bone of the relief.
enum class AlignSide { kAuto, kFront, kBack };
const char* ToString(AlignSide side);

struct SurfaceAlignOptions {
  AlignSide side = AlignSide::kAuto;
  double kept_share = 0.7;
  double reach = 0.01;
  int max_steps = 60;
  template <class V>
  void Visit(V&& v) {
    v("side", side,
      Choices<AlignSide>{
          {{AlignSide::kAuto, "auto"}, {AlignSide::kFront, "front"}, {AlignSide::kBack, "back"}}},
      "",
      "Side that is laid onto the relief: the one that faces the portal, the other one, or that "
      "which lies nearer to the relief before the search.");
    v("kept_share", kept_share, Range{0.2, 1.0}, "",
      "Share of the points, those with the smallest distance, that takes part in a step.");
    v("reach", reach, Range{0.0005, 0.05}, "m", "Points farther from the relief take no part.");
    v("max_steps", max_steps, Range{1, 500}, "", "Steps, at most.");
  }
};

struct SurfaceAlignment {
  bool is_aligned = false;
  std::string sentence;  // result, or why there is none
  Pose portal_from_tissue;
  AlignSide side = AlignSide::kFront;  // the side that was laid onto the relief
  bool has_front = true;               // some of the surface faces the portal
  int steps = 0, points = 0;
  double kept_rms = 0;      // m, of the points that took part, to their tangent planes
  ReliefFit before, after;  // fit of the whole surface
};

// `patch`: ball in the tissue's own frame whose vertices take part; none: the vertices of the side.
SurfaceAlignment AlignSurface(const ReliefTarget& relief, const SurfaceMesh& surface,
                              const Pose& present, const std::optional<Ball>& patch = {},
                              const SurfaceAlignOptions& options = {});

}  // namespace arthro::authoring
