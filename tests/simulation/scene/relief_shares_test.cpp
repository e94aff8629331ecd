#include "simulation/scene/backdrop/relief_shares.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace arthro {
namespace {

TEST(ReliefShares, TheMedianErrorIsThatOfTheSortedErrorsOfKnownDepths) {
  std::mt19937 random(2);
  std::lognormal_distribution<float> error(-8.0f, 2.0f);
  for (const int width : {1, 2, 7, 64, 301}) {
    DepthMap depth(width, 13, 0.01f), sigma(width, 13);
    std::vector<float> known;
    for (std::size_t i = 0; i < sigma.relief.size(); ++i) {
      sigma.relief[i] = i % 11 == 5 ? std::nanf("") : error(random);
      if (i % 7 == 3) depth.relief[i] = std::nanf("");
      if (i % 11 != 5 && i % 7 != 3) known.push_back(sigma.relief[i]);
    }
    std::sort(known.begin(), known.end());
    EXPECT_EQ(SharesOf(depth, sigma, {}).median_sigma, static_cast<double>(known[known.size() / 2]))
        << width;
  }
  EXPECT_FALSE(SharesOf(DepthMap(3, 3), {}, {}).median_sigma);
  EXPECT_FALSE(SharesOf(DepthMap(3, 3, std::nanf("")), DepthMap(3, 3, 1e-4f), {}).median_sigma);
}

}  // namespace
}  // namespace arthro
