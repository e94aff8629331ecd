// Decides whether a clip determines depth, by tests that the report names with value and limit.
#pragma once

#include <span>

#include "authoring/relief/motion/motion.h"
#include "authoring/relief/relief_report.h"

namespace arthro::authoring {

// After the poses: still, rotation_only, texture, tissue_moves, pieces or ambiguous; else measured.
ReliefVerdict JudgeMotion(const Motion& motion);

// After the portal: pivot, where shafts that turn widely do not meet in one point, so that the
// poses cannot be those of a scope in an incision. `miss`: distance between shafts and portal over
// the insertion; `spread`: rad, of the shafts' directions.
ReliefVerdict JudgePivot(double miss, double spread);

// After the sweep: dense, where too little of the surface was measured.
ReliefVerdict JudgeCoverage(double coverage);

// At the end: tool, where a clip was refused for the tissue that it shows, and an instrument hides
// much of it throughout; else `found`. `shares`: part of the window that it hides, per frame.
ReliefVerdict JudgeTool(const ReliefVerdict& found, std::span<const double> shares);

}  // namespace arthro::authoring
