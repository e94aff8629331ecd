// The posed frames as the surface sees them: the grid of directions from the portal, and the pixel
// at which a frame shows a point. Points are in the portal frame, in the unit of the poses.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include <opencv2/core.hpp>

#include "authoring/panorama/frames/working_frame.h"
#include "authoring/relief/motion/bundle/bundle.h"
#include "authoring/relief/motion/bundle/lens_profile.h"
#include "simulation/core/progress.h"
#include "simulation/scene/projection.h"

namespace arthro::authoring {

// Range of a cell that nothing tells.
inline constexpr float kUnknownRange = std::numeric_limits<float>::quiet_NaN();

// Directions of the cells, row by row; a cell is a pixel of the projection.
struct SurfaceCells {
  Projection projection;
  cv::Size size;
  std::vector<cv::Vec3f> directions;
  const cv::Vec3f* Row(int y) const {
    return &directions[static_cast<std::size_t>(y) * static_cast<std::size_t>(size.width)];
  }
};

SurfaceCells CellDirections(const Projection& projection, const cv::Size& size);

// A posed frame.
struct SurfaceView {
  int frame = 0;  // in the clip
  cv::Matx33f camera_from_portal;
  cv::Vec3f centre;
  cv::Mat grey;  // CV_32FC1
  cv::Mat mask;  // CV_8UC1, 255 at tissue
};

// Views of the frames with a pose, their greys blurred by `smoothing` px.
std::vector<SurfaceView> ViewsOf(const std::vector<WorkingFrame>& frames,
                                 const Reconstruction& scene, double smoothing);

// Finds the pixel of a point in the frame's lens; false behind the camera.
inline bool ProjectPoint(const SurfaceView& view, const LensProfile& lens, const cv::Vec3f& point,
                         double* pixel) {
  const float* m = view.camera_from_portal.val;
  const float x = point[0] - view.centre[0], y = point[1] - view.centre[1],
              z = point[2] - view.centre[2];
  const double at[3] = {m[0] * x + m[1] * y + m[2] * z, m[3] * x + m[4] * y + m[5] * z,
                        m[6] * x + m[7] * y + m[8] * z};
  const double length = std::sqrt(at[0] * at[0] + at[1] * at[1] + at[2] * at[2]);
  if (!(at[2] > lens.least_cosine() * length)) return false;
  lens.Project(at, pixel);
  return true;
}

// The same; also false outside the frame's mask.
inline bool PixelOf(const SurfaceView& view, const LensProfile& lens, const cv::Vec3f& point,
                    double* pixel) {
  if (!ProjectPoint(view, lens, point, pixel)) return false;
  const int x = static_cast<int>(std::floor(pixel[0] + 0.5));
  const int y = static_cast<int>(std::floor(pixel[1] + 0.5));
  return pixel[0] >= 1 && pixel[1] >= 1 && x < view.mask.cols - 2 && y < view.mask.rows - 2 &&
         view.mask.at<std::uint8_t>(y, x) != 0;
}

// For each view the cells that it sees: inside its mask, and not hidden by a nearer part of the
// surface. CV_8UC1, 255 where seen. `radius` has a value in every cell.
std::vector<cv::Mat> VisibleCells(const std::vector<SurfaceView>& views, const LensProfile& lens,
                                  const SurfaceCells& cells, const cv::Mat& radius, int threads,
                                  const Progress& progress = {});

}  // namespace arthro::authoring
