// The second half of the way: the placed frames drawn as one panorama, and as one more for each
// piece that does not join it.
#pragma once

#include <filesystem>
#include <map>
#include <vector>

#include "authoring/panorama/compose/compose.h"
#include "authoring/panorama/frames/placed_frame.h"
#include "simulation/core/progress.h"

namespace arthro::authoring {

struct ComposedPiece {
  int component = 0;
  ComposedPanorama composed;
  ComposeReport report;
};

// How many frames each component has; those that are not placed do not count.
std::map<int, int> FramesByComponent(const std::vector<FrameResult>& frames);

// Component 0 first, then every other that has `least_piece` frames. Reads the footage again for
// each. `part` of a raw picture goes to `rectifier`, which must have scale 1. Throws
// Error(kCancelled) and what reading throws.
std::vector<ComposedPiece> ComposePieces(const std::filesystem::path& footage, const cv::Rect& part,
                                         const Rectifier& rectifier,
                                         const std::vector<FrameResult>& frames, int least_piece,
                                         const ComposeOptions& options, const Progress& progress,
                                         const ComposeObserver& observer);

}  // namespace arthro::authoring
