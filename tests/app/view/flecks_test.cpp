// Flecks that drift in saline: where they are, how sharp, and that they change nothing else.
#include <algorithm>
#include <cstdio>
#include <vector>

#include <glm/geometric.hpp>

#include "app/view/disturbances/drifting_bits.h"
#include "tests/app/view/disturbed_view.h"

namespace arthro::test {
namespace {

using app::Disturbances;

constexpr double kLastFleck = 8e-3;                // m; farther flecks are in focus
constexpr double kSofterFleck = kLastFleck / 2.2;  // m; nearer flecks are softer than others
constexpr double kLeastSoftness = 0.6;             // least of a fleck
constexpr double kOpacityOfFlecks = 0.6;           // opacity of a sharp one

// At many times: those near the lens are spread and faint, and some are always in sight.
TEST_F(DisturbedView, FlecksNearTheLensAreOutOfFocus) {
  int near = 0, far = 0;
  for (int second = 0; second < 60; ++second) {
    Disturbances still;
    still.time = second;
    const auto flecks =
        app::Flecks(app::kUsualFlecks, still, picture_.view, picture_.field_of_view);
    EXPECT_GE(flecks.size(), 1u) << second;
    for (const app::DriftingBit& fleck : flecks) {
      (fleck.distance < kLastFleck ? near : far) += 1;
      EXPECT_GE(fleck.softness, kLeastSoftness);
      EXPECT_EQ(fleck.softness > kLeastSoftness, fleck.distance < kSofterFleck);
      EXPECT_LE(fleck.opacity, kOpacityOfFlecks / (1.0 + 2.0 * fleck.softness));
    }
  }
  std::printf("flecks in sight: %.1f near the lens, %.1f in focus\n", near / 60.0, far / 60.0);
  EXPECT_GT(near, 60);
  EXPECT_GT(far, 30);
}

TEST_F(DisturbedView, FlecksChangeThePictureOnlyWhereTheyAre) {
  ShowWall(Grey(100), 40e-3);
  Disturbances still;
  const ColourImage clear = Draw(still);
  const std::vector<float> distances = view_->ReadDistances();
  picture_.flecks = app::kUsualFlecks;
  const auto flecks = app::Flecks(picture_.flecks, still, picture_.view, picture_.field_of_view);
  const ColourImage picture = Draw(still);
  const auto [changed, elsewhere] = ChangedBetween(clear, picture, [&](const glm::dvec2& at) {
    return std::ranges::any_of(flecks, [&](const app::DriftingBit& fleck) {
      return glm::distance(at, fleck.centre) < 1.5 * fleck.radius * (1 + fleck.softness) + 0.01;
    });
  });
  std::printf("%d flecks change %.2f %% of the pixels\n", int(flecks.size()),
              100.0 * changed / (kDisturbedSize * kDisturbedSize));
  EXPECT_EQ(elsewhere, 0);
  EXPECT_GT(changed, 10);
  EXPECT_LT(changed, 0.03 * kDisturbedSize * kDisturbedSize);
  EXPECT_EQ(view_->ReadDistances(), distances);
}

TEST_F(DisturbedView, FlecksAreAFunctionOfSeedAndTimeAndNotInAPlainPicture) {
  ShowJoint();
  picture_.flecks = app::kUsualFlecks;
  Disturbances still, later, other;
  later.time = 0.5;
  other.seed = 3;
  const auto first = Draw(still).rgb;
  EXPECT_NE(Draw(later).rgb, first);
  EXPECT_NE(Draw(other).rgb, first);
  EXPECT_EQ(Draw(still).rgb, first);
  // In haze they are drawn with the other bits.
  Disturbances haze;
  haze.haze = 0.2;
  const auto hazy = Draw(haze).rgb;
  picture_.flecks = 0;
  EXPECT_NE(Draw(haze).rgb, hazy);
  const auto none = Draw(still).rgb;
  EXPECT_EQ(Draw(later).rgb, none);
  picture_.plain = true;
  const auto plain = Draw(still).rgb;
  picture_.flecks = 1;
  EXPECT_EQ(Draw(still).rgb, plain);
}

TEST_F(DisturbedView, FlecksAreDrawnAtEachSizeAndDoNotChangeTheExposure) {
  ShowJoint();
  picture_.camera = LensCamera();
  for (const int size : {256, 192, 320, 256}) {
    picture_.flecks = 0;
    const auto without = Draw({}, size).rgb;
    const app::CameraExposure exposure = view_->exposure();
    picture_.flecks = 1;
    EXPECT_NE(Draw({}, size).rgb, without) << size;
    EXPECT_EQ(view_->exposure().gain, exposure.gain);
    EXPECT_EQ(view_->exposure().offset, exposure.offset);
  }
}

TEST(FlecksIn, SalineHasAFewAndGasNone) {
  Backdrop backdrop;
  EXPECT_GT(app::FlecksIn(backdrop), 0);
  backdrop.medium = Medium::kGas;
  EXPECT_EQ(app::FlecksIn(backdrop), 0);
}

}  // namespace
}  // namespace arthro::test
