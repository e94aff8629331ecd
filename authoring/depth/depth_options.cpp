#include "authoring/depth/depth_options.h"

namespace arthro::authoring {

bool HasEffect(const DepthOptions& options, std::string_view field) {
  const bool is_grey = options.estimator == DepthEstimator::kPaper;
  const bool is_shading = options.estimator == DepthEstimator::kShading;
  if (field.ends_with("_weight") || field == "law" || field == "step_width") return is_grey;
  if (field == "gamma") return !is_grey || options.law == DepthLaw::kInverseSquare;
  if (field == "correct_tissue" || field == "vignette") return !is_grey;
  // A vignette ends at the rim of the field.
  if (field == "field_of_view") return is_shading || (!is_grey && options.vignette > 0);
  if (field == "iterations") return is_shading;
  return true;
}

}  // namespace arthro::authoring
