#include "authoring/relief/surface/semi_global.h"

#include <cmath>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

namespace arthro::authoring {
namespace {

// Scores that peak at a slanted surface, under noise.
std::vector<cv::Mat> SlantedScores(double noise) {
  constexpr int kLayers = 24, kSide = 40;
  cv::RNG random(7);
  std::vector<cv::Mat> scores;
  for (int k = 0; k < kLayers; ++k) {
    cv::Mat score(kSide, kSide, CV_32F);
    for (int y = 0; y < kSide; ++y)
      for (int x = 0; x < kSide; ++x) {
        const double off = k - (6 + 0.25 * x);
        score.at<float>(y, x) =
            static_cast<float>(0.8 * std::exp(-0.5 * off * off) + random.gaussian(noise));
      }
    scores.push_back(score);
  }
  return scores;
}

TEST(ChooseLayers, FollowsASlantedSurfaceBelowOneLayer) {
  const LayerChoice choice = ChooseLayers(SlantedScores(0.02));
  for (int x = 2; x < 38; ++x) EXPECT_NEAR(choice.layer.at<float>(20, x), 6 + 0.25 * x, 0.3);
}

TEST(ChooseLayers, PrefersTheSmoothSurfaceInNoise) {
  const std::vector<cv::Mat> scores = SlantedScores(0.3);
  const LayerChoice choice = ChooseLayers(scores);
  int wrong = 0, wrong_alone = 0;
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 40; ++x) {
      std::size_t best = 0;
      for (std::size_t k = 1; k < scores.size(); ++k)
        if (scores[k].at<float>(y, x) > scores[best].at<float>(y, x)) best = k;
      wrong_alone += std::abs(static_cast<double>(best) - (6 + 0.25 * x)) > 1.5;
      wrong += std::abs(choice.layer.at<float>(y, x) - (6 + 0.25 * x)) > 1.5;
    }
  EXPECT_LT(wrong, wrong_alone);
  // The goal for the hardest clips is that at most 4 % of the cells are far off.
  EXPECT_LE(wrong, 0.04 * 1600) << "of 1600 cells";
}

TEST(ChooseLayers, LeavesCellsWithoutAnyScoreUnknown) {
  std::vector<cv::Mat> scores = SlantedScores(0.02);
  for (cv::Mat& score : scores) score(cv::Rect(10, 10, 5, 5)).setTo(-1);
  const LayerChoice choice = ChooseLayers(scores);
  EXPECT_EQ(choice.layer.at<float>(12, 12), -1);
  EXPECT_GT(choice.layer.at<float>(30, 30), 0);
}

}  // namespace
}  // namespace arthro::authoring
