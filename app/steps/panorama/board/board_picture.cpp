#include "app/steps/panorama/board/board_picture.h"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

namespace arthro::app {

SharedPicture PictureFromMat(const cv::Mat& picture, int longest) {
  if (picture.empty() || picture.depth() != CV_8U) return nullptr;
  cv::Mat source = picture;
  const int edge = std::max(source.cols, source.rows);
  if (source.channels() == 4) {
    // On black, before it is averaged: colours under nothing must not bleed in.
    cv::Mat on_black(source.size(), CV_8UC3);
    for (int y = 0; y < source.rows; ++y) {
      const auto* from = source.ptr<cv::Vec4b>(y);
      auto* to = on_black.ptr<cv::Vec3b>(y);
      for (int x = 0; x < source.cols; ++x)
        for (int c = 0; c < 3; ++c)
          to[x][c] = static_cast<std::uint8_t>((from[x][c] * from[x][3] + 127) / 255);
    }
    source = on_black;
  } else if (source.channels() == 1) {
    cv::Mat colour;
    cv::cvtColor(source, colour, cv::COLOR_GRAY2RGB);
    source = colour;
  }
  if (source.channels() != 3) return nullptr;
  if (longest > 0 && edge > longest) {
    const double factor = static_cast<double>(longest) / edge;
    cv::Mat small;
    cv::resize(source, small,
               {std::max(1, static_cast<int>(std::lround(source.cols * factor))),
                std::max(1, static_cast<int>(std::lround(source.rows * factor)))},
               0, 0, cv::INTER_AREA);
    source = small;
  }
  auto image = std::make_shared<ColourImage>(source.cols, source.rows);
  for (int y = 0; y < source.rows; ++y)
    std::copy_n(source.ptr<std::uint8_t>(y), static_cast<std::size_t>(source.cols) * 3,
                image->at(0, y));
  return image;
}

SharedPicture PictureFromColour(const ColourImage& picture, int longest) {
  if (picture.empty()) return nullptr;
  // A view of the bytes; it is only read.
  return PictureFromMat(cv::Mat(picture.height, picture.width, CV_8UC3,
                                const_cast<std::uint8_t*>(picture.rgb.data())),
                        longest);
}

SharedPicture PictureFromRgba(const authoring::RgbaPicture& picture, int longest) {
  if (picture.empty()) return nullptr;
  return PictureFromMat(cv::Mat(picture.height, picture.width, CV_8UC4,
                                const_cast<std::uint8_t*>(picture.rgba.data())),
                        longest);
}

}  // namespace arthro::app
