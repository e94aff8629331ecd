// Options of the pictures that are matched (prepare.h).
#pragma once

#include "simulation/core/options.h"

namespace arthro::authoring {

struct PrepareOptions {
  bool even_light = true;
  double surround = 24;
  double contrast = 36;
  double contrast_reach = 60;
  double most_noise = 14;
  double smoothing = 0.8;
  double most_smoothing = 1.6;
  double rim_margin = 0.015;
  bool mask_highlights = true;
  bool mask_tool = true;
  bool mask_static = true;

  template <class V>
  void Visit(V&& v) {
    v("even_light", even_light, Any{}, "",
      "Remove light and vignetting; without it the plain grey is matched.");
    v("surround", surround, Range{4, 200}, "px",
      "Structure larger than this is light, at half scale.");
    v("contrast", contrast, Range{1, 100}, "",
      "Target standard deviation of texture, in grey levels.");
    v("contrast_reach", contrast_reach, Range{8, 1000}, "px",
      "Distance over which contrast is measured, at half scale.");
    v("most_noise", most_noise, Range{1, 100}, "",
      "Largest noise after raising the contrast, in grey levels.");
    v("smoothing", smoothing, Range{0, 5}, "px",
      "Sigma of the first Gaussian for a clip without noise.");
    v("most_smoothing", most_smoothing, Range{0, 5}, "px",
      "Sigma of the first Gaussian for more noise than texture.");
    v("rim_margin", rim_margin, Range{0, 0.2}, "",
      "Share of the window's radius that is left out at its rim.");
    v("mask_highlights", mask_highlights, Any{}, "", "Leave out highlights.");
    v("mask_tool", mask_tool, Any{}, "", "Leave out instruments.");
    v("mask_static", mask_static, Any{}, "", "Leave out text, logos and dirt on the lens.");
  }
};

}  // namespace arthro::authoring
