// The share of each of several joined clips in a panorama.
#pragma once

#include <string>
#include <vector>

#include "authoring/footage/footage.h"
#include "authoring/panorama/clip/panorama_report.h"

namespace arthro::authoring {

std::vector<ClipReport> ClipReports(const Clips& clips, const std::vector<FrameReport>& frames);

// A sentence for each clip of several that has no frame in the panorama.
std::vector<std::string> ClipWarnings(const std::vector<ClipReport>& clips);

}  // namespace arthro::authoring
