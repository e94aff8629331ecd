// Error of estimated distances against true ones. Distances from light have no unit: one scale is
// fitted to the truth. Greys have neither scale nor origin: both are fitted. Spearman's correlation
// needs no fit, so it compares both fairly.
#pragma once

#include <string>
#include <vector>

#include "authoring/depth/depth_filter.h"
#include "tests/support/depth_scene.h"

namespace arthro::test {

struct DepthScore {
  double abs_rel = 0;     // mean of |error| / distance
  double rmse_log = 0;    // root mean square of the log ratio
  double within_125 = 0;  // share within a factor of 1.25
  double spearman = 0;    // 1: ordered as the truth
  double contact_mm = 0;  // mean error of the touched place over 1 000 approaches; scenes only
  std::string Text() const;
};

// Spearman's rank correlation; 1 for the same order.
double RankCorrelation(const std::vector<double>& a, const std::vector<double>& b);

// Distances that a relief of DepthFromColour stands for, without unit; NaN where nothing is known.
std::vector<double> DistancesOf(const DepthMap& relief, const authoring::DepthOptions& options,
                                const authoring::DepthReport& report);

// `estimate` and `truth` pixel by pixel; NaN does not count. `fit_origin`: for greys.
DepthScore ScoreDepth(const std::vector<double>& estimate, const std::vector<double>& truth,
                      bool fit_origin);

// The same, and the probe's approaches: straight from an instrument portal beside the scope to
// random places of the true surface.
DepthScore ScoreScene(const std::vector<double>& estimate, const DepthScene& scene,
                      bool fit_origin);

}  // namespace arthro::test
