// Finds a calibration target in a raw picture and recognises its kind: a Cartesian grid of dark
// lines [paper, 3.1], a chessboard or a grid of dark dots, of any size and also in part.
#pragma once

#include "authoring/lens/target/target_view.h"
#include "simulation/core/options.h"
#include "simulation/scene/lens.h"

namespace arthro::authoring {

enum class TargetChoice { kAny, kLines, kChessboard, kDots };

struct DetectOptions {
  TargetChoice target = TargetChoice::kAny;
  double smallest_step = 7;  // px; closer lattice points merge
  int fewest_points = 16;

  template <class V>
  void Visit(V&& v) {
    v("target", target,
      Choices<TargetChoice>{{{TargetChoice::kAny, "any"},
                             {TargetChoice::kLines, "lines"},
                             {TargetChoice::kChessboard, "chessboard"},
                             {TargetChoice::kDots, "dots"}}},
      "", "Kind of target; any recognises it.");
    v("smallest_step", smallest_step, Range{4.0, 100.0}, "px",
      "Points that lie closer together are left out.");
    v("fewest_points", fewest_points, Range{9, 10000}, "",
      "A picture with fewer points of the target is not used.");
  }
};

// `raw`: 8-bit, grey or RGB. Points near the rim of `circle` (r = 0: none) are left out, since the
// edge of the rim would bias them. A result without a target gives the reason.
TargetView DetectTarget(const cv::Mat& raw, const LensCircle& circle, const DetectOptions& options);

}  // namespace arthro::authoring
