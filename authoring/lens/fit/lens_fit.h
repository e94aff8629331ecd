// Fits one lens model to the targets of one or more pictures. Estimates all poses and the lens
// together by robust Levenberg-Marquardt (Ceres) with analytic derivatives, then again without the
// outliers.
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

// Parameters of the lens: f, cx, cy, aspect, then the model's own (px; aspect as in lens.h).
struct LensNumbers {
  FitModel model = FitModel::kEquisolid;
  double focal = 0, cx = 0, cy = 0, aspect = 1;
  std::array<double, kMostOwnParameters> own{};

  Lens AsLens(cv::Size picture) const;
};

struct LensFit {
  LensNumbers lens;
  std::vector<BoardPose> poses;  // one per view
  double rms_px = 0;             // length of the residual vector, over the points used
  int points_used = 0, points_left_out = 0;
  int parameters = 0;  // parameters of the lens alone
  bool converged = false;
  // Covariance of (f, cx, cy[, aspect], own…) from the residuals with free poses; empty when
  // singular.
  Eigen::MatrixXd covariance;
  bool has_aspect = false;
};

struct FitOptions {
  bool aspect = false;          // also fit the aspect ratio of the pixels
  bool own_poses_only = false;  // keep the lens fixed; estimate the poses of the targets only
};

// Initial lens and poses, found by trying focal lengths of an equisolid lens about (cx, cy).
// Returns nothing when no view gives a pose.
std::optional<LensFit> StartFit(const std::vector<TargetView>& views, cv::Size picture,
                                const cv::Point2d& centre, double window_radius);

// Fits another model to the same views; `start` gives the poses and the equisolid focal length.
LensFit FitLens(const std::vector<TargetView>& views, FitModel model, const LensFit& start,
                const FitOptions& options);

// Root mean square residual of views under a given lens, with poses fitted anew. NaN when a pose
// cannot be found.
double HeldOutRms(const std::vector<TargetView>& views, const LensFit& fit);

// Standard deviation of the profile's radius at θ, px, from the noise of the points.
double RadiusSigma(const LensFit& fit, double theta);

}  // namespace arthro::authoring
