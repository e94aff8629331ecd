// Options of the relief from a panorama's brightness [paper, 3.4].
#pragma once

#include <string_view>

#include "simulation/core/options.h"

namespace arthro::authoring {

// Estimator of distance from brightness. Each of them ranks depth; none measures it.
enum class DepthEstimator {
  kPaper,             // grey with little red, median, law [paper, 3.4]
  kInverseSquareRed,  // red, which blood hides least, without the tissue colour, by 1/sqrt(I)
  kShading,           // the same, corrected for slopes away from the light
};

// Law that gives the distance of a surface from its brightness under a light at the scope.
enum class DepthLaw {
  kLinear,         // relief is linear in grey [paper, 3.4]
  kInverseSquare,  // light I falls with the square of distance, so distance is proportional to
                   // 1/sqrt(I)
};

struct DepthOptions {
  DepthEstimator estimator = DepthEstimator::kPaper;
  double red_weight = 0.2;
  double green_weight = 0.4;
  double blue_weight = 0.4;
  DepthLaw law = DepthLaw::kLinear;
  double gamma = 2.2;
  double near_relief = 0.02;
  double far_relief = 0.0;
  double low_percentile = 1.0;
  double high_percentile = 99.0;
  int median_radius = 2;
  int texture_size = 16;
  int surround_threshold = 12;
  int border_margin = 3;
  double border_taper = 6.0;
  double step_width = 15.0;
  bool fill_highlights = true;
  bool correct_tissue = true;
  double field_of_view = RadiansFromDegrees(90);
  double vignette = 0;
  int iterations = 8;

  template <class V>
  void Visit(V&& v) {
    v("estimator", estimator,
      Choices<DepthEstimator>{{{DepthEstimator::kPaper, "paper"},
                               {DepthEstimator::kInverseSquareRed, "inverse-square-red"},
                               {DepthEstimator::kShading, "shading"}}},
      "",
      "paper: grey by the weights and the law below. The other two follow a light at the scope: "
      "red light over distance squared, and with shading also the slope. On a panorama, with "
      "evened-out light, they measure how far a place stands out from its surroundings.");
    v("red_weight", red_weight, Range{0, 1}, "",
      "Share of red in the grey; small, since muscle and synovium are redder, not nearer.");
    v("green_weight", green_weight, Range{0, 1}, "", "Share of green in the grey.");
    v("blue_weight", blue_weight, Range{0, 1}, "", "Share of blue in the grey.");
    v("law", law,
      Choices<DepthLaw>{
          {{DepthLaw::kLinear, "linear"}, {DepthLaw::kInverseSquare, "inverse-square"}}},
      "", "How brightness falls with distance.");
    v("gamma", gamma, Range{1, 3}, "",
      "The camera's encoding, undone by all but the linear law; 1 for a linear camera.");
    v("near_relief", near_relief, Range{0, 0.5}, "m", "Relief of the brightest, nearest tissue.");
    v("far_relief", far_relief, Range{0, 0.5}, "m", "Relief of the darkest, furthest tissue.");
    v("low_percentile", low_percentile, Range{0, 100}, "%",
      "Grey below which everything counts as furthest.");
    v("high_percentile", high_percentile, Range{0, 100}, "%",
      "Grey above which everything counts as nearest.");
    v("median_radius", median_radius, Range{0, 15}, "px",
      "Radius of noise removal: a median for the paper's estimator, otherwise an edge-preserving "
      "smoothing. 0 removes none.");
    v("texture_size", texture_size, Range{0, 100}, "px",
      "Structure of the relief finer than this is the tissue's texture and counts as its noise. "
      "0: no noise is stated.");
    v("surround_threshold", surround_threshold, Range{0, 255}, "",
      "Pixels darker than this and connected to the picture's edge are surround, not tissue.");
    v("border_margin", border_margin, Range{0, 100}, "px",
      "Width of the rim of the imaged area that is left out.");
    v("border_taper", border_taper, Range{0, 50}, "%",
      "Band along the border of the imaged area in which the relief goes over to its broad mean, "
      "as a share of the picture's shorter side. What the border cuts has no known shape. 0: "
      "none.");
    v("step_width", step_width, Range{0, 100}, "%",
      "Least width of a step of the whole relief, as a share of the picture's shorter side. A wall "
      "between bright and dark tissue is mostly none, and smears when it is seen from the side. 0: "
      "as narrow as the picture has it.");
    v("fill_highlights", fill_highlights, Any{}, "",
      "Fill highlights from their surroundings, so that they make no peaks.");
    v("correct_tissue", correct_tissue, Any{}, "",
      "Divide by the tissue's own colour; not used by the paper's estimator.");
    v("field_of_view", field_of_view, Range{RadiansFromDegrees(10), RadiansFromDegrees(360)}, "rad",
      "Angle across the picture's shorter side, for slopes and vignetting. Up to 120 degrees the "
      "picture is a pinhole's, above it angles are proportional to pixels.");
    v("vignette", vignette, Range{0, 0.95}, "",
      "Share of light that the lens loses at the rim of a single frame; 0 for a panorama.");
    v("iterations", iterations, Range{1, 30}, "", "Iterations of the shading estimator.");
  }
};

// Whether a change of the field, by its name in Visit, can change the relief or its noise while the
// other options stay as they are.
bool HasEffect(const DepthOptions& options, std::string_view field);

}  // namespace arthro::authoring
