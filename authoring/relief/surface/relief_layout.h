// Places the posed frames on the panorama over a closed surface, for the compositor of
// authoring/panorama: a cell of the panorama is a cell of the surface.
#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "authoring/panorama/compose/layout.h"
#include "authoring/relief/surface/close_surface.h"
#include "authoring/relief/surface/surface_view.h"

namespace arthro::authoring {

struct ReliefLayoutRequest {
  std::vector<int> indices;  // frames of the views, in the footage
  double picture_scale = 1;  // px of the frames' pictures per px of the lens
  int cell = 4;              // width of a cell, panorama px
};

// `visible` as of VisibleCells. Views that see nothing are left out.
Layout LayOverRelief(const std::vector<SurfaceView>& views, const LensProfile& lens,
                     const SurfaceCells& cells, const ClosedSurface& closed,
                     const std::vector<cv::Mat>& visible, const ReliefLayoutRequest& request);

// Unit normals towards the portal, CV_32FC3.
cv::Mat NormalsOf(const SurfaceCells& cells, const cv::Mat& radius);

// The surface that the light of a picture is taken from: light shows the slopes of the tissue, and
// those of the measurement's error would become stripes and bright rims. It is smoothed over as
// many cells as the standard error makes a slope uncertain.
struct LitSurface {
  cv::Mat radius;   // CV_32FC1
  cv::Mat normals;  // CV_32FC3, unit, towards the portal
};
LitSurface LitSurfaceOf(const SurfaceCells& cells, const ClosedSurface& closed);

}  // namespace arthro::authoring
