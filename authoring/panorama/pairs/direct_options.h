// Options of direct alignment: the search for a start, the least squares, and the limits of
// acceptance.
#pragma once

#include "simulation/core/options.h"
#include "simulation/core/units.h"

namespace arthro::authoring {

struct DirectOptions {
  double rotation_reach = RadiansFromDegrees(18);
  double rotation_step = RadiansFromDegrees(4);
  double predicted_rotation_reach = RadiansFromDegrees(4);
  double zoom_reach = 0.0;
  int candidates = 8;
  int most_points = 16000;
  int most_iterations = 12;
  double smallest_overlap = 0.12;
  double least_certainty = 9.0;
  double least_part_certainty = 1.2;
  double least_part_share = 0.25;
  double most_corner_sigma = 5.0;
  template <class V>
  void Visit(V&& v) {
    v("rotation_reach", rotation_reach, Range{0.0, 3.15}, "rad",
      "Largest rotation that a search without prediction tries.");
    v("rotation_step", rotation_step, Range{0.01, 0.5}, "rad",
      "Step between two rotations of the search.");
    v("predicted_rotation_reach", predicted_rotation_reach, Range{0.0, 3.15}, "rad",
      "Largest rotation that a search around a prediction tries.");
    v("zoom_reach", zoom_reach, Range{0.0, 0.5}, "",
      "Relative change of size that is searched as well; 0 searches the same size only.");
    v("candidates", candidates, Range{1, 20}, "", "Peaks of the search that are refined.");
    v("most_points", most_points, Range{2000, 200000}, "",
      "Pixels of a frame's finest level that are aligned: those with the strongest edges.");
    v("most_iterations", most_iterations, Range{1, 100}, "", "Least-squares steps per level.");
    v("smallest_overlap", smallest_overlap, Range{0.01, 1.0}, "",
      "A pair with less overlap, as a share of the first frame, is refused.");
    v("least_certainty", least_certainty, Range{0.0, 100.0}, "sigma",
      "Least similarity of the two frames, in deviations above chance.");
    v("least_part_certainty", least_part_certainty, Range{-10.0, 100.0}, "sigma",
      "The same for the least similar of nine parts of the overlap.");
    v("least_part_share", least_part_share, Range{0.0, 1.0}, "",
      "The same as a share of its value for equal parts.");
    v("most_corner_sigma", most_corner_sigma, Range{0.1, 100.0}, "px",
      "A pair with a larger uncertainty over its overlap is refused.");
  }
};

}  // namespace arthro::authoring
