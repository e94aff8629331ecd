// The backdrop against the closed form [method.md, Oblique view].
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <utility>

#define GL_GLEXT_PROTOTYPES
#include <GL/gl.h>
#include <glm/geometric.hpp>

#include "simulation/core/units.h"
#include "tests/app/view/view_scene.h"
#include "tests/support/view/grid_picture.h"
#include "tests/support/view/reference_tracer.h"

namespace arthro::test {
namespace {

using app::Picture;
using app::PictureFromPose;
using simulation::RodPose;

class BackdropView : public ViewTest {};

struct GridCase {
  double angle_deg, latitude_deg, longitude_deg, roll_deg, insertion;
};

// Every view angle, from shallow to deep, in all directions of roll; the panorama is wide enough
// for each view to show a good part of it.
std::vector<GridCase> GridCases() {
  std::vector<GridCase> cases;
  for (const double angle : {0.0, 30.0, 70.0, 90.0})
    for (const double insertion : {0.005, 0.015, 0.03, 0.045})
      for (const double roll : {0.0, 75.0, 200.0, 305.0})
        cases.push_back({angle, 6.0, -9.0, roll, insertion});
  return cases;
}

void ExpectGridWhereTheFormulaPutsIt(app::ArthroscopicView& view, const GridPanorama& grid,
                                     const Backdrop& backdrop, const char* name) {
  view.SetBackdrop(grid.Draw(), {}, backdrop);
  double worst = 0, sum2 = 0;
  int crossings = 0, cells = 0, wrong = 0, seen = 0;
  for (const GridCase& c : GridCases()) {
    const RodPose pose{RadiansFromDegrees(c.latitude_deg), RadiansFromDegrees(c.longitude_deg),
                       RadiansFromDegrees(c.roll_deg), c.insertion};
    Picture picture = PictureFromPose(pose, RadiansFromDegrees(c.angle_deg), std::numbers::pi / 2);
    picture.plain = true;
    view.Render(picture, 512);
    const GridAgreement agreement =
        CompareWithGrid(view.ReadPixels(), grid, backdrop, picture.view, picture.field_of_view);
    EXPECT_LT(agreement.max_px, 0.5)
        << c.angle_deg << " deg, roll " << c.roll_deg << ", insertion " << c.insertion << " at "
        << agreement.worst.x << ", " << agreement.worst.y;
    EXPECT_EQ(agreement.wrong_cells, 0);
    worst = std::max(worst, agreement.max_px);
    sum2 += agreement.rms_px * agreement.rms_px * agreement.crossings;
    crossings += agreement.crossings;
    cells += agreement.cells;
    wrong += agreement.wrong_cells;
    seen += agreement.crossings > 100 ? 1 : 0;
  }
  std::printf(
      "%s: %d line crossings in %zu views at 512 px: rms %.4f px, max %.4f px; %d of %d "
      "pixels in a wrong cell\n",
      name, crossings, GridCases().size(), std::sqrt(sum2 / crossings), worst, wrong, cells);
  // Too few views with lines in them would prove nothing.
  EXPECT_GT(seen, 40);
}

TEST_F(BackdropView, GridOfAGnomonicPanoramaAgreesWithTheReferenceTracer) {
  GridPanorama grid;
  grid.height = 2048;
  Backdrop backdrop;
  backdrop.projection.centre_px = {1020.25, 1030.75};
  backdrop.projection.focal_px = 420;
  ExpectGridWhereTheFormulaPutsIt(*view_, grid, backdrop, "gnomonic");
}

TEST_F(BackdropView, GridOfAnEquirectangularPanoramaAgreesWithTheReferenceTracer) {
  GridPanorama grid;
  grid.width = 2400;
  grid.height = 1600;
  Backdrop backdrop;
  backdrop.projection.type = ProjectionType::kEquirectangular;
  backdrop.projection.centre_px = {1180.5, 820.25};
  backdrop.projection.px_per_deg = 10;
  ExpectGridWhereTheFormulaPutsIt(*view_, grid, backdrop, "equirectangular");
}

TEST_F(BackdropView, EveryPixelHasTheColourOfItsOwnPanoramaPixel) {
  const LoadedScene loaded = MakeViewScene();
  view_->SetBackdrop(*loaded.panorama, *loaded.depth, loaded.scene.backdrop);
  Picture picture = PictureFromPose({-0.05, 0.04, 1.1, 0.012}, RadiansFromDegrees(30), 1.5);
  picture.plain = true;
  const int size = 401;  // odd, so that a pixel lies at the centre
  view_->Render(picture, size);
  const ColourImage drawn = view_->ReadPixels();
  const TracedPicture traced = TraceWindow(loaded.scene.backdrop, *loaded.panorama, picture.view,
                                           picture.field_of_view, size);
  int worst = 0, worst_at_centre = 0;
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      if (std::hypot(x - 200.0, y - 200.0) > 198.0) continue;  // the rim is blended
      for (int c = 0; c < 3; ++c) {
        const int off = std::abs(int{drawn.at(x, y)[c]} - int{traced.colours.at(x, y)[c]});
        worst = std::max(worst, off);
        if (x == 200 && y == 200) worst_at_centre = std::max(worst_at_centre, off);
      }
    }
  std::printf("colours: off by at most %d of 255, %d at the centre\n", worst, worst_at_centre);
  // A picture smaller than the panorama averages its pixels: one or two levels of difference.
  EXPECT_LE(worst, 3);
  EXPECT_LE(worst_at_centre, 1);
}

TEST_F(BackdropView, OutsideTheWindowIsBlackAndTheRimIsOnePixelWide) {
  LoadedScene loaded = MakeViewScene(256, 256);
  ColourImage grey(256, 256);
  std::fill(grey.rgb.begin(), grey.rgb.end(), std::uint8_t{200});
  loaded.panorama = Share(std::move(grey));
  loaded.scene.backdrop.projection.focal_px = 100;
  view_->SetBackdrop(*loaded.panorama, {}, loaded.scene.backdrop);
  view_->SetTissues(loaded.scene.tissues, loaded.surfaces);
  for (const bool plain : {true, false}) {
    Picture picture = PictureFromPose({0, 0, 0, 0.01}, 0.0, 1.2);
    picture.plain = plain;
    view_->Render(picture, 300);
    const ColourImage drawn = view_->ReadPixels();
    int between = 0;
    for (int y = 0; y < 300; ++y)
      for (int x = 0; x < 300; ++x) {
        const double beyond = std::hypot(x - 149.5, y - 149.5) - 150.0;
        const int red = drawn.at(x, y)[0];
        if (beyond > 0.51) {
          EXPECT_EQ(red, 0) << x << ", " << y << (plain ? " plain" : "");
        }
        if (plain && beyond < -0.51) {
          EXPECT_EQ(red, 200) << x << ", " << y;
        }
        between += red > 0 && red < 200 ? 1 : 0;
      }
    EXPECT_GT(between, 300);  // the rim is blended, not stepped
  }
}

// Fragments that OpenGL shades for a picture, over the pixels of its disc. A rasteriser shades
// whole blocks of pixels, so that those at edges between triangles count twice: 1.26 for a fan of
// 64 triangles from the middle.
TEST_F(BackdropView, FewPixelsAreShadedTwice) {
  constexpr int kSide = 512;
  constexpr GLenum kShaded = 0x82F4;  // GL_FRAGMENT_SHADER_INVOCATIONS_ARB
  const LoadedScene loaded = MakeViewScene(256, 256);
  view_->SetBackdrop(*loaded.panorama, {}, loaded.scene.backdrop);
  Picture picture = PictureFromPose({0, 0, 0, 0.01}, 0.0, 1.4);
  picture.plain = true;
  view_->Render(picture, kSide);
  while (glGetError() != GL_NO_ERROR) {
  }
  GLuint query = 0, shaded = 0;
  glGenQueries(1, &query);
  glBeginQuery(kShaded, query);
  if (glGetError() != GL_NO_ERROR)
    GTEST_SKIP() << "NOT TESTED: this driver does not count fragments";
  view_->Render(picture, kSide);
  glEndQuery(kShaded);
  glGetQueryObjectuiv(query, GL_QUERY_RESULT, &shaded);
  glDeleteQueries(1, &query);
  const double share = shaded / (0.25 * std::numbers::pi * kSide * kSide);
  std::printf("shaded fragments per pixel of the disc: %.3f\n", share);
  EXPECT_GE(share, 1.0);
  EXPECT_LT(share, 1.25);
}

TEST_F(BackdropView, DepthIsTheReliefsDistanceAlongTheView) {
  LoadedScene loaded = MakeViewScene();
  for (const double h : {0.0, 0.006, 0.02}) {
    loaded.depth = Share(DepthMap(1024, 768, static_cast<float>(h)));
    view_->SetBackdrop(*loaded.panorama, *loaded.depth, loaded.scene.backdrop);
    const Picture picture = PictureFromPose({0.1, -0.1, 0.7, 0.014}, RadiansFromDegrees(30), 1.4);
    const int size = 257;
    view_->Render(picture, size);
    const std::vector<float> distances = view_->ReadDistances();
    double worst = 0;
    int compared = 0;
    for (int y = 0; y < size; ++y)
      for (int x = 0; x < size; ++x) {
        const auto ray = ReferenceRay(picture.view, picture.field_of_view, size, {x, y});
        if (!ray || std::hypot(x - 128.0, y - 128.0) > 115) continue;  // rim and mark
        const auto hit = ReferenceSphereHit(picture.view.tip, *ray, 0.05);
        ASSERT_TRUE(hit);
        const auto pixel = ReferencePixel(loaded.scene.backdrop.projection, *hit);
        if (!pixel || pixel->x < 1 || pixel->y < 1 || pixel->x > 1022 || pixel->y > 766) continue;
        const double expected = glm::dot(*hit * ((0.05 - h) / 0.05) - picture.view.tip, *ray);
        if (expected < 0.001) continue;
        worst =
            std::max(worst, std::abs(distances[static_cast<std::size_t>(y) * size + x] - expected));
        ++compared;
      }
    std::printf("depth, relief %.0f mm: off by at most %.2g mm over %d pixels\n", h * 1e3,
                worst * 1e3, compared);
    EXPECT_GT(compared, 20000);
    // 32-bit depth stored as 1/distance: 3 µm at 0.1 m, less when nearer.
    EXPECT_LT(worst, 5e-6);
  }
}

// A calibrated lens with its axis beside the middle of its round window.
TEST_F(BackdropView, GridThroughACalibratedLensAgreesWithTheLensModel) {
  GridPanorama grid;
  grid.height = 2048;
  Backdrop backdrop;
  backdrop.projection.centre_px = {1020.25, 1030.75};
  backdrop.projection.focal_px = 420;
  view_->SetBackdrop(grid.Draw(), {}, backdrop);
  Lens lens;
  lens.model = LensModel::kKannalaBrandt;
  lens.width = 720, lens.height = 576;
  lens.focal_px = 290;
  lens.cx = 371, lens.cy = 279;
  lens.k = {-0.09, 0.015, 0, 0};
  lens.circle = {360, 288, 255};
  const simulation::ScopeOptics optics = simulation::OpticsOf({}, lens);
  for (const double angle : {0.0, 30.0, 70.0}) {
    Picture picture =
        PictureFromPose({0.1, -0.15, 1.3, 0.015}, RadiansFromDegrees(angle), optics.field_of_view);
    picture.lens = optics.lens;
    picture.plain = true;
    view_->Render(picture, 512);
    const GridAgreement with = CompareWithGrid(view_->ReadPixels(), grid, backdrop, picture.view,
                                               picture.field_of_view, 4.0, &lens);
    std::printf("lens, %.0f deg: %d crossings, rms %.4f px, max %.4f px\n", angle, with.crossings,
                with.rms_px, with.max_px);
    EXPECT_GT(with.crossings, 1000);
    EXPECT_LT(with.max_px, 0.5);
    EXPECT_EQ(with.wrong_cells, 0);
    picture.lens = {};
    view_->Render(picture, 512);
    EXPECT_GT(CompareWithGrid(view_->ReadPixels(), grid, backdrop, picture.view,
                              picture.field_of_view, 4.0, &lens)
                  .max_px,
              5.0)
        << "an equisolid lens must not pass for it";
  }
}

TEST_F(BackdropView, UnknownReliefIsDrawnAsTheBareSphereInTheBorderColour) {
  LoadedScene loaded = MakeViewScene();
  view_->SetBackdrop(*loaded.panorama, DepthMap(1024, 768, NAN), loaded.scene.backdrop);
  const Picture picture = PictureFromPose({0, 0, 0, 0.01}, 0.0, 1.2);
  view_->Render(picture, 201);
  EXPECT_NEAR(view_->ReadDistances()[100 * 201 + 100], 0.04, 5e-6);
  const ColourImage drawn = view_->ReadPixels();
  const std::uint8_t* centre = drawn.at(100, 100);
  for (int c = 0; c < 3; ++c) {
    EXPECT_GT(centre[c], 10) << "told apart from the black surround";
    EXPECT_LT(centre[c], 50) << "and from tissue";
  }
}

// Last colours go on beyond the imaged part and fade into the colour of the border: no black bay,
// no edge. Both for the edge of the panorama and for a black part of unknown depth within it.
TEST_F(BackdropView, BeyondTheImagedPartItsColoursFadeIntoTheBorderColour) {
  constexpr int kSize = 401, kMiddle = kSize / 2;
  for (const bool is_within : {false, true}) {
    LoadedScene loaded = MakeViewScene();
    ColourImage panorama(1024, 768);
    DepthMap depth(1024, 768, 0.004f);
    for (int y = 0; y < panorama.height; ++y)
      for (int x = 0; x < panorama.width; ++x) {
        const bool is_imaged = !is_within || x < 512;
        if (!is_imaged) depth.at(x, y) = NAN;
        const std::uint8_t red[] = {200, 90, 70};
        for (int c = 0; c < 3; ++c) panorama.at(x, y)[c] = is_imaged ? red[c] : 0;
      }
    // The edge of the panorama in the middle of the picture, if not that of the imaged part.
    if (!is_within) loaded.scene.backdrop.projection.centre_px.x = panorama.width - 1;
    view_->SetBackdrop(panorama, depth, loaded.scene.backdrop);
    view_->Render(PictureFromPose({0, 0, 0, 0.001}, 0.0, 2.0), kSize);
    const ColourImage drawn = view_->ReadPixels();
    int steepest = 0, rises = 0;
    for (int x = kMiddle - 60; x < kSize - 30; ++x) {
      const int change = drawn.at(x + 1, kMiddle)[0] - drawn.at(x, kMiddle)[0];
      steepest = std::max(steepest, std::abs(change));
      if (change > 2) ++rises;
    }
    const auto red = [&](int x) { return int{drawn.at(x, kMiddle)[0]}; };
    std::printf("%s: %d inside, %d at the edge, %d beyond, %d far beyond, steepest %d\n",
                is_within ? "black part" : "edge of the panorama", red(kMiddle - 60), red(kMiddle),
                red(kMiddle + 15), red(kSize - 30), steepest);
    EXPECT_GT(red(kMiddle - 60), 120);
    EXPECT_GT(red(kMiddle + 5), 60);
    EXPECT_LT(red(kSize - 30), 50);
    EXPECT_LE(steepest, 20);
    EXPECT_EQ(rises, 0) << "it only grows darker";
  }
}

TEST_F(BackdropView, AReplacedDepthMapIsDrawnLikeAnInitialOne) {
  LoadedScene loaded = MakeViewScene(511, 383);  // row length that is no multiple of 4 bytes
  const Picture picture = PictureFromPose({0, 0, 0, 0.01}, 0.0, 1.2);
  view_->SetBackdrop(*loaded.panorama, *loaded.depth, loaded.scene.backdrop);
  view_->Render(picture, 200);
  const ColourImage first = view_->ReadPixels();
  DepthMap deeper = *loaded.depth;
  for (int y = 0; y < 190; ++y)
    for (int x = 0; x < deeper.width; ++x) deeper.at(x, y) = NAN;
  view_->SetDepth(deeper);
  view_->Render(picture, 200);
  const ColourImage second = view_->ReadPixels();
  EXPECT_NE(first.rgb, second.rgb);
  view_->SetDepth(*loaded.depth);
  view_->Render(picture, 200);
  EXPECT_EQ(view_->ReadPixels().rgb, first.rgb);
}

TEST_F(BackdropView, DeepestAndShallowestTipsDrawFinitePictures) {
  const LoadedScene loaded = MakeViewScene();
  view_->SetBackdrop(*loaded.panorama, *loaded.depth, loaded.scene.backdrop);
  for (const double insertion : {-0.02, 0.0, 0.049999, 0.05})
    for (const double angle : {0.0, 90.0}) {
      const Picture picture = PictureFromPose({0, 0, 0, insertion}, RadiansFromDegrees(angle), 1.5);
      view_->Render(picture, 128);
      for (const float distance : view_->ReadDistances()) {
        ASSERT_TRUE(std::isfinite(distance));
        ASSERT_GE(distance, 0.0f);
        ASSERT_LE(distance, 1.0f);
      }
    }
}

TEST_F(BackdropView, APanoramaLargerThanATextureIsReducedWithANotice) {
  // Software renderers take 16384 px a side, most cards 32768.
  ColourImage wide(40000, 8);
  for (int x = 0; x < wide.width; ++x)
    for (int y = 0; y < wide.height; ++y)
      wide.at(x, y)[0] = static_cast<std::uint8_t>(x * 255LL / wide.width);
  Backdrop backdrop;
  backdrop.projection.type = ProjectionType::kEquirectangular;
  backdrop.projection.centre_px = {19999.5, 3.5};
  backdrop.projection.px_per_deg = 200;
  view_->SetBackdrop(wide, {}, backdrop);
  EXPECT_NE(view_->notice().find("smaller"), std::string::npos) << view_->notice();
  Picture picture = PictureFromPose({0, RadiansFromDegrees(40), 0, 0}, 0.0, 1.0);
  picture.plain = true;
  view_->Render(picture, 2001);  // fine enough to have pixels within the thin strip
  const auto expected = (19999.5 + 200 * 40) / 40000 * 255;
  EXPECT_NEAR(view_->ReadPixels().at(1000, 1000)[0], expected, 2);
}

}  // namespace
}  // namespace arthro::test
