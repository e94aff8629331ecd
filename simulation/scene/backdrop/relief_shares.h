// Shares of a relief by the origin of its depths, and its median standard error [method.md,
// Backdrop]. Shares are of the depths that are known, 0 to 1; lengths in m.
#pragma once

#include <optional>

#include "simulation/scene/image.h"

namespace arthro {

struct ReliefShares {
  double measured = 0, brightness = 0, interpolated = 0;  // all 0 without origins
  double without_origin = 0;                              // depths of origin 0
  std::optional<double> median_sigma;                     // over the depths that have one
  double without_sigma = 0;                               // depths whose error is not known
};

// `sigma` and `origins` have the size of `depth`, or are empty where the scene has none.
ReliefShares SharesOf(const DepthMap& depth, const DepthMap& sigma, const OriginMap& origins);

}  // namespace arthro
