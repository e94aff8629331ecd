// Light of the footage and of the scope's lamp, against closed forms.
#include "app/view/exposure/footage_light.h"

#include <cmath>
#include <cstdio>
#include <numbers>
#include <utility>

#include <glm/geometric.hpp>

#include "app/view/drawing/srgb.h"
#include "app/view/exposure/automatic_gain.h"
#include "app/view/instruments/probe_mesh.h"
#include "simulation/core/units.h"
#include "tests/app/view/lit_scene.h"
#include "tests/app/view/view_scene.h"
#include "tests/support/view/reference_tracer.h"

namespace arthro::test {
namespace {

using namespace app;

// Chequers under a lamp that falls to a quarter from left to right.
TEST(FootageLight, EveningRemovesAWideGradientAndKeepsThePattern) {
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
  // One kind of chequer, left and right: linear values.
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

TEST(FootageLight, OfADirectionIsMeasuredThere) {
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
  // Nothing was imaged behind the scope: the light is then that of all.
  EXPECT_EQ(MeasureLight(grid, backdrop.projection, {0, 0, -1}, 0.3).mean, MeasureLight(grid).mean);
}

class LitView : public ViewTest, public testing::WithParamInterface<bool> {};
INSTANTIATE_TEST_SUITE_P(Lenses, LitView, testing::Bool(), [](const auto& has) {
  return std::string(has.param ? "kannala_brandt" : "equisolid");
});

// A grey sphere from beside its centre, all in the lamp's light: each pixel by its closed form.
TEST_P(LitView, PixelsOfAGreySphereEqualTheClosedForm) {
  Backdrop backdrop = PlainBackdrop(512, 512);
  backdrop.relight = 1;
  backdrop.medium = Medium::kGas;
  const ColourImage grey = Grey(512, 512, 100);
  view_->SetBackdrop(grey, {}, backdrop);
  const Lens lens = AsideLens();
  const simulation::ScopeOptics optics =
      GetParam() ? simulation::OpticsOf({}, lens) : simulation::ScopeOptics{1.4, {}};
  Picture picture = PictureFromPose({0, 0, 0, 0.02}, RadiansFromDegrees(30), optics.field_of_view);
  picture.lens = optics.lens;
  const int size = 200;
  view_->Render(picture, size);
  const ColourImage drawn = view_->ReadPixels();
  const LightGrid grid = MakeLightGrid(grey, {});
  const double reach = 0.55 * 0.05;
  const double gain =
      AutomaticGain(grid, MeasureLight(grid), backdrop, picture.view, optics, reach);
  double worst = 0;
  int compared = 0;
  for (int y = 0; y < size; y += 3)
    for (int x = 0; x < size; x += 3) {
      const auto ray = ReferenceRay(picture.view, optics.field_of_view, size, {x, y},
                                    GetParam() ? &lens : nullptr);
      // The rim is vignetted farther out.
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

class LitModels : public ViewTest {};

// The gain is computed from the relief that is drawn.
TEST_F(LitModels, AReplacedDepthMapIsLitLikeAnInitialOne) {
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

// Turning the camera head turns the whole picture: lamp, shadow and mark stay with the scope. For
// half and quarter turns pixels fall on pixels; a footprint's axes are rounded.
TEST_F(LitModels, TurningTheCameraHeadRotatesThePictureAsAWhole) {
  LoadedScene loaded = MakeViewScene(512, 512);
  loaded.scene.backdrop.relight = 1;
  view_->SetBackdrop(*loaded.panorama, *loaded.depth, loaded.scene.backdrop);
  view_->SetTissues(loaded.scene.tissues, loaded.surfaces);
  const simulation::RodPose pose{-0.1, 0.05, 0.4, 0.01};
  constexpr int kSize = 200;
  const auto drawn = [&](double turn) {
    Picture picture = PictureFromPose(pose, RadiansFromDegrees(30), 1.5, pose.roll + turn);
    picture.instrument = ProbeInFront();
    view_->Render(picture, kSize);
    return view_->ReadPixels();
  };
  const ColourImage with_scope = drawn(0.0);
  for (const int quarters : {1, 2}) {
    const ColourImage turned = drawn(quarters * 0.5 * std::numbers::pi);
    int worst = 0;
    for (int y = 0; y < kSize; ++y)
      for (int x = 0; x < kSize; ++x) {
        // A head turned to the right shows the joint turned to the left.
        const auto [u, v] =
            quarters == 1 ? std::pair(kSize - 1 - y, x) : std::pair(kSize - 1 - x, kSize - 1 - y);
        for (int c = 0; c < 3; ++c)
          worst = std::max(worst, std::abs(int{turned.at(x, y)[c]} - int{with_scope.at(u, v)[c]}));
      }
    std::printf("head turned by %d degrees: off by at most %d of 255\n", 90 * quarters, worst);
    EXPECT_LE(worst, 2);
  }
}

// The lamp stands above the lens, so the shadow falls under the rod only.
TEST_F(LitModels, TheInstrumentShadesSurfacesCloseBehindIt) {
  Backdrop backdrop = PlainBackdrop(512, 512);
  view_->SetBackdrop(Grey(512, 512, 150), {}, backdrop);
  Picture picture = PictureFromPose({0, 0, 0, 0.02}, 0.0, 1.4);
  view_->Render(picture, 256);
  const ColourImage without = view_->ReadPixels();
  // Level across the picture, 3 mm in front of the sphere at its end.
  picture.instrument =
      InstrumentView{{0.03, 0.0, 0.0}, {0.0, 0.0, 0.0465}, 0, simulation::ToolKind::kPunch};
  view_->Render(picture, 256);
  const ColourImage with = view_->ReadPixels();
  const auto change = [&](int x, int y) {
    return int{with.at(x, y)[0]} - int{without.at(x, y)[0]};
  };
  // Below the end of the shaft (screen y grows downwards), and far from it.
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

// A hook across the picture, 8 mm from the lens and far in front of the sphere, casts its shadow
// where rays from the lamp past its lower edge end; turned the other way it casts none there.
TEST_F(LitView, TheHookOfTheProbeCastsAShadow) {
  Backdrop backdrop = PlainBackdrop(512, 512);
  view_->SetBackdrop(Grey(512, 512, 150), {}, backdrop);
  Picture picture = PictureFromPose({0, 0, 0, 0.02}, 0.0, 1.4);
  const int size = 256;
  view_->Render(picture, size);
  const ColourImage without = view_->ReadPixels();
  const std::vector<float> bare = view_->ReadDistances();
  const glm::dvec3 portal{0.0, 0.03, 0.0}, proxy{0.0, 0.0, 0.028};
  const simulation::ToolShape shape = simulation::ShapeOf(simulation::ToolKind::kProbe);
  double darkening[2];
  glm::dvec2 pixel{0.0};
  for (const int side : {0, 1}) {
    const double roll = side == 0 ? std::numbers::pi / 2 : -std::numbers::pi / 2;
    picture.instrument = InstrumentView{portal, proxy, roll, simulation::ToolKind::kProbe};
    view_->Render(picture, size);
    const ColourImage with = view_->ReadPixels();
    if (side == 0) {
      const Pose pose = app::ProbePose(portal, proxy, roll);
      const glm::dvec3 middle = pose * (0.3 * shape.capsules[0].a + 0.7 * shape.capsules[0].b);
      const glm::dvec3 lamp = picture.view.tip + 0.0011 * picture.view.up;
      const glm::dvec3 over = middle - 0.5 * shape.capsules[0].radius * picture.view.up;
      const glm::dvec3 place = simulation::SphereHit(lamp, glm::normalize(over - lamp), 0.05);
      pixel = simulation::PixelFromRay(simulation::WindowOfSize(1.4, size), picture.view,
                                       glm::normalize(place - picture.view.tip));
    }
    const int x = static_cast<int>(std::lround(pixel.x)),
              y = static_cast<int>(std::lround(pixel.y));
    const std::size_t index = static_cast<std::size_t>(y) * size + static_cast<std::size_t>(x);
    ASSERT_EQ(view_->ReadDistances()[index], bare[index]) << "the instrument itself is there";
    darkening[side] = double(without.at(x, y)[1]) - double(with.at(x, y)[1]);
  }
  std::printf("hook: %.0f of 255 darker, %.0f turned away\n", darkening[0], darkening[1]);
  EXPECT_GT(darkening[0], 25);
  EXPECT_LT(darkening[1], 0.5 * darkening[0]);
}

}  // namespace
}  // namespace arthro::test
