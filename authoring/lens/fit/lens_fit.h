// One lens model fitted to the targets of one or more pictures: all poses and the lens at once, by
// Levenberg-Marquardt (Ceres) with analytic derivatives, robustly, then without the outliers.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include <Eigen/Core>
#include <opencv2/core.hpp>

#include "authoring/lens/fit/board_pose.h"
#include "authoring/lens/fit/radial_model.h"
#include "authoring/lens/target/target_view.h"

namespace arthro::authoring {

// The lens's own numbers: f, cx, cy, aspect, then the model's (px; aspect as in lens.h).
struct LensNumbers {
  FitModel model = FitModel::kEquisolid;
  double focal = 0, cx = 0, cy = 0, aspect = 1;
  std::array<double, kMostOwnParameters> own{};

  Lens AsLens(cv::Size picture) const;
};

struct LensFit {
  LensNumbers lens;
  std::vector<BoardPose> poses;  // one a view
  double rms_px = 0;             // length of the residual vector, over the points used
  int points_used = 0, points_left_out = 0;
  int parameters = 0;  // of the lens alone
  bool converged = false;
  // Of (f, cx, cy[, aspect], own…) from the residuals, the poses being free; empty when singular.
  Eigen::MatrixXd covariance;
  bool has_aspect = false;
};

struct FitOptions {
  bool aspect = false;          // also fit the pixels' shape
  bool own_poses_only = false;  // hold the lens: only where the targets stand is found
};

// Lens and poses to begin with, by trying focal lengths of an equisolid lens about (cx, cy);
// nothing where no view gives a pose.
std::optional<LensFit> StartFit(const std::vector<TargetView>& views, cv::Size picture,
                                const cv::Point2d& centre, double window_radius);

// The same views, as another model; `start` gives the poses and the equisolid focal length.
LensFit FitLens(const std::vector<TargetView>& views, FitModel model, const LensFit& start,
                const FitOptions& options);

// Root mean square residual of views under a given lens, their poses refitted. NaN where a pose
// cannot be had.
double HeldOutRms(const std::vector<TargetView>& views, const LensFit& fit);

// σ of the profile's radius at θ, px: what the points and their noise leave open.
double RadiusSigma(const LensFit& fit, double theta);

}  // namespace arthro::authoring
