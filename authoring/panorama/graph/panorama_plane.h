// The plane in which a panorama is drawn: the one that stretches its frames least. Any homography
// of the plane shows the same tissue, but only one that looks at it straight keeps pixels alike all
// over: areas of equal scale (no perspective), circles round on average (no shear), scale 1 on
// average.
#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "authoring/panorama/graph/frame_window.h"

namespace arthro::authoring {

// plane_from_reference, given where frames lie in a reference plane (px). The identity where frames
// are so spread that no such plane exists (a point of one would fall behind it).
cv::Matx33d LeastStretchedPlane(const std::vector<cv::Matx33d>& reference_from_frame,
                                const FrameWindow& window);

// The same for a plane whose shape is right already: its size alone.
cv::Matx33d NaturalScale(const std::vector<cv::Matx33d>& reference_from_frame,
                         const FrameWindow& window);

}  // namespace arthro::authoring
