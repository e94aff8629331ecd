#include "authoring/panorama/pairs/surf_detector.h"

#include <algorithm>

#include <dlib/array2d.h>
#include <dlib/image_keypoint/surf.h>

namespace arthro::authoring {
namespace {

constexpr int kOctaves = 3,
              kIntervals = 4;  // boxes of 9 to 99 px; larger ones respond to light, not tissue
constexpr int kStep = 2;       // px between two tested positions
constexpr double kDescriptorReach = 16;  // reach of a descriptor about its point, in scales

}  // namespace

SurfPoints DetectSurf(const cv::Mat& grey, const cv::Mat& mask, int most, double least) {
  dlib::array2d<unsigned char> picture(grey.rows, grey.cols);
  for (int y = 0; y < grey.rows; ++y)
    std::copy_n(grey.ptr<unsigned char>(y), grey.cols, &picture[y][0]);
  dlib::integral_image integral;
  integral.load(picture);
  dlib::hessian_pyramid pyramid;
  pyramid.build_pyramid(integral, kOctaves, kIntervals, kStep);
  std::vector<dlib::interest_point> found;
  dlib::get_interest_points(pyramid, least, found);

  // Keeps points inside the mask, with room for the descriptor.
  std::erase_if(found, [&](const dlib::interest_point& p) {
    const int x = static_cast<int>(std::lround(p.center.x()));
    const int y = static_cast<int>(std::lround(p.center.y()));
    const double reach = kDescriptorReach * p.scale;
    return x < reach || y < reach || x >= grey.cols - reach || y >= grey.rows - reach ||
           mask.at<unsigned char>(y, x) == 0;
  });
  std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) {
    if (a.score != b.score) return a.score > b.score;
    return a.center.y() != b.center.y() ? a.center.y() < b.center.y() : a.center.x() < b.center.x();
  });
  if (found.size() > static_cast<std::size_t>(most)) found.resize(static_cast<std::size_t>(most));

  SurfPoints out;
  out.descriptors.create(static_cast<int>(found.size()), 64, CV_32F);
  for (std::size_t i = 0; i < found.size(); ++i) {
    const dlib::interest_point& p = found[i];
    const double angle = dlib::compute_dominant_angle(integral, p.center, p.scale);
    dlib::matrix<double, 64, 1> descriptor;
    dlib::compute_surf_descriptor(integral, p.center, p.scale, angle, descriptor);
    for (int k = 0; k < 64; ++k)
      out.descriptors.at<float>(static_cast<int>(i), k) = static_cast<float>(descriptor(k));
    out.points.push_back({{static_cast<float>(p.center.x()), static_cast<float>(p.center.y())},
                          static_cast<float>(p.scale),
                          static_cast<float>(p.score)});
  }
  return out;
}

}  // namespace arthro::authoring
