// The light of the footage and the scope's own, against closed forms.
#include "app/view/backdrop/footage_light.h"

#include <cmath>
#include <cstdio>

#include <glm/geometric.hpp>

#include "simulation/core/units.h"
#include "tests/app/view/view_scene.h"

namespace arthro::test {
namespace {

using namespace app;

Backdrop PlainBackdrop(int width, int height) {
  Backdrop backdrop;
  backdrop.projection.centre_px = {(width - 1) / 2.0, (height - 1) / 2.0};
  backdrop.projection.focal_px = 0.3 * width;
  return backdrop;
}

ColourImage Grey(int width, int height, std::uint8_t level) {
  ColourImage image(width, height);
  std::fill(image.rgb.begin(), image.rgb.end(), level);
  return image;
}

// From the portal all of a bare sphere is at D: what the lamp takes away the gain gives back.
TEST(FootageLight, GainOfAGreySphereIsTheClosedForm) {
  const Backdrop backdrop = PlainBackdrop(400, 400);
  const LightGrid grid = MakeLightGrid(Grey(400, 400, 60), {});
  const double reach = 0.0275;
  const double expected = (0.05 * 0.05 + kLampRadius * kLampRadius) / (reach * reach);
  const auto view = [](double depth) { return simulation::ViewFromPose({0, 0, 0, depth}, 0.0); };
  EXPECT_NEAR(AutomaticGain(grid, MeasureLight(grid), backdrop, view(0.0), 1.5, reach), expected,
              1e-3 * expected);
  // White and near, the picture is as bright as the footage still was: it does not blow out.
  const LightGrid white = MakeLightGrid(Grey(400, 400, 250), {});
  const double near = AutomaticGain(white, MeasureLight(white), backdrop, view(0.044), 0.2, reach);
  EXPECT_NEAR(near, (0.006 * 0.006 + kLampRadius * kLampRadius) / (reach * reach), 0.02 * near);
  // Nearer it takes less gain, and goes there smoothly.
  double before = expected;
  for (double depth = 0.001; depth < 0.038; depth += 0.001) {
    const double gain = AutomaticGain(grid, MeasureLight(grid), backdrop, view(depth), 1.5, reach);
    EXPECT_LT(gain, before);
    EXPECT_GT(gain, 0.8 * before);
    before = gain;
  }
}

TEST(FootageLight, NothingImagedOrBlackNeedsNoGain) {
  const Backdrop backdrop = PlainBackdrop(64, 48);
  const auto view = simulation::ViewFromPose({0, 0, 0, 0.01}, 0.0);
  const LightGrid nothing = MakeLightGrid(Grey(64, 48, 90), DepthMap(64, 48, NAN));
  EXPECT_EQ(AutomaticGain(nothing, MeasureLight(nothing), backdrop, view, 1.5, 0.03), 1.0);
  const LightGrid black = MakeLightGrid(Grey(64, 48, 0), {});
  EXPECT_EQ(AutomaticGain(black, MeasureLight(black), backdrop, view, 1.5, 0.03), 1.0);
  const LightGrid one = MakeLightGrid(Grey(1, 1, 90), {});
  EXPECT_TRUE(
      std::isfinite(AutomaticGain(one, MeasureLight(one), PlainBackdrop(1, 1), view, 1.5, 0.03)));
}

// Checks under a lamp that falls to a quarter from left to right.
TEST(FootageLight, EveningTakesAWideFallAwayAndKeepsThePattern) {
  ColourImage lit(960, 480);
  const auto linear = [](int x, int y) {
    const double fall = std::pow(0.25, x / 959.0);
    return 0.5 * fall * ((x / 24 + y / 24) % 2 ? 1.0 : 0.7);
  };
  for (int y = 0; y < 480; ++y)
    for (int x = 0; x < 960; ++x)
      for (int c = 0; c < 3; ++c)
        lit.at(x, y)[c] =
            static_cast<std::uint8_t>(std::lround(255 * std::pow(linear(x, y), 1 / 2.2)));
  LightGrid grid = MakeLightGrid(lit, {});
  EvenLight(grid, 1.0);
  const ColourImage even = Evened(lit, grid);
  // Of one kind of check, left and right: linear.
  const auto at = [&](const ColourImage& image, int x) {
    return std::pow(image.at(x, 12)[0] / 255.0, 2.2);
  };
  const double before = at(lit, 60) / at(lit, 912), after = at(even, 60) / at(even, 912);
  const double contrast = at(even, 500) / at(even, 520);
  std::printf("left to right %.2f before, %.2f after; light check to dark %.2f\n", before, after,
              contrast);
  EXPECT_GT(before, 2.5);
  EXPECT_NEAR(after, 1.0, 0.35);
  EXPECT_NEAR(std::max(contrast, 1 / contrast), 1 / 0.7, 0.1);
  EvenLight(grid, 0.0);
  EXPECT_EQ(Evened(lit, grid).rgb, lit.rgb);
}

TEST(FootageLight, OfASideIsThatSides) {
  ColourImage halves = Grey(400, 300, 40);
  for (int y = 0; y < 300; ++y)
    for (int x = 200; x < 400; ++x) halves.at(x, y)[0] = 200;
  const Backdrop backdrop = PlainBackdrop(400, 300);
  const LightGrid grid = MakeLightGrid(halves, {});
  const auto right =
      MeasureLight(grid, backdrop.projection, glm::normalize(glm::dvec3(1, 0, 1)), 0.3);
  const auto left =
      MeasureLight(grid, backdrop.projection, glm::normalize(glm::dvec3(-1, 0, 1)), 0.3);
  EXPECT_GT(right.mean.r, 10 * right.mean.g);
  EXPECT_NEAR(left.mean.r, left.mean.g, 1e-6);
  // Behind the scope nothing was imaged: then it is that of all.
  EXPECT_EQ(MeasureLight(grid, backdrop.projection, {0, 0, -1}, 0.3).mean, MeasureLight(grid).mean);
}

class LitView : public ViewTest {};

// A grey sphere from beside its middle, all in the lamp's light: each pixel by hand.
TEST_F(LitView, PixelsOfAGreySphereAreTheClosedForm) {
  Backdrop backdrop = PlainBackdrop(512, 512);
  backdrop.relight = 1;
  const ColourImage grey = Grey(512, 512, 100);
  view_->SetBackdrop(grey, {}, backdrop);
  Picture picture = PictureFromPose({0, 0, 0, 0.02}, RadiansFromDegrees(30), 1.4);
  const int size = 200;
  view_->Render(picture, size);
  const ColourImage drawn = view_->ReadPixels();
  const LightGrid grid = MakeLightGrid(grey, {});
  const double reach = 0.55 * 0.05;
  const double gain = AutomaticGain(grid, MeasureLight(grid), backdrop, picture.view, 1.4, reach);
  const auto window = simulation::WindowOfSize(1.4, size);
  double worst = 0;
  int compared = 0;
  for (int y = 0; y < size; y += 3)
    for (int x = 0; x < size; x += 3) {
      const auto ray = simulation::RayFromPixel(window, picture.view, {x, y});
      // The rim is softened further out.
      if (!ray || std::hypot(x - 99.5, y - 99.5) > 54) continue;
      const glm::dvec3 hit = simulation::SphereHit(picture.view.tip, *ray, 0.05);
      const double distance = glm::length(hit - picture.view.tip);
      const glm::dvec3 lamp = glm::normalize(picture.view.tip + 0.0011 * picture.view.up - hit);
      const glm::dvec3 normal = -glm::normalize(hit);
      const double light = gain * reach * reach / (distance * distance + kLampRadius * kLampRadius);
      const double shine = std::max(glm::dot(normal, glm::normalize(lamp - *ray)), 0.0);
      const double wet = light * (0.02 * std::pow(shine, 16) + 0.30 * std::pow(shine, 192));
      const double faces = std::max(glm::dot(normal, lamp), 0.0);
      double shown = std::sqrt(std::pow(100 / 255.0, 2) * light * (0.2 + 0.8 * faces) + wet);
      if (shown > 0.8) shown = 0.8 + 0.2 * (1 - std::exp(-(shown - 0.8) / 0.2));
      worst = std::max(worst, std::abs(255 * shown - drawn.at(x, y)[1]));
      ++compared;
    }
  std::printf("lit sphere: off by at most %.2f of 255 over %d pixels\n", worst, compared);
  EXPECT_GT(compared, 500);
  EXPECT_LT(worst, 2.0);
}

// The gain goes by the relief that is shown.
TEST_F(LitView, AnotherDepthIsLitAsIfItHadBeenThereFromTheStart) {
  Backdrop backdrop = PlainBackdrop(512, 512);
  backdrop.relight = 1;
  const ColourImage grey = Grey(512, 512, 100);
  const DepthMap flat(512, 512, 0.002f), near(512, 512, 0.02f);
  const Picture picture = PictureFromPose({0, 0, 0, 0.005}, 0.0, 1.4);
  view_->SetBackdrop(grey, near, backdrop);
  view_->Render(picture, 128);
  const ColourImage expected = view_->ReadPixels();
  view_->SetBackdrop(grey, flat, backdrop);
  view_->SetDepth(near);
  view_->Render(picture, 128);
  EXPECT_EQ(view_->ReadPixels().rgb, expected.rgb);
}

// The lamp stands above the lens, so the shadow falls under the rod, and only there.
TEST_F(LitView, TheInstrumentShadesWhatIsCloseBehindIt) {
  Backdrop backdrop = PlainBackdrop(512, 512);
  view_->SetBackdrop(Grey(512, 512, 150), {}, backdrop);
  Picture picture = PictureFromPose({0, 0, 0, 0.02}, 0.0, 1.4);
  view_->Render(picture, 256);
  const ColourImage without = view_->ReadPixels();
  // Level across the picture, 3 mm before the sphere at its end.
  picture.instrument =
      InstrumentView{{0.03, 0.0, 0.0}, {0.0, 0.0, 0.0465}, 0, simulation::ToolKind::kPunch};
  view_->Render(picture, 256);
  const ColourImage with = view_->ReadPixels();
  const auto change = [&](int x, int y) {
    return int{with.at(x, y)[0]} - int{without.at(x, y)[0]};
  };
  // Under the shaft's end (screen y grows downwards), and far from it.
  int darkest = 0;
  for (int y = 128; y < 170; ++y) darkest = std::min(darkest, change(136, y));
  EXPECT_LT(darkest, -25);
  for (int y = 60; y < 200; y += 10) EXPECT_NEAR(change(60, y), 0, 3) << y;
  picture.plain = true;
  view_->Render(picture, 256);
  const ColourImage plain = view_->ReadPixels();
  picture.instrument.reset();
  view_->Render(picture, 256);
  EXPECT_EQ(view_->ReadPixels().rgb, plain.rgb);
}

}  // namespace
}  // namespace arthro::test
