// A film read back whole, by the decoder that reads footage, and how near its frames are to the
// pictures that it was made of.
#pragma once

#include <filesystem>
#include <vector>

#include <opencv2/core.hpp>

#include "authoring/footage/footage.h"
#include "simulation/scene/image.h"

namespace arthro::test {

struct Film {
  authoring::FootageInfo info;
  std::vector<cv::Mat> frames;  // 8-bit RGB
};

// Throws Error for a file that is no film.
Film ReadFilm(const std::filesystem::path& file);

// dB of grey, since a film holds colours at half the size.
double LumaPsnr(const cv::Mat& rgb, const ColourImage& picture);

}  // namespace arthro::test
