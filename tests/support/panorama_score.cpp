#include "tests/support/panorama_score.h"

#include <cmath>

#include <opencv2/imgproc.hpp>

namespace arthro::test {
namespace {

cv::Mat Blur(const cv::Mat& picture, double sigma) {
  cv::Mat blurred;
  cv::GaussianBlur(picture, blurred, {0, 0}, sigma);
  return blurred;
}

cv::Mat Three(const cv::Mat& plane) {
  cv::Mat three;
  cv::merge(std::vector<cv::Mat>(3, plane), three);
  return three;
}

// Mean over the known pixels around each pixel.
cv::Mat Surround(const cv::Mat& picture, const cv::Mat& known) {
  cv::Mat share = cv::max(Blur(known, 40), 1e-3f);
  return Blur(picture.mul(Three(known)), 40) / Three(share);
}

}  // namespace

PanoramaScore ScorePanorama(const cv::Mat& rgba, const cv::Mat& truth,
                            const cv::Matx33d& composed_from_truth) {
  cv::Mat seen, mask, rgb;
  cv::warpPerspective(rgba, seen, composed_from_truth, truth.size(),
                      cv::INTER_LINEAR | cv::WARP_INVERSE_MAP);
  cv::extractChannel(seen, mask, 3);
  cv::erode(mask > 0, mask, cv::Mat::ones(9, 9, CV_8U), {-1, -1}, 1, cv::BORDER_CONSTANT, 0);
  cv::cvtColor(seen, rgb, cv::COLOR_RGBA2RGB);
  const cv::Size half = truth.size() / 2;
  cv::Mat known, a, b;
  cv::resize(mask, known, half, 0, 0, cv::INTER_AREA);
  cv::resize(truth, a, half, 0, 0, cv::INTER_AREA);
  cv::resize(rgb, b, half, 0, 0, cv::INTER_AREA);
  known = known > 252;
  PanoramaScore score;
  const int count = cv::countNonZero(known);
  if (count == 0) return score;
  score.share = static_cast<double>(count) / static_cast<double>(known.total());
  cv::Mat is_known;
  known.convertTo(is_known, CV_32F, 1.0 / 255);
  a.convertTo(a, CV_32F);
  b.convertTo(b, CV_32F);
  cv::Mat ratio = Surround(a, is_known) / cv::max(Surround(b, is_known), cv::Scalar::all(1));
  ratio = cv::min(cv::max(ratio, cv::Scalar::all(0.2)), cv::Scalar::all(5));
  b = cv::min(cv::max(b.mul(ratio), cv::Scalar::all(0)), cv::Scalar::all(255));
  const double error = cv::norm(a, b, cv::NORM_L2SQR, known) / (3.0 * count);
  score.psnr = 10 * std::log10(255 * 255 / std::max(error, 1e-9));

  // SSIM [Wang et al. 2004] in windows of 7 x 7.
  cv::Mat x, y;
  cv::extractChannel(a, x, 1);
  cv::extractChannel(b, y, 1);
  const auto mean = [](const cv::Mat& plane) {
    cv::Mat result;
    cv::blur(plane, result, {7, 7});
    return result;
  };
  const cv::Mat mx = mean(x), my = mean(y);
  const cv::Mat xx = mean(x.mul(x)) - mx.mul(mx), yy = mean(y.mul(y)) - my.mul(my);
  const cv::Mat xy = mean(x.mul(y)) - mx.mul(my);
  const double c1 = 0.01 * 255 * 0.01 * 255, c2 = 0.03 * 255 * 0.03 * 255;
  const cv::Mat above = (2 * mx.mul(my) + c1).mul(2 * xy + c2);
  const cv::Mat below = (mx.mul(mx) + my.mul(my) + c1).mul(xx + yy + c2);
  score.ssim = cv::mean(above / below, known)[0];
  return score;
}

}  // namespace arthro::test
