// Assigns candidate points to a square lattice in a distorted picture. Begins at a point with
// evenly spaced neighbours and grows step by step, each step predicted from the ones before.
// Ignores candidates that match no prediction and steps over a missing point or line.
#pragma once

#include <functional>
#include <map>
#include <utility>
#include <vector>

#include <opencv2/core.hpp>

namespace arthro::authoring {

using Lattice = std::map<std::pair<int, int>, cv::Point2d>;  // (i, j) -> pixel

// Largest lattice found that `fits`; empty when none of at least 3 x 3 points does. A lattice whose
// steps go along diagonals of the target has the same points and does not look like it. Growth
// stops where a step is shorter than `smallest_step` px, because closer points are counted wrongly.
Lattice GrowLattice(const std::vector<cv::Point2d>& candidates, cv::Size picture,
                    double smallest_step, const std::function<bool(const Lattice&)>& fits);

// Distance to the nearest neighbour on the lattice, px; 0 without a neighbour.
double StepAt(const Lattice& lattice, const std::pair<int, int>& place);

// Removes points that do not lie between their neighbours (by more than `tolerance` of a step) or
// that have a single neighbour, until none is left.
void PruneLattice(Lattice& lattice, double tolerance);

}  // namespace arthro::authoring
