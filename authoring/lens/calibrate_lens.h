// Calibrates the lens of a camera from pictures of a flat target: model, parameters, their
// uncertainty, and a verdict in words. A model with fewer parameters wins unless one with more
// predicts held-out pictures better. A target seldom reaches the rim, and a flexible model
// extrapolates badly there.
#pragma once

#include <string>
#include <vector>

#include "authoring/lens/fit/lens_fit.h"
#include "authoring/lens/target/target_view.h"
#include "simulation/core/options.h"
#include "simulation/core/progress.h"
#include "simulation/scene/lens.h"

namespace arthro::authoring {

enum class ModelChoice { kAuto, kEquisolid, kKannalaBrandt, kDoubleSphere, kPinhole };

struct CalibrateOptions {
  ModelChoice model = ModelChoice::kAuto;
  bool aspect = false;
  double largest_rms = 2.0;  // px
  double least_cover = 0.5;  // share of the round window's radius

  template <class V>
  void Visit(V&& v) {
    v("model", model,
      Choices<ModelChoice>{{{ModelChoice::kAuto, "auto"},
                            {ModelChoice::kEquisolid, "equisolid"},
                            {ModelChoice::kKannalaBrandt, "kannala_brandt"},
                            {ModelChoice::kDoubleSphere, "double_sphere"},
                            {ModelChoice::kPinhole, "pinhole"}}},
      "", "Lens model; auto takes the simplest that agrees with the pictures.");
    v("aspect", aspect, Any{}, "",
      "Also fit the aspect ratio of the pixels (needs several views).");
    v("largest_rms", largest_rms, Range{0.1, 20.0}, "px",
      "A lens that leaves a larger residual is refused.");
    v("least_cover", least_cover, Range{0.1, 1.0}, "",
      "Share of the round window's radius that the targets must reach.");
  }
};

enum class LensVerdict { kGood, kDoubtful, kRefused };

struct ModelTrial {
  FitModel model;
  int parameters = 0;
  double rms_px = 0, held_out_px = 0;  // px; held out: from three views on, otherwise equal to rms
  bool fitted = false;
};

struct ViewReport {
  TargetView target;  // kind none: not used, with the reason
  double rms_px = 0;
  int points_left_out = 0;
  double distance = 0;  // m, from the lens to the middle of the target
  double tilt = 0;      // rad, between the target's normal and the optical axis
};

struct LensCalibration {
  LensVerdict verdict = LensVerdict::kRefused;
  Lens lens;
  FitModel model = FitModel::kEquisolid;
  bool is_paper_model_refuted =
      false;  // another profile than equisolid explains the pictures better
  double focal_sigma_px = 0, centre_sigma_px = 0;
  double covered_radius_px = 0, rim_radius_px = 0;
  double rim_error_px = 0;  // estimate up to 95 % of the rim
  int points = 0, points_left_out = 0;
  std::vector<std::string> sentences;  // the verdict in words, most important sentence first
  std::vector<ModelTrial> trials;
  std::vector<ViewReport> views;  // one per picture
  double fit_ms = 0;              // processor time: start and fit of the chosen model
};

// `views`: one per picture, of kind none when no target was found. `spacing`: step of the target's
// lattice, m. A circle of radius 0 means no round window. Throws only for bad options; pictures
// that do not determine a lens give the verdict kRefused with the reason.
LensCalibration CalibrateLens(const std::vector<TargetView>& views, cv::Size picture,
                              const LensCircle& circle, double spacing,
                              const CalibrateOptions& options, const Progress& progress);

// Clause of a refusal; an error larger than the window has no digits worth stating.
std::string RimErrorInWords(double rim_error_px, double rim_radius_px);

const char* ToString(LensVerdict verdict);  // "good", "doubtful", "refused"

}  // namespace arthro::authoring
