#include "authoring/panorama/plain_picture.h"

#include <cstring>

namespace arthro::authoring {

RgbaPicture PlainPicture(const cv::Mat& rgba) {
  RgbaPicture picture{rgba.cols, rgba.rows, {}};
  if (rgba.empty()) return picture;
  picture.rgba.resize(rgba.total() * 4);
  const std::size_t row = static_cast<std::size_t>(rgba.cols) * 4;
  for (int y = 0; y < rgba.rows; ++y)
    std::memcpy(&picture.rgba[static_cast<std::size_t>(y) * row], rgba.ptr(y), row);
  return picture;
}

}  // namespace arthro::authoring
