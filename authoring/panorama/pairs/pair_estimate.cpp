#include "authoring/panorama/pairs/pair_estimate.h"

namespace arthro::authoring {

cv::Point2d Apply(const cv::Matx33d& homography, const cv::Point2d& point) {
  const cv::Vec3d image = homography * cv::Vec3d(point.x, point.y, 1);
  return {image[0] / image[2], image[1] / image[2]};
}

}  // namespace arthro::authoring
