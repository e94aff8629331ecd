// The whole phantom: exact depth, plausible colours, the same bytes on every run.
#include "authoring/phantom/phantom.h"

#include <cmath>
#include <cstdio>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace arthro::authoring {
namespace {

constexpr int kWidth = 400, kHeight = 300;

// A picture smaller than the sizes for users, so that a test takes a second.
PhantomPicture Draw(const Cavity& cavity, const TissueCaster* tissues, Difficulty difficulty,
                    int threads, const PhantomPicture* without = nullptr) {
  const VesselTrees vessels(cavity.seed);
  const PhantomView bare{cavity, vessels, nullptr, LookOf(difficulty)};
  Projection projection;
  projection.type = ProjectionType::kEquirectangular;
  projection.px_per_deg = kWidth / 200.0;
  projection.centre_px = {(kWidth - 1) / 2.0, (kHeight - 1) / 2.0};
  const double exposure = ExposureOf(bare, projection, kWidth, kHeight);
  return RenderPanorama({cavity, vessels, tissues, LookOf(difficulty)}, projection, kWidth, kHeight,
                        exposure, threads, {}, "", without);
}

TEST(Phantom, DepthIsTheRayCastToHalfAMicrometre) {
  const Cavity cavity = MakeCavity(1);
  const PhantomPicture picture = Draw(cavity, nullptr, Difficulty::kEasy, 2);
  double worst = 0;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const double lon = (x - (kWidth - 1) / 2.0) / 2.0 * M_PI / 180,
                   lat = -(y - (kHeight - 1) / 2.0) / 2.0 * M_PI / 180;
      const glm::dvec3 d(std::cos(lat) * std::sin(lon), -std::sin(lat),
                         std::cos(lat) * std::cos(lon));
      const double relief = cavity.radius - CastFromPortal(cavity, d).distance;
      ASSERT_TRUE(std::isfinite(picture.depth.at(x, y)));
      worst = std::max(worst, std::abs(relief - picture.depth.at(x, y)));
    }
  std::printf("largest rounding: %.2f um\n", worst * 1e6);
  EXPECT_LT(worst, 0.5e-6);  // half of 2^-20 m, plus 2 nm of rounding to float
}

TEST(Phantom, SameSeedGivesTheSameBytesForAnyNumberOfThreads) {
  const Cavity cavity = MakeCavity(7);
  const PhantomPicture one = Draw(cavity, nullptr, Difficulty::kEasy, 1),
                       three = Draw(cavity, nullptr, Difficulty::kEasy, 3);
  EXPECT_EQ(one.colour.rgb, three.colour.rgb);
  EXPECT_EQ(one.depth.relief, three.depth.relief);
}

TEST(Phantom, AnotherSeedGivesAnotherKnee) {
  const PhantomPicture a = Draw(MakeCavity(1), nullptr, Difficulty::kEasy, 2),
                       b = Draw(MakeCavity(2), nullptr, Difficulty::kEasy, 2);
  std::size_t different = 0;
  for (std::size_t i = 0; i < a.depth.relief.size(); ++i)
    different += std::abs(a.depth.relief[i] - b.depth.relief[i]) > 1e-4f;
  EXPECT_GT(different, a.depth.relief.size() / 2);
}

struct Statistics {
  double mean = 0, contrast = 0, black = 0, white = 0, redness = 0;
};
Statistics StatisticsOf(const ColourImage& image) {
  Statistics s;
  double squares = 0;
  const double count = static_cast<double>(image.width) * image.height;
  for (std::size_t i = 0; i < image.rgb.size(); i += 3) {
    const double r = image.rgb[i], g = image.rgb[i + 1], b = image.rgb[i + 2],
                 grey = 0.3 * r + 0.59 * g + 0.11 * b;
    s.mean += grey / count, squares += grey * grey / count, s.redness += (r - b) / count;
    s.black += (grey < 8) / count, s.white += (std::min({r, g, b}) > 252) / count;
  }
  s.contrast = std::sqrt(squares - s.mean * s.mean);
  return s;
}

TEST(Phantom, IsExposedLikeAnArthroscopicPicture) {
  for (const int seed : {0, 1, 2, 3}) {
    const Statistics s = StatisticsOf(
        Draw(MakeCavity(static_cast<std::uint32_t>(seed)), nullptr, Difficulty::kEasy, 2).colour);
    std::printf(
        "seed %d: mean %.0f, contrast %.0f, black %.3f %%, white %.3f %%, red - blue %.0f\n", seed,
        s.mean, s.contrast, 100 * s.black, 100 * s.white, s.redness);
    EXPECT_GT(s.mean, 90);
    EXPECT_LT(s.mean, 190);
    EXPECT_GT(s.contrast, 20);
    EXPECT_LT(s.black, 0.002);
    EXPECT_LT(s.white, 0.01);
    EXPECT_GT(s.redness, 25);  // tissue, not grey
  }
}

TEST(Phantom, HarderPicturesAreFlatterAndDarker) {
  const Cavity cavity = MakeCavity(1);
  const Statistics easy = StatisticsOf(Draw(cavity, nullptr, Difficulty::kEasy, 2).colour);
  const Statistics medium = StatisticsOf(Draw(cavity, nullptr, Difficulty::kMedium, 2).colour);
  const Statistics hard = StatisticsOf(Draw(cavity, nullptr, Difficulty::kHard, 2).colour);
  EXPECT_GT(easy.mean, medium.mean);
  EXPECT_GT(medium.mean, hard.mean);
  EXPECT_GT(easy.contrast, medium.contrast);
  EXPECT_GT(medium.contrast, hard.contrast);
}

TEST(Phantom, TissuesComeNearerAndChangeNothingElse) {
  const Cavity cavity = MakeCavity(1);
  TissueCaster tissues;
  const PhantomTissue meniscus = MakeMeniscus(cavity);
  tissues.Add(InPortal(meniscus), Surface::kMeniscus, meniscus.rims);
  tissues.Add(InPortal(MakeCartilage(cavity)), Surface::kCartilage, {});
  tissues.Sort();
  const PhantomPicture without = Draw(cavity, nullptr, Difficulty::kEasy, 2);
  const PhantomPicture with = Draw(cavity, &tissues, Difficulty::kEasy, 2, &without);
  std::size_t meniscus_pixels = 0, cartilage_pixels = 0;
  for (std::size_t i = 0; i < with.surfaces.size(); ++i) {
    meniscus_pixels += with.surfaces[i] == Surface::kMeniscus;
    cartilage_pixels += with.surfaces[i] == Surface::kCartilage;
    if (with.surfaces[i] == Surface::kMeniscus || with.surfaces[i] == Surface::kCartilage)
      EXPECT_GT(with.depth.relief[i], without.depth.relief[i]);
    else
      EXPECT_EQ(with.depth.relief[i], without.depth.relief[i]);
  }
  EXPECT_GT(meniscus_pixels, 800u);
  EXPECT_GT(cartilage_pixels, 300u);
}

TEST(Phantom, LandmarksOfTheBonesLieOnTheirSurfaces) {
  PhantomOptions options;
  options.size = PhantomSize::kSmall;
  const Phantom phantom = MakePhantom(options);
  const auto named = [&](const std::string& name) {
    for (const Landmark& landmark : phantom.landmarks)
      if (landmark.name == name) return landmark.x_in_portal;
    return glm::dvec3(0.0);
  };
  const glm::dvec3 apex = named("condyle apex, nearest to the portal");
  EXPECT_NEAR(EllipsoidClearance(phantom.cavity.condyle, apex), 0.0, 1e-9);
  // At the nearest point the surface faces the portal.
  EXPECT_NEAR(glm::dot(NormalAt(phantom.cavity, Surface::kCondyle, apex), glm::normalize(apex)),
              -1.0, 1e-9);
  for (const char* name : {"plateau, tibial spine", "plateau, middle of the cartilage bed"})
    EXPECT_NEAR(Clearance(phantom.cavity, named(name)), 0.0, 1e-6) << name;
}

}  // namespace
}  // namespace arthro::authoring
