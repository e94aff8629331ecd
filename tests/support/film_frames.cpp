#include "tests/support/film_frames.h"

#include <opencv2/imgproc.hpp>

namespace arthro::test {

Film ReadFilm(const std::filesystem::path& file) {
  auto footage = authoring::Footage::Open(file);
  Film film{footage.info(), {}};
  for (cv::Mat rgb; footage.Next(rgb);) film.frames.push_back(rgb.clone());
  return film;
}

double LumaPsnr(const cv::Mat& rgb, const ColourImage& picture) {
  const cv::Mat given(picture.height, picture.width, CV_8UC3,
                      const_cast<std::uint8_t*>(picture.rgb.data()));
  cv::Mat a, b;
  cv::cvtColor(rgb, a, cv::COLOR_RGB2GRAY);
  cv::cvtColor(given, b, cv::COLOR_RGB2GRAY);
  return cv::PSNR(a, b);
}

}  // namespace arthro::test
