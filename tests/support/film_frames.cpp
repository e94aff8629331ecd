#include "tests/support/film_frames.h"

#include <opencv2/imgproc.hpp>

namespace arthro::test {

namespace {

// Returns a picture that was decoded by BT.601 as BT.709 decodes it [ITU-R BT.709-6, 3.2].
cv::Mat DecodedAgain(const cv::Mat& rgb) {
  cv::Mat again(rgb.size(), CV_8UC3);
  for (int y = 0; y < rgb.rows; ++y)
    for (int x = 0; x < rgb.cols; ++x) {
      const cv::Vec3b& p = rgb.at<cv::Vec3b>(y, x);
      const double luma = 0.299 * p[0] + 0.587 * p[1] + 0.114 * p[2];
      const double cb = (p[2] - luma) / 1.772, cr = (p[0] - luma) / 1.402;
      again.at<cv::Vec3b>(y, x) = {
          cv::saturate_cast<std::uint8_t>(luma + 1.5748 * cr),
          cv::saturate_cast<std::uint8_t>(luma - 0.1873 * cb - 0.4681 * cr),
          cv::saturate_cast<std::uint8_t>(luma + 1.8556 * cb)};
    }
  return again;
}

}  // namespace

Film ReadFilm(const std::filesystem::path& file) {
  auto footage = authoring::Footage::Open(file);
  Film film{footage.info(), {}};
  // OpenCV decodes every film by the matrix of BT.601; one of H.264 here is of BT.709.
  const bool is_jpeg = file.extension() == ".avi";
  for (cv::Mat rgb; footage.Next(rgb);)
    film.frames.push_back(is_jpeg ? rgb.clone() : DecodedAgain(rgb));
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
