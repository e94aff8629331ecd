// Plane of the panorama: the one that distorts its frames least. Any homography of the plane shows
// the same tissue, but only a frontal view of it keeps pixels uniform: areas of equal scale (no
// perspective), circles round on average (no shear), scale 1 on average.
#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "authoring/panorama/graph/links/frame_window.h"

namespace arthro::authoring {

// Computes plane_from_reference from the frames' positions in a reference plane (px). Returns the
// identity when the frames spread so far that no such plane exists (a point of one would fall
// behind it).
cv::Matx33d LeastStretchedPlane(const std::vector<cv::Matx33d>& reference_from_frame,
                                const FrameWindow& window);

// The same for a plane that needs no change but its scale.
cv::Matx33d NaturalScale(const std::vector<cv::Matx33d>& reference_from_frame,
                         const FrameWindow& window);

}  // namespace arthro::authoring
