// Plots of an attempt from its frames, as SVG: steps over time, forces, centring of the targets,
// and the ways of both tips seen from two sides.
#pragma once

#include <string>

#include "app/report/attempt_report.h"

namespace arthro::app {

std::string StepsSvg(const AttemptReport& report);  // from the steps and events alone
std::string ForceSvg(const AttemptReport& report);
std::string CentringSvg(const AttemptReport& report);
std::string PathSvg(const AttemptReport& report, bool from_above);

}  // namespace arthro::app
