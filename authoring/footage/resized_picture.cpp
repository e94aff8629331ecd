#include "authoring/footage/resized_picture.h"

#include <opencv2/imgproc.hpp>

namespace arthro::authoring {

ColourImage Resized(const ColourImage& picture, int width, int height) {
  return Resized(picture, {0, 0, picture.width, picture.height}, width, height);
}

ColourImage Resized(const ColourImage& picture, const PixelBounds& box, int width, int height) {
  if (picture.empty()) return {};
  // A view of the bytes; it is only read.
  const cv::Mat whole(picture.height, picture.width, CV_8UC3,
                      const_cast<std::uint8_t*>(picture.rgb.data()));
  ColourImage resized(width, height);
  cv::Mat target(height, width, CV_8UC3, resized.rgb.data());
  cv::resize(whole(cv::Rect(box.left, box.top, box.width(), box.height())), target, target.size(),
             0, 0, width < box.width() ? cv::INTER_AREA : cv::INTER_LINEAR);
  return resized;
}

}  // namespace arthro::authoring
