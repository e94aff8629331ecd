// Puts candidate points on a square lattice as a bent picture shows it: begins at a point whose
// neighbours lie evenly round it and grows step by step, each step guessed from the ones before.
// Candidates that fit nowhere stay out, and a missing point or line is stepped over.
#pragma once

#include <map>
#include <utility>
#include <vector>

#include <opencv2/core.hpp>

namespace arthro::authoring {

using Lattice = std::map<std::pair<int, int>, cv::Point2d>;  // (i, j) -> pixel

// The largest lattice found; empty when there is none of at least 3 x 3 points. It does not grow
// where a step is shorter than `smallest_step` px: points too close together are counted wrongly.
Lattice GrowLattice(const std::vector<cv::Point2d>& candidates, cv::Size picture,
                    double smallest_step);

// Distance to the nearest neighbour on the lattice, px; 0 for a point without one.
double StepAt(const Lattice& lattice, const std::pair<int, int>& place);

// Takes out points that do not lie between their neighbours (off by more than `tolerance` of a
// step) or hang by a single one, until none is left to take out.
void PruneLattice(Lattice& lattice, double tolerance);

}  // namespace arthro::authoring
