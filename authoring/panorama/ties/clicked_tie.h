// A click in the panorama as a point of one of its frames, so that a tie point stays right when the
// panorama is drawn anew with another size or origin.
#pragma once

#include <optional>

#include "authoring/panorama/clip/panorama_report.h"
#include "authoring/panorama/ties/frame_tie.h"

namespace arthro::authoring {

// The frame whose window's middle lies nearest to the pixel of the report's panorama, and its raw
// pixel there. Frames that were tied by hand do not count. Nothing where no frame shows the place,
// and for a panorama over a relief.
std::optional<TieInFrame> FrameAt(const PanoramaReport& report, const glm::dvec2& panorama_pixel);

// Pixel of the panorama for a raw pixel of a placed frame.
std::optional<glm::dvec2> PanoramaPixelOf(const PanoramaReport& report, const TieInFrame& point);

}  // namespace arthro::authoring
