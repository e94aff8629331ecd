// The relief drawn from the side: sides of steps, and level parts.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <numbers>
#include <random>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "tests/app/view/lit_scene.h"
#include "tests/app/view/view_scene.h"
#include "tests/support/build_paths.h"
#include "tests/support/view/reference_tracer.h"

namespace arthro::test {
namespace {

using namespace app;

constexpr int kTexels = 512;

class DrawnRelief : public ViewTest {
 protected:
  // From 18 mm inside, downwards.
  DrawnRelief() {
    const glm::dvec3 ahead = glm::normalize(glm::dvec3(0, 0.8, 0.6)), right(1, 0, 0);
    picture_.field_of_view = 1.4;
    picture_.view = {{0, 0, 0.018}, ahead, glm::cross(right, ahead), right};
  }
  Backdrop backdrop_ = PlainBackdrop(kTexels, kTexels);
  Picture picture_;
};

// Returns the rms distance of values from the parabola that fits them best.
double OffParabola(const std::vector<glm::dvec2>& points) {
  glm::dmat3 normal(0.0);
  glm::dvec3 right(0.0);
  for (const glm::dvec2& p : points) {
    const glm::dvec3 basis(1, p.x, p.x * p.x);
    normal += glm::outerProduct(basis, basis);
    right += p.y * basis;
  }
  const glm::dvec3 fit = glm::inverse(normal) * right;
  double squares = 0;
  for (const glm::dvec2& p : points)
    squares += std::pow(glm::dot(fit, glm::dvec3(1, p.x, p.x * p.x)) - p.y, 2);
  return std::sqrt(squares / static_cast<double>(points.size()));
}

// A step of 8 mm along a line that falls by a texel in `run`, some 6 px of the picture each. On a
// grey panorama its side is drawn darker; both of its edges are smooth lines in the picture.
TEST_F(DrawnRelief, TheSideOfAStepHasSmoothEdges) {
  constexpr int kSize = 480;
  const ColourImage grey = Grey(kTexels, kTexels, 150);
  for (const double run : {2.0, 5.0, 9.0}) {
    DepthMap depth(kTexels, kTexels);
    for (int y = 0; y < kTexels; ++y)
      for (int x = 0; x < kTexels; ++x)
        depth.at(x, y) = y - kTexels / 2 > 40.2 + (x - kTexels / 2) / run ? 0.028f : 0.020f;
    view_->SetBackdrop(grey, depth, backdrop_);
    for (const ReliefSearch search : {ReliefSearch{256, 1}, kUsualRelief}) {
      picture_.relief = search;
      view_->Render(picture_, kSize);
      const ColourImage drawn = view_->ReadPixels();
      std::vector<glm::dvec2> edges[2];
      for (int x = 140; x < 340; ++x) {
        // From above and from below towards the darkest place of the side, to half of the
        // difference.
        int darkest = 100;
        for (int y = 100; y < 330; ++y)
          if (drawn.at(x, y)[1] < drawn.at(x, darkest)[1]) darkest = y;
        const double side = drawn.at(x, darkest)[1];
        for (const int start : {darkest - 60, 330}) {
          const int way = start < darkest ? 1 : -1;
          const double level = 0.5 * (side + drawn.at(x, start)[1]);
          int y = start;
          while (y != darkest && drawn.at(x, y + way)[1] > level) y += way;
          const double here = drawn.at(x, y)[1], next = drawn.at(x, y + way)[1];
          edges[way > 0 ? 0 : 1].push_back(
              {(x - 240) / 100.0, y + way * (here - level) / std::max(here - next, 1e-9)});
        }
      }
      const double far = OffParabola(edges[0]), near = OffParabola(edges[1]);
      std::printf("1:%g, cells of %d: off a smooth line by %.2f px at the foot, %.2f at the rim\n",
                  run, search.cell, far, near);
      EXPECT_LT(far, 1.5);
      EXPECT_LT(near, 1.5);
    }
  }
}

// A step of 8 mm in a relief of footage, with stripes of 4 texels across it. On its side a texel is
// drawn many times as high as wide, so that the stripes would be a comb.
TEST_F(DrawnRelief, TheSideOfAStepOfFootageIsNoComb) {
  constexpr int kSize = 480;
  DepthMap depth(kTexels, kTexels);
  ColourImage stripes(kTexels, kTexels);
  for (int y = 0; y < kTexels; ++y)
    for (int x = 0; x < kTexels; ++x) {
      depth.at(x, y) = y - kTexels / 2 > 40 ? 0.028f : 0.020f;
      for (int c = 0; c < 3; ++c)
        stripes.rgb[3 * static_cast<std::size_t>(y * kTexels + x) + static_cast<std::size_t>(c)] =
            x / 4 % 2 == 0 ? 110 : 190;
    }
  view_->SetBackdrop(stripes, depth, backdrop_, DepthMap(kTexels, kTexels, 1.5e-4f));
  picture_.relief = kUsualRelief;
  view_->Render(picture_, kSize);
  const ColourImage drawn = view_->ReadPixels();
  const auto contrast = [&](int y) {
    constexpr int kLeft = 180, kRight = 300;
    double sum = 0, squares = 0;
    for (int x = kLeft; x < kRight; ++x) sum += drawn.at(x, y)[1];
    const double mean = sum / (kRight - kLeft);
    for (int x = kLeft; x < kRight; ++x) squares += std::pow(drawn.at(x, y)[1] - mean, 2);
    return std::sqrt(squares / (kRight - kLeft));
  };
  // The foot of the side lies at row 131, its upper edge at 290.
  EXPECT_GT(contrast(100), 30);
  EXPECT_GT(contrast(300), 30);
  for (int y = 136; y <= 284; ++y) EXPECT_LT(contrast(y), 2) << "row " << y;
}

// The anterior horn of the demo's meniscus: a crest some 0.5 mm thick along the rays, 15 mm before
// what is behind it. Rays that pass through it make stairs of whole cells.
TEST_F(DrawnRelief, TheThinCrestOfTheDemoIsClosed) {
  constexpr int kSize = 1400;
  const LoadedScene demo =
      LoadScene(std::filesystem::path(ARTHRO_SOURCE_DIR) / "resources" / "demo");
  view_->SetBackdrop(*demo.panorama, *demo.depth, demo.scene.backdrop);
  picture_ = PictureFromPose({-std::numbers::pi / 4, std::numbers::pi / 9, 0, 0.01},
                             std::numbers::pi / 6, std::numbers::pi / 2);
  picture_.plain = true;
  const auto distances = [&](const ReliefSearch& search) {
    picture_.relief = search;
    view_->Render(picture_, kSize);
    return view_->ReadDistances();
  };
  const std::vector<float> exact = distances({2048, 1}), found = distances(kUsualRelief);
  int through = 0, seen = 0;
  for (std::size_t i = 0; i < exact.size(); ++i) {
    through += found[i] > exact[i] + 1e-3f ? 1 : 0;
    seen += exact[i] > 0 ? 1 : 0;
  }
  const double share = double(through) / seen;
  std::printf("%.3f %% of the rays pass through a crest\n", 100 * share);
  EXPECT_LT(share, 0.0006);
}

// The condyle of the demo from beneath, rounded and steep up to its outline, whose texels are some
// 15 px wide: its light has no line across. Columns of 9 px, each line beside the next but one.
TEST_F(DrawnRelief, ARoundedPartHasNoLineOfItsTexels) {
  app::StillPictures pictures(
      LoadScene(std::filesystem::path(ARTHRO_SOURCE_DIR) / "resources" / "demo"));
  const double degree = std::numbers::pi / 180;
  picture_ = PictureFromPose(pictures.Hold({-25 * degree, 12 * degree, 0, 0.024}), 30 * degree,
                             90 * degree);
  picture_.relief = kUsualRelief;
  const ColourImage drawn = pictures.Draw(picture_, 1024);
  double worst = 0;
  for (int left = 300; left < 700; left += 9) {
    const auto level = [&](int y) {
      double sum = 0;
      for (int x = left; x < left + 9; ++x) sum += drawn.at(x, y)[1];
      return sum / 9;
    };
    for (int y = 60; y < 140; ++y) worst = std::max(worst, std::abs(level(y + 2) - level(y)));
  }
  std::printf("steepest change of the light: %.2f levels in 2 px\n", worst);
  EXPECT_LT(worst, 1.5) << "a level is a rounding";
}

// Noise of 0.45 mm over 3 texels, as a depth map from the brightness of footage has it, on a level
// relief: with its error known, a lamp of 60 % draws no worms and the picture has no sides of
// steps. Without it, a twentieth of what the lamp lights is off its surroundings.
TEST_F(DrawnRelief, NoiseOfAKnownErrorIsNeitherSidesNorWorms) {
  constexpr int kSize = 320, kReach = 7;
  constexpr float kError = 4.5e-4f;
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  constexpr int kKnots = kTexels / 3 + 2;
  std::vector<double> knots(static_cast<std::size_t>(kKnots) * kKnots);
  for (double& knot : knots) knot = 1.5 * kError * normal(random);  // 2/3 is left between knots
  DepthMap depth(kTexels, kTexels);
  for (int y = 0; y < kTexels; ++y)
    for (int x = 0; x < kTexels; ++x) {
      const auto at = [&](int u, int v) { return knots[static_cast<std::size_t>(v * kKnots + u)]; };
      const double f = x % 3 / 3.0, g = y % 3 / 3.0;
      depth.at(x, y) = static_cast<float>(
          0.02 + (1 - g) * ((1 - f) * at(x / 3, y / 3) + f * at(x / 3 + 1, y / 3)) +
          g * ((1 - f) * at(x / 3, y / 3 + 1) + f * at(x / 3 + 1, y / 3 + 1)));
    }
  picture_.relief = kUsualRelief;
  const auto share_off = [&](const DepthMap& sigma, double relight) {
    backdrop_.relight = relight;
    view_->SetBackdrop(Grey(kTexels, kTexels, 90), depth, backdrop_, sigma);
    view_->Render(picture_, kSize);
    const ColourImage drawn = view_->ReadPixels();
    int off = 0, all = 0;
    for (int y = 90; y < 230; ++y)
      for (int x = 90; x < 230; ++x, ++all) {
        double sum = 0;
        for (int v = -kReach; v <= kReach; ++v)
          for (int u = -kReach; u <= kReach; ++u) sum += drawn.at(x + u, y + v)[1];
        const double mean = sum / ((2 * kReach + 1) * (2 * kReach + 1));
        off += std::abs(drawn.at(x, y)[1] - mean) > 8 ? 1 : 0;
      }
    return double(off) / all;
  };
  const DepthMap sigma(kTexels, kTexels, kError);
  for (const double relight : {0.0, 0.6, 1.0}) {
    const double unaware = share_off({}, relight), aware = share_off(sigma, relight);
    std::printf("lamp of %.0f %%: %.1f %% off without the error, %.2f %% with it\n", 100 * relight,
                100 * unaware, 100 * aware);
    if (relight > 0) {
      EXPECT_GT(unaware, 0.05);
    }
    EXPECT_LT(aware, 0.001);
  }
}

// A long slope of 4 mm that the map's error of 0.15 mm leaves as a step. Between the places that a
// side is judged by, 6.6 texels apart, it rises by less than seven standard errors.
TEST_F(DrawnRelief, SlopesThatTheErrorExplainsHaveNoSides) {
  constexpr int kSize = 320;
  DepthMap depth(kTexels, kTexels);
  for (int y = 0; y < kTexels; ++y)
    for (int x = 0; x < kTexels; ++x)
      depth.at(x, y) =
          static_cast<float>(0.02 + 0.004 * std::clamp((y - kTexels / 2) / 48.0, 0.0, 1.0));
  backdrop_.projection.focal_px = 1500;
  const glm::dvec3 ahead = glm::normalize(glm::dvec3(0, 0.25, 0.97)), right(1, 0, 0);
  picture_.view = {{0, -0.004, 0.014}, ahead, glm::cross(right, ahead), right};
  picture_.field_of_view = 0.5;
  picture_.relief = kUsualRelief;
  const auto share_dark = [&](const DepthMap& sigma) {
    view_->SetBackdrop(Grey(kTexels, kTexels, 150), depth, backdrop_, sigma);
    view_->Render(picture_, kSize);
    const ColourImage drawn = view_->ReadPixels();
    int dark = 0, all = 0;
    for (int y = 120; y < 200; ++y)
      for (int x = 120; x < 200; ++x, ++all) dark += drawn.at(x, y)[1] < 140 ? 1 : 0;
    return double(dark) / all;
  };
  const double unaware = share_dark({}), aware = share_dark(DepthMap(kTexels, kTexels, 1.5e-4f));
  std::printf("sides: %.1f %% of the picture without the error, %.2f %% with it\n", 100 * unaware,
              100 * aware);
  EXPECT_GT(unaware, 0.02);
  EXPECT_EQ(aware, 0);
}

// A relief of 28 mm whose picture ends 40 degrees below the view: the sphere behind is 28 mm
// further, but the relief goes on beyond the edge of the picture, and beyond an unknown part of it.
TEST_F(DrawnRelief, TheEndOfThePanoramaIsNoCliff) {
  constexpr int kSize = 256;
  for (const int unknown : {0, 40}) {
    DepthMap depth(kTexels, kTexels, 0.028f);
    for (int y = kTexels - unknown; y < kTexels; ++y)
      for (int x = 0; x < kTexels; ++x) depth.at(x, y) = NAN;
    Backdrop backdrop = backdrop_;
    backdrop.projection.type = ProjectionType::kEquirectangular;
    backdrop.projection.px_per_deg = kTexels / 2 / 15.0;  // to 15 degrees below
    view_->SetBackdrop(Grey(kTexels, kTexels, 150), depth, backdrop);
    for (const ReliefSearch search : {ReliefSearch{256, 1}, kUsualRelief}) {
      picture_.relief = search;
      view_->Render(picture_, kSize);
      const std::vector<float> distances = view_->ReadDistances();
      const ColourImage drawn = view_->ReadPixels();
      int cliffs = 0, dark = 0;
      for (int y = 30; y + 31 < kSize; ++y)
        for (int x = 60; x < kSize - 60; ++x) {
          const auto at = [&](int v) { return distances[static_cast<std::size_t>(v * kSize + x)]; };
          cliffs += std::abs(at(y + 1) - at(y)) > 2e-3f ? 1 : 0;
          dark += drawn.at(x, y)[1] < 70 ? 1 : 0;
        }
      EXPECT_GT(dark, 500) << "the picture ends within the view";
      EXPECT_EQ(cliffs, 0) << search.cell << ' ' << unknown;
    }
  }
}

// No ray passes through a part that is level at the relief's maximum.
TEST_F(DrawnRelief, LevelPartsAreCompleteAndAtTheirDistance) {
  constexpr int kSize = 256;
  const DepthMap depth(kTexels, kTexels, 0.028f);
  view_->SetBackdrop(Grey(kTexels, kTexels, 150), depth, backdrop_);
  for (const ReliefSearch search : {ReliefSearch{256, 1}, ReliefSearch{16, 1}, kUsualRelief}) {
    picture_.relief = search;
    view_->Render(picture_, kSize);
    const std::vector<float> distances = view_->ReadDistances();
    double worst = 0;
    int compared = 0;
    for (int y = 30; y < kSize; ++y)
      for (int x = 0; x < kSize; ++x) {
        const auto ray = ReferenceRay(picture_.view, picture_.field_of_view, kSize, {x, y});
        if (!ray || std::hypot(x - 127.5, y - 127.5) > 126) continue;
        const glm::dvec3 hit =
            *ReferenceSphereHit(picture_.view.tip, *ray, backdrop_.radius - 0.028);
        const auto pixel = ReferencePixel(backdrop_.projection, hit);
        if (!pixel || pixel->x < 1 || pixel->y < 1 || pixel->x > 510 || pixel->y > 510) continue;
        const double found = distances[static_cast<std::size_t>(y * kSize + x)];
        worst = std::max(worst, std::abs(found - glm::distance(hit, picture_.view.tip)));
        ++compared;
      }
    std::printf("%d steps, cells of %d: %d pixels, off by at most %.4f mm\n", search.steps,
                search.cell, compared, 1e3 * worst);
    EXPECT_GT(compared, 10000);
    EXPECT_LT(worst, 0.02e-3);
  }
}

}  // namespace
}  // namespace arthro::test
