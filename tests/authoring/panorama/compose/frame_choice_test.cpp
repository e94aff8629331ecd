#include "authoring/panorama/compose/frame_choice.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/authoring/panorama/compose/small_clip.h"

namespace arthro::authoring {
namespace {

// A real view keeps its detail when its gradient is within 20 % of its frames'.
constexpr double kLeastDetail = 0.8;
constexpr int kFrames = 12, kStep = 8;  // px between two windows

// Windows of one picture with lines of 6 px.
test::SmallClip FineClip() {
  test::SmallClip clip;
  clip.picture = test::TissuePicture(test::kWindowWidth + (kFrames - 1) * kStep + 8, 128);
  for (int y = 0; y < clip.picture.rows; ++y)
    for (int x = 0; x < clip.picture.cols; ++x)
      for (int c = 0; c < 3; ++c)
        clip.picture.at<cv::Vec3b>(y, x)[c] +=
            static_cast<uchar>(std::lround(20 + 10 * std::sin(x * 1.05) + 10 * std::sin(y * 1.05)));
  for (int i = 0; i < kFrames; ++i) clip.corners.emplace_back(4 + i * kStep, 4);
  return clip;
}

double MeanGradient(const cv::Mat& rgb, const cv::Rect& part) {
  cv::Mat grey, across, down;
  cv::cvtColor(rgb(part), grey, cv::COLOR_RGB2GRAY);
  cv::Sobel(grey, across, CV_32F, 1, 0, 1);
  cv::Sobel(grey, down, CV_32F, 0, 1, 1);
  return cv::mean(cv::abs(across) + cv::abs(down))[0];
}

// Detail of the panorama as a share of the frames'. Each frame lies up to 3 px off, as over
// parallax.
double DetailKept(const test::SmallClip& clip, double expected_error_px) {
  std::vector<FrameResult> places = clip.Places();
  for (FrameResult& place : places) {
    place.expected_error_px = expected_error_px;
    place.panorama_from_rectified = cv::Matx33d(1, 0, 3 * std::sin(2.4 * place.index), 0, 1,
                                                3 * std::cos(2.4 * place.index), 0, 0, 1) *
                                    place.panorama_from_rectified;
  }
  const cv::Mat rgba =
      Compose(clip.Source(), test::PinholeRectifier(), places, {}, nullptr, {}).rgba;
  cv::Mat rgb;
  cv::cvtColor(rgba, rgb, cv::COLOR_RGBA2RGB);
  const cv::Rect middle(60, 20, 120, 80);
  return MeanGradient(rgb, middle) / MeanGradient(clip.picture, middle);
}

TEST(FrameChoice, DetailSurvivesPlacesThatAreInDoubtByPixels) {
  EXPECT_GE(DetailKept(FineClip(), 40), kLeastDetail);
}

// The mean lowers the noise of frames that lie exactly. These do not, and it loses their detail.
TEST(FrameChoice, FramesWithoutDoubtAreAveraged) {
  EXPECT_LT(DetailKept(FineClip(), 0), kLeastDetail);
}

TEST(FrameChoice, BlurredFramesAreNotChosen) {
  test::SmallClip clip = FineClip();
  clip.spoil = [](int index, cv::Mat& window) {
    if (index % 2 == 0) cv::GaussianBlur(window, window, {}, 2);
  };
  EXPECT_GE(DetailKept(clip, 40), kLeastDetail);
}

}  // namespace
}  // namespace arthro::authoring
