// A relief of 61 x 41 cells of half a degree about the portal's axis, with a plane of known place
// or a sphere as its surface.
#pragma once

#include "authoring/relief/editing/relief_view.h"

namespace arthro::test {

struct SmallRelief {
  static constexpr int kWidth = 61, kHeight = 41;
  static constexpr double kRadius = 0.04;  // m
  DepthMap relief{kWidth, kHeight, 0.0f};
  DepthMap sigma{kWidth, kHeight, 1e-4f};
  OriginMap origin{kWidth, kHeight, ReliefOrigin::kMeasured};
  Projection projection{ProjectionType::kEquirectangular, {30, 20}, 1000, 2};

  authoring::ReliefView view() const { return {relief, sigma, origin, projection, kRadius}; }
  // The plane z = `distance`.
  void MakePlane(double distance) {
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x)
        relief.at(x, y) =
            static_cast<float>(kRadius - distance / DirectionFromPixel(projection, {x, y}).z);
  }
};

}  // namespace arthro::test
