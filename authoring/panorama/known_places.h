// Places of frames by the report of an earlier run, in the place of a registration: a frame that is
// tied in by hand then costs no matching of all others.
#pragma once

#include <set>
#include <vector>

#include "authoring/panorama/clip/panorama_report.h"
#include "authoring/panorama/clip/prepared_clip.h"
#include "authoring/panorama/frames/placed_frame.h"

namespace arthro::authoring {

// One result per frame that is used and not excluded, in order. The plane is that of the report's
// panorama. Frames that were tied by hand are not placed: their ties are given anew. Throws
// Error(kBadData) for the report of another clip or lens, and for a panorama over a relief.
std::vector<FrameResult> KnownPlaces(const PanoramaReport& known, const PreparedClip& clip,
                                     const std::set<int>& excluded);

}  // namespace arthro::authoring
