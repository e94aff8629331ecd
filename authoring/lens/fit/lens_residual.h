// Residual of a target point: projected pixel minus measured pixel, with all derivatives.
#pragma once

#include <ceres/cost_function.h>
#include <opencv2/core.hpp>

#include "authoring/lens/fit/radial_model.h"

namespace arthro::authoring {

// Parameter blocks: lens (f, cx, cy[, aspect], own…) and pose (BoardPose).
class LensResidual : public ceres::CostFunction {
 public:
  LensResidual(FitModel model, bool has_aspect, const cv::Point2d& on_board,
               const cv::Point2d& pixel, double fixed_aspect);
  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  FitModel model_;
  bool has_aspect_;
  cv::Point2d on_board_, pixel_;
  double fixed_aspect_;
};

}  // namespace arthro::authoring
