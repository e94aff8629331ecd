// Fit and check of tie points, without pictures.
#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "authoring/panorama/pairs/pair_estimate.h"
#include "authoring/panorama/ties/place_ties.h"
#include "simulation/core/error.h"

namespace arthro::authoring {
namespace {

constexpr double kWindow = 600;  // px
using Points = std::vector<cv::Point2d>;

cv::Matx33d Similarity(double scale, double angle, double x, double y) {
  const double c = scale * std::cos(angle), s = scale * std::sin(angle);
  return {c, -s, x, s, c, y, 0, 0, 1};
}

std::vector<std::string> Names(std::size_t count) {
  std::vector<std::string> names;
  for (std::size_t i = 1; i <= count; ++i) names.push_back(fmt::format("pair {}", i));
  return names;
}

Points Images(const cv::Matx33d& h, const Points& points) {
  Points images;
  for (const cv::Point2d& p : points) images.push_back(Apply(h, p));
  return images;
}

std::string SentenceOf(const Points& a, const Points& b) {
  try {
    FitTies(a, b, Names(a.size()), kWindow);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), Code::kBadData);
    return error.sentence();
  }
  return "";
}

const Points kFour = {{100, 120}, {480, 150}, {420, 500}, {140, 430}};

TEST(TieFit, RecoversASimilarityFromTwoPairs) {
  const cv::Matx33d truth = Similarity(1.2, 0.4, 30, -55);
  const Points a = {kFour[0], kFour[2]};
  const TieFit fit = FitTies(a, Images(truth, a), Names(2), kWindow);
  EXPECT_NEAR(fit.scale, 1.2, 1e-12);
  for (const cv::Point2d& p : kFour)
    EXPECT_LT(cv::norm(Apply(fit.b_from_a, p) - Apply(truth, p)), 1e-9);
}

// Var = s²(1 + scale²)(1/n + |x - m|²/S) per coordinate: the textbook law of a similarity's fit,
// against the scatter of 4000 fits with clicks of that error. The scatter of a standard deviation
// over 4000 samples is 1.1 %, so 5 % is beyond four of its deviations.
TEST(TieFit, PredictsTheErrorOfNoisyClicks) {
  const cv::Matx33d truth = Similarity(1.1, -0.3, 10, 20);
  const Points exact = Images(truth, kFour);
  const cv::Point2d at(560, 300);
  cv::RNG random(3);
  const auto noisy = [&](const Points& points) {
    Points moved = points;
    for (cv::Point2d& p : moved)
      p += cv::Point2d(random.gaussian(kClickDeviation), random.gaussian(kClickDeviation));
    return moved;
  };
  double square = 0;
  constexpr int kTrials = 4000;
  for (int i = 0; i < kTrials; ++i) {
    const TieFit fit = FitTies(noisy(kFour), noisy(exact), Names(4), kWindow);
    square += std::pow(cv::norm(Apply(fit.b_from_a, at) - Apply(truth, at)), 2);
  }
  const double predicted = TieError(FitTies(kFour, exact, Names(4), kWindow), at);
  EXPECT_NEAR(std::sqrt(square / kTrials) / predicted, 1, 0.05);
}

TEST(TieFit, NamesTheWrongPairOfFour) {
  for (std::size_t wrong = 0; wrong < 4; ++wrong) {
    Points b = Images(Similarity(0.9, 0.1, 5, 5), kFour);
    b[wrong] += cv::Point2d(90, -60);
    EXPECT_NE(SentenceOf(kFour, b).find(fmt::format("pair {} misses", wrong + 1)),
              std::string::npos)
        << SentenceOf(kFour, b);
  }
}

TEST(TieFit, ThreePairsThatContradictOneAnotherNameNone) {
  const Points a = {kFour[0], kFour[1], kFour[2]};
  Points b = a;
  b[1] += cv::Point2d(120, 80);
  EXPECT_NE(SentenceOf(a, b).find("none of them alone can be told to be wrong"), std::string::npos)
      << SentenceOf(a, b);
}

TEST(TieFit, RefusesWhatGivesNoPlace) {
  EXPECT_NE(SentenceOf({{10, 10}}, {{20, 20}}).find("two or more"), std::string::npos);
  EXPECT_NE(SentenceOf({{10, 10}, {20, 10}}, {{0, 0}, {10, 0}}).find("further apart"),
            std::string::npos);
  EXPECT_NE(SentenceOf({{10, 10}, {50, 10}}, {{0, 0}, {40, 0}}).find("would give the place to"),
            std::string::npos)
      << SentenceOf({{10, 10}, {50, 10}}, {{0, 0}, {40, 0}});
  EXPECT_NE(SentenceOf({{100, 100}, {200, 100}}, {{0, 0}, {500, 0}}).find("times the size"),
            std::string::npos);
}

// Points on one line give a similarity as well as others do; only its error across the line grows.
TEST(TieFit, PointsOnOneLineAreEnough) {
  const Points a = {{100, 300}, {300, 300}, {500, 300}};
  const TieFit fit = FitTies(a, Images(Similarity(1, 0.2, 3, 4), a), Names(3), kWindow);
  EXPECT_NEAR(fit.scale, 1, 1e-12);
}

}  // namespace
}  // namespace arthro::authoring
