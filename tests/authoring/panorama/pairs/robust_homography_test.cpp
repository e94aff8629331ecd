// The homography of most agreement, with matches made in code.
#include "authoring/panorama/pairs/robust_homography.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "authoring/panorama/pairs/pair_estimate.h"

using namespace arthro;
using namespace arthro::authoring;

namespace {

constexpr double kReach = 400;

struct Matches {
  std::vector<cv::Point2d> a, b;
};

// `right` matches of `truth` with noise of 0.5 px per axis, and `wrong` ones at random.
Matches MakeMatches(const cv::Matx33d& truth, int right, int wrong, int seed, double noise = 0.5) {
  cv::RNG random(static_cast<std::uint64_t>(seed) * 77777 + 5);
  Matches m;
  for (int i = 0; i < right + wrong; ++i) {
    const cv::Point2d p(random.uniform(50.0, 750.0), random.uniform(50.0, 750.0));
    m.a.push_back(p);
    if (i < right)
      m.b.push_back(Apply(truth, p) + cv::Point2d(random.gaussian(noise), random.gaussian(noise)));
    else
      m.b.emplace_back(random.uniform(50.0, 750.0), random.uniform(50.0, 750.0));
  }
  return m;
}

cv::Matx33d Perspective() {
  const double c = 1.05 * std::cos(0.12), s = 1.05 * std::sin(0.12);
  return {c, -s, 60, s, c, -45, 6e-5, -4e-5, 1};
}

double WorstError(const cv::Matx33d& found, const cv::Matx33d& truth) {
  double worst = 0;
  for (const double x : {100.0, 400.0, 700.0})
    for (const double y : {100.0, 400.0, 700.0})
      worst = std::max(worst, cv::norm(Apply(found, {x, y}) - Apply(truth, {x, y})));
  return worst;
}

}  // namespace

TEST(RobustHomography, IsRightAmongTwiceAsManyOutliers) {
  for (int seed = 1; seed <= 20; ++seed) {
    const Matches m = MakeMatches(Perspective(), 60, 120, seed);
    const RobustHomography found = FindHomography(m.a, m.b, kReach, {});
    ASSERT_TRUE(found.is_found) << seed << ": " << found.why_not;
    // 60 points of 0.5 px: sigma at the corners is about 0.35 px per axis.
    EXPECT_LT(WorstError(found.b_from_a, Perspective()), 1.5) << seed;
    EXPECT_GE(found.inliers.size(), 55u);
    EXPECT_EQ(found.kind, PlaneMap::kHomography);
    EXPECT_NEAR(found.rms, 0.7, 0.2);  // 0.5 px on each of two axes
  }
}

TEST(RobustHomography, PerspectiveOnlyWhereItPays) {
  const double c = std::cos(0.3), s = std::sin(0.3);
  const cv::Matx33d similarity(c, -s, 30, s, c, 10, 0, 0, 1);
  int kept_simple = 0;
  for (int seed = 1; seed <= 20; ++seed) {
    const Matches m = MakeMatches(similarity, 80, 20, seed);
    const RobustHomography found = FindHomography(m.a, m.b, kReach, {});
    ASSERT_TRUE(found.is_found);
    kept_simple += found.kind == PlaneMap::kSimilarity;
    EXPECT_LT(WorstError(found.b_from_a, similarity), 1.0);
  }
  // With log n per parameter, noise justifies four of them in about one case in a hundred.
  EXPECT_GE(kept_simple, 18);
}

TEST(RobustHomography, PointsAlongOneVesselAreRefused) {
  // PAN-15: a band 4 px wide does not determine the map beside it.
  cv::RNG random(9);
  std::vector<cv::Point2d> a, b;
  for (int i = 0; i < 80; ++i) {
    const double t = random.uniform(0.0, 600.0);
    a.emplace_back(100 + t + random.gaussian(2), 150 + 0.7 * t + random.gaussian(2));
    b.push_back(Apply(Perspective(), a.back()) +
                cv::Point2d(random.gaussian(0.5), random.gaussian(0.5)));
  }
  const RobustHomography found = FindHomography(a, b, kReach, {});
  EXPECT_FALSE(found.is_found);
  EXPECT_NE(found.why_not.find("one line"), std::string::npos) << found.why_not;
}

TEST(RobustHomography, ChanceDoesNotPassForAgreement) {
  int accepted = 0;
  for (int seed = 1; seed <= 50; ++seed) {
    const Matches m = MakeMatches(cv::Matx33d::eye(), 0, 200, seed);
    accepted += FindHomography(m.a, m.b, kReach, {}).is_found;
  }
  EXPECT_EQ(accepted, 0);
}

TEST(RobustHomography, TheUnitDoesNotMatter) {
  // PAN-19: coordinates times 1e-3 and 1e3 give the same map, to 1e-3 px.
  const Matches m = MakeMatches(Perspective(), 60, 60, 3);
  const RobustHomography reference = FindHomography(m.a, m.b, kReach, {});
  ASSERT_TRUE(reference.is_found);
  for (const double unit : {1e-3, 1e3}) {
    Matches scaled = m;
    for (auto* points : {&scaled.a, &scaled.b})
      for (auto& p : *points) p *= unit;
    FeatureOptions options;
    options.max_error *= unit;
    const RobustHomography found = FindHomography(scaled.a, scaled.b, unit * kReach, options);
    ASSERT_TRUE(found.is_found);
    const cv::Matx33d up(unit, 0, 0, 0, unit, 0, 0, 0, 1);
    EXPECT_LT(WorstError(up.inv() * found.b_from_a * up, reference.b_from_a), 1e-3);
    EXPECT_EQ(found.inliers, reference.inliers);
  }
}

TEST(RobustHomography, TooFewOrDegenerateMatchesAreARefusalInWords) {
  EXPECT_FALSE(FindHomography({}, {}, kReach, {}).why_not.empty());
  const std::vector<cv::Point2d> same(40, {5, 5});
  const RobustHomography found = FindHomography(same, same, kReach, {});
  EXPECT_FALSE(found.is_found);
  EXPECT_FALSE(found.why_not.empty());
}
