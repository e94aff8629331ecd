// Combines the results of the stages into one report.
#pragma once

#include <set>
#include <vector>

#include "authoring/panorama/clip/panorama_report.h"
#include "authoring/panorama/clip/prepared_clip.h"
#include "authoring/panorama/compose_pieces.h"
#include "authoring/panorama/graph/register.h"

namespace arthro::authoring {

// Fills the report except for what is not in the products: footage, options, costs. `placed` has a
// result for each usable frame that was not excluded.
PanoramaReport AssembleReport(const PreparedClip& clip, const std::vector<FrameResult>& placed,
                              const RegisterReport& registration,
                              const std::vector<ComposedPiece>& pieces,
                              const std::set<int>& excluded);

}  // namespace arthro::authoring
