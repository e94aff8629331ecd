// Composes the placed frames to the panorama, and to one additional picture for each piece that is
// not joined to it.
#pragma once

#include <map>
#include <vector>

#include <opencv2/core.hpp>

#include "authoring/footage/footage.h"
#include "authoring/panorama/compose/compose.h"
#include "authoring/panorama/frames/placed_frame.h"
#include "simulation/core/progress.h"

namespace arthro::authoring {

struct ComposedPiece {
  int component = 0;
  ComposedPanorama composed;
  ComposeReport report;
};

// Number of frames per component; frames that are not placed do not count.
std::map<int, int> FramesByComponent(const std::vector<FrameResult>& frames);

// Composes component 0 first, then every other component with `least_piece` frames. Reads the
// footage again for each. `part` of a raw picture goes to `rectifier`, which must have scale 1.
// Throws Error(kCancelled) and the errors of reading.
std::vector<ComposedPiece> ComposePieces(const Clips& footage, const cv::Rect& part,
                                         const Rectifier& rectifier,
                                         const std::vector<FrameResult>& frames, int least_piece,
                                         const ComposeOptions& options, const Progress& progress,
                                         const ComposeObserver& observer);

}  // namespace arthro::authoring
