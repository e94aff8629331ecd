#include "authoring/panorama/graph/links/pair_graph.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "authoring/panorama/graph/cycle_check.h"
#include "tests/authoring/panorama/graph/simulated_clip.h"

namespace arthro::authoring {
namespace {

using namespace arthro::test;

TEST(PairGraph, LargestPieceComesFirst) {
  std::mt19937 random(1);
  const auto places = TruePlaces(9, false);
  std::vector<PairEstimate> pairs;
  for (const auto& [a, b] : {std::pair{0, 1}, {3, 4}, {4, 5}, {5, 6}, {7, 8}})
    pairs.push_back(NoisyPair(places, a, b, 0.2, random));
  EXPECT_EQ(PiecesOf(9, pairs), (std::vector<int>{1, 1, 3, 0, 0, 0, 0, 2, 2}));
}

TEST(PairGraph, MiddleOfAChainIsCentral) {
  std::mt19937 random(2);
  const auto places = TruePlaces(21, false);
  std::vector<PairEstimate> pairs;
  for (int i = 0; i + 1 < 21; ++i) pairs.push_back(NoisyPair(places, i, i + 1, 0.2, random));
  EXPECT_NEAR(CentralFrame(21, pairs, 3), 10, 1);
}

TEST(CycleCheck, FalsePairsAreFoundAndTrueOnesKept) {
  std::mt19937 random(3);
  const auto places = TruePlaces(40, true);
  std::vector<PairEstimate> pairs;
  for (int step = 1; step <= 3; ++step)
    for (int i = 0; i < 40; ++i)
      pairs.push_back(NoisyPair(places, i, (i + step) % 40, 0.2, random));
  const std::vector<std::size_t> wrong{5, 23, 44, 70, 95, 110};
  for (const std::size_t i : wrong)
    pairs[i].b_from_a = cv::Matx33d(1, 0.02, 18, 0, 1, -12, 0, 0, 1) * pairs[i].b_from_a;
  const CycleCheck check = CheckTriangles(40, pairs, {});
  for (std::size_t i = 0; i < pairs.size(); ++i)
    EXPECT_EQ(check.is_false[i], std::find(wrong.begin(), wrong.end(), i) != wrong.end()) << i;
  EXPECT_LT(check.worst_closure_px, 4.0);
  EXPECT_GT(check.mean_closure_px, 0.05);
}

TEST(CycleCheck, PairsThatPointTheOtherWayCloseToo) {
  std::mt19937 random(4);
  const auto places = TruePlaces(3, false);
  const std::vector<PairEstimate> pairs{NoisyPair(places, 1, 0, 0.1, random),
                                        NoisyPair(places, 2, 1, 0.1, random),
                                        NoisyPair(places, 0, 2, 0.1, random)};
  const CycleCheck check = CheckTriangles(3, pairs, {});
  for (const TriangleVote& vote : check.votes) EXPECT_EQ(vote.closes, 1);
}

}  // namespace
}  // namespace arthro::authoring
