// Error of a composed panorama against the evenly lit plane that it shows: PSNR and SSIM at half
// size, after the slow ratio of brightness (blur of 80 px) is removed.
#pragma once

#include <opencv2/core.hpp>

namespace arthro::test {

struct PanoramaScore {
  double psnr = 0;   // dB, over RGB
  double ssim = 0;   // green channel
  double share = 0;  // part of `truth` that was compared
};

// `rgba`: the panorama. `composed_from_truth` takes pixels of `truth` (CV_8UC3, RGB) to its pixels.
PanoramaScore ScorePanorama(const cv::Mat& rgba, const cv::Mat& truth,
                            const cv::Matx33d& composed_from_truth);

}  // namespace arthro::test
