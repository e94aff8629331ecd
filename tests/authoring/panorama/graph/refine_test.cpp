#include "authoring/panorama/graph/refinement/refine.h"

#include <chrono>
#include <cmath>
#include <numeric>
#include <random>

#include <gtest/gtest.h>

#include "authoring/panorama/graph/links/pair_graph.h"
#include "authoring/panorama/graph/refinement/uncertainty.h"
#include "tests/authoring/panorama/graph/simulated_clip.h"

namespace arthro::authoring {
namespace {

using namespace arthro::test;

// Neighbours, next neighbours and, in a ring, the pairs that close it.
std::vector<PairEstimate> PairsOf(const std::vector<cv::Matx33d>& places, bool is_closed,
                                  double sigma, std::mt19937& random) {
  const int frames = static_cast<int>(places.size());
  std::vector<PairEstimate> pairs;
  for (int step = 1; step <= 2; ++step)
    for (int i = 0; i + (is_closed ? 0 : step) < frames; ++i)
      pairs.push_back(NoisyPair(places, i, (i + step) % frames, sigma, random));
  return pairs;
}

RefineOptions WithoutFloor() {
  RefineOptions options;
  options.pair_floor = 0;
  return options;
}

Refined RefineFromTree(const std::vector<PairEstimate>& pairs, int frames, int root,
                       const RefineOptions& options, RefineSolver solver = RefineSolver::kSparse) {
  return Refine(pairs, LeastVarianceTree(frames, pairs, root).root_from_frame, root, options,
                std::nullopt, solver);
}

TEST(Refine, BeatsTheTreeItStartsFrom) {
  std::mt19937 random(1);
  const auto places = TruePlaces(32, true);
  const auto pairs = PairsOf(places, true, 0.3, random);
  const Tree tree = LeastVarianceTree(32, pairs, 0);
  const auto before = WorstErrors(tree.root_from_frame, places);
  const auto after = WorstErrors(RefineFromTree(pairs, 32, 0, {}).plane_from_frame, places);
  const double worst_before = *std::max_element(before.begin(), before.end());
  const double worst_after = *std::max_element(after.begin(), after.end());
  std::printf("worst error %.2f px by the tree, %.2f px refined\n", worst_before, worst_after);
  EXPECT_LT(worst_after, 0.5 * worst_before);
}

TEST(Refine, ExactPairsGiveExactPlaces) {
  std::mt19937 random(2);
  const auto places = TruePlaces(24, false);
  auto pairs = PairsOf(places, false, 1e-9, random);
  for (PairEstimate& pair : pairs) pair.information = cv::Matx<double, 8, 8>::eye();
  for (const double error : WorstErrors(RefineFromTree(pairs, 24, 12, {}).plane_from_frame, places))
    EXPECT_LT(error, 1e-5);  // rounding of the pairs, accumulated along the chain
}

TEST(Refine, SparseAnswerIsTheDenseOne) {
  std::mt19937 random(3);
  const auto places = TruePlaces(20, true);
  const auto pairs = PairsOf(places, true, 0.4, random);
  const Refined sparse = RefineFromTree(pairs, 20, 0, {});
  const Refined dense = RefineFromTree(pairs, 20, 0, {}, RefineSolver::kDense);
  for (std::size_t i = 0; i < places.size(); ++i)
    for (const cv::Point2d& p : NinePoints())
      EXPECT_LT(cv::norm(Move(sparse.plane_from_frame[i], p) - Move(dense.plane_from_frame[i], p)),
                1e-3);  // both stop within the same small step of the single minimum
}

TEST(Refine, DoesNotDependOnTheFrameThatStaysFixed) {
  std::mt19937 random(4);
  const auto places = TruePlaces(20, true);
  const auto pairs = PairsOf(places, true, 0.4, random);
  const Refined first = RefineFromTree(pairs, 20, 0, {});
  const Refined second = RefineFromTree(pairs, 20, 9, {});
  for (const PairEstimate& pair : pairs) {
    const auto a = static_cast<std::size_t>(pair.a), b = static_cast<std::size_t>(pair.b);
    for (const cv::Point2d& p : pair.control_in_a)
      EXPECT_LT(cv::norm(Move(first.plane_from_frame[b].inv() * first.plane_from_frame[a], p) -
                         Move(second.plane_from_frame[b].inv() * second.plane_from_frame[a], p)),
                2e-3);
  }
}

// PAN-19: the same clip in other units.
TEST(Refine, ScaleOfTheCoordinatesDoesNotMatter) {
  std::mt19937 random(5);
  const auto places = TruePlaces(20, true);
  const auto pairs = PairsOf(places, true, 0.4, random);
  const Refined plain = RefineFromTree(pairs, 20, 0, WithoutFloor());
  for (const double scale : {1e-3, 1e3}) {
    const cv::Matx33d s(scale, 0, 0, 0, scale, 0, 0, 0, 1);
    auto scaled = pairs;
    for (PairEstimate& pair : scaled) {
      for (cv::Point2d& c : pair.control_in_a) c *= scale;
      pair.b_from_a = s * pair.b_from_a * s.inv();
      pair.information *= 1 / (scale * scale);
    }
    auto start = LeastVarianceTree(20, pairs, 0).root_from_frame;
    for (cv::Matx33d& m : start) m = s * m * s.inv();
    const Refined other = Refine(scaled, start, 0, WithoutFloor());
    for (std::size_t i = 0; i < places.size(); ++i)
      for (const cv::Point2d& p : NinePoints())
        EXPECT_LT(cv::norm(Move(other.plane_from_frame[i], p * scale) * (1 / scale) -
                           Move(plain.plane_from_frame[i], p)),
                  1e-3);
  }
}

TEST(Refine, OneWrongPairDoesNotPullTheOthers) {
  std::mt19937 random(6);
  const auto places = TruePlaces(32, true);
  auto pairs = PairsOf(places, true, 0.2, random);
  const auto clean = WorstErrors(RefineFromTree(pairs, 32, 0, {}).plane_from_frame, places);
  pairs[40].b_from_a = cv::Matx33d(1, 0, 25, 0, 1, -15, 0, 0, 1) * pairs[40].b_from_a;
  const Refined refined = RefineFromTree(pairs, 32, 0, {});
  const auto spoilt = WorstErrors(refined.plane_from_frame, places);
  for (std::size_t i = 0; i < places.size(); ++i) EXPECT_LT(spoilt[i], clean[i] + 0.5);
  EXPECT_GT(refined.pair_surprise[40], 10.0);
}

TEST(Uncertainty, CoversTheTrueErrorOf95PercentAndStaysUseful) {
  const auto places = TruePlaces(24, true);
  int covered = 0, all = 0;
  double promised = 0, made = 0;
  for (unsigned trial = 0; trial < 200; ++trial) {
    std::mt19937 random(trial + 100);
    const auto pairs = PairsOf(places, true, 0.3, random);
    const Refined refined = RefineFromTree(pairs, 24, 0, WithoutFloor());
    const Uncertainty uncertainty =
        EstimateUncertainty(pairs, std::vector<double>(pairs.size(), 1 / refined.variance_factor),
                            refined.plane_from_frame, 0, NinePoints(), 0);
    // Maps the truth to the estimated plane.
    const auto error = WorstErrors(places, refined.plane_from_frame);
    for (std::size_t i = 0; i < places.size(); ++i) {
      ++all;
      covered += error[i] <= uncertainty.error_px[i];
      promised += uncertainty.error_px[i];
      made += error[i];
    }
  }
  std::printf("covered %.1f %%, promised %.2f px for %.2f px\n", 100.0 * covered / all,
              promised / all, made / all);
  EXPECT_GE(covered, 0.95 * all);
  EXPECT_LT(promised, 3.0 * made);  // a much larger bound would be useless
}

TEST(Uncertainty, IsTheSameWhicheverFrameIsFixed) {
  std::mt19937 random(8);
  const auto places = TruePlaces(24, false);
  const auto pairs = PairsOf(places, false, 0.3, random);
  const std::vector<double> weights(pairs.size(), 1.0);
  const auto first = EstimateUncertainty(pairs, weights, places, 0, NinePoints(), 0.05);
  const auto second = EstimateUncertainty(pairs, weights, places, 17, NinePoints(), 0.05);
  for (std::size_t i = 0; i < places.size(); ++i)
    EXPECT_NEAR(first.error_px[i], second.error_px[i], 1e-3 * first.error_px[i]);
}

TEST(Uncertainty, SaysWhichPairsNothingChecks) {
  std::mt19937 random(9);
  const auto places = TruePlaces(10, false);
  auto pairs = PairsOf(places, false, 0.3, random);
  // Frames 5 and 6 are connected by a single pair.
  std::erase_if(pairs,
                [](const PairEstimate& p) { return p.b - p.a == 2 && (p.a == 4 || p.a == 5); });
  const auto uncertainty = EstimateUncertainty(pairs, std::vector<double>(pairs.size(), 1.0),
                                               places, 0, NinePoints(), 0.05);
  const std::vector<bool> bridges = BridgesOf(10, pairs);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const bool is_bridge = pairs[i].a == 5 && pairs[i].b == 6;
    EXPECT_EQ(bridges[i], is_bridge);
    if (is_bridge)
      EXPECT_LT(uncertainty.pair_checked[i], 0.01);
    else
      EXPECT_GT(uncertainty.pair_checked[i], 0.1);
  }
}

// PAN-09: the cost of a frame does not grow with the clip.
TEST(Refine, ThreeHundredFramesCostLittleEach) {
  std::mt19937 random(10);
  const auto places = TruePlaces(300, true, 45);
  const auto pairs = PairsOf(places, true, 0.3, random);
  const std::clock_t begin = std::clock();
  const Refined refined = RefineFromTree(pairs, 300, 0, {});
  const auto uncertainty = EstimateUncertainty(pairs, std::vector<double>(pairs.size(), 1.0),
                                               refined.plane_from_frame, 0, NinePoints(), 0.05);
  const double ms = 1e3 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC / 300;
  std::printf("%.2f ms a frame of 300\n", ms);
  EXPECT_LT(ms, 25.0);  // a release build needs 5 ms; a sanitizer may take several times as long
  EXPECT_TRUE(std::isfinite(uncertainty.error_px[150]));
}

TEST(Refine, TenEqualPosesGiveTheIdentity) {
  std::mt19937 random(11);
  const std::vector<cv::Matx33d> places(10, cv::Matx33d::eye());
  const auto pairs = PairsOf(places, false, 1e-6, random);
  const Refined refined = RefineFromTree(pairs, 10, 5, {});
  for (const cv::Matx33d& m : refined.plane_from_frame)
    for (const cv::Point2d& p : NinePoints()) EXPECT_LT(cv::norm(Move(m, p) - p), 1e-3);
}

}  // namespace
}  // namespace arthro::authoring
