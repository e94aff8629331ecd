// Polynomials of the lens of the round window, compared with the lens itself.
#include "simulation/scope/window_lens.h"

#include <cmath>
#include <cstdio>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "simulation/core/error.h"
#include "simulation/core/units.h"

namespace arthro::simulation {
namespace {

Lens MakeLens(LensModel model, double focal, std::array<double, 4> k, double radius) {
  Lens lens;
  lens.model = model;
  lens.width = 720;
  lens.height = 576;
  lens.focal_px = focal;
  lens.cx = 372.5;
  lens.cy = 280.25;
  lens.k = k;
  lens.circle = {360, 288, radius};
  return lens;
}

// Maps every pixel of the window as the model of the lens does, and back.
TEST(WindowLens, MapsPixelsAsTheLensDoes) {
  struct Case {
    const char* name;
    Lens lens;
  };
  const Case cases[] = {
      {"equisolid aside", MakeLens(LensModel::kEquisolid, 340, {}, 250)},
      {"kannala_brandt",
       MakeLens(LensModel::kKannalaBrandt, 330, {-0.05, 0.01, -0.004, 0.001}, 250)},
      {"kannala_brandt, strong",
       MakeLens(LensModel::kKannalaBrandt, 240, {-0.12, 0.02, 0, 0}, 280)},
      {"double_sphere", MakeLens(LensModel::kDoubleSphere, 250, {-0.2, 0.6, 0, 0}, 280)},
      {"pinhole", MakeLens(LensModel::kPinhole, 300, {}, 250)}};
  for (const Case& c : cases) {
    const double field = WindowFieldOfView(c.lens);
    const WindowLens window = FitWindowLens(c.lens, field);
    const ScopeView view = ViewFromPose({0.2, -0.3, 0.7, 0.01}, 0.4);
    double worst_in = 0, worst_out = 0, worst_ray = 0;
    for (int y = -40; y <= 40; ++y)
      for (int x = -40; x <= 40; ++x) {
        const glm::dvec2 place = glm::dvec2(x, y) / 40.0;  // right and up, in radii
        if (glm::length(place) > 1.0) continue;
        const auto ray = RayFromPixel(c.lens, {c.lens.circle.cx + c.lens.circle.r * place.x,
                                               c.lens.circle.cy - c.lens.circle.r * place.y});
        ASSERT_TRUE(ray) << c.name;
        const double theta = std::atan2(std::hypot(ray->x, ray->y), ray->z);
        const double turn = std::atan2(-ray->y, ray->x);
        const double q = std::sin(theta / 2) / std::sin(field / 4);
        const glm::dvec2 equisolid = q * glm::dvec2(std::cos(turn), std::sin(turn));
        const glm::dvec2 offset = place - window.axis;
        worst_in = std::max(
            worst_in,
            glm::length(offset * LensFactor(window.inward, glm::dot(offset, offset)) - equisolid));
        worst_out = std::max(
            worst_out,
            glm::length(window.axis + equisolid * LensFactor(window.outward, q * q) - place));
        const glm::dvec3 through = RayThrough({field, window}, view, place);
        worst_ray = std::max(
            worst_ray,
            glm::length(through - (ray->x * view.right - ray->y * view.up + ray->z * view.view)));
      }
    std::printf("%s, %.1f degrees: off by %.2g and %.2g radii, rays by %.2g rad\n", c.name,
                DegreesFromRadians(field), worst_in, worst_out, worst_ray);
    EXPECT_LT(worst_in, kWindowLensError) << c.name;
    EXPECT_LT(worst_out, kWindowLensError) << c.name;
    // An error of q changes θ by at most 2 tan(θ/2) times that, below 2 here.
    EXPECT_LT(worst_ray, 2 * kWindowLensError) << c.name;
  }
}

TEST(WindowLens, WithoutAFileItIsEquisolid) {
  const ScopeOptics optics = OpticsOf({}, std::nullopt);
  EXPECT_TRUE(IsEquisolid(optics.lens));
  EXPECT_EQ(optics.field_of_view, ScopeSpec{}.field_of_view);
  EXPECT_EQ(LensFactor(optics.lens.inward, 0.7), 1.0);
}

TEST(WindowLens, TheRequestedFieldOfViewPrecedesTheLensAndTheLensTheScene) {
  const Lens lens = MakeLens(LensModel::kKannalaBrandt, 330, {}, 250);
  const double own = OpticsOf({}, lens).field_of_view;
  EXPECT_NEAR(own, 2 * 250.0 / 330, 1e-9);
  EXPECT_EQ(OpticsOf({}, lens, 1.0).field_of_view, 1.0);
}

TEST(WindowLens, RefusesALensThatEndsWithinItsWindow) {
  const auto sentence = [](const Lens& lens, double field) -> std::string {
    try {
      FitWindowLens(lens, field);
    } catch (const Error& error) {
      return error.what();
    }
    return {};
  };
  const Lens pinhole = MakeLens(LensModel::kPinhole, 300, {}, 250);
  EXPECT_NE(sentence(pinhole, 3.2).find("ends within a field of view of 183.3 degrees"),
            std::string::npos);
  EXPECT_NE(sentence(pinhole, 2.95).find("choose a smaller field of view"), std::string::npos);
  // A profile that decreases again before the rim of the circle.
  Lens folded = MakeLens(LensModel::kKannalaBrandt, 200, {-0.5, 0, 0, 0}, 250);
  folded.field_of_view = 1.0;
  EXPECT_NE(sentence(folded, 1.0).find("ends within its round window"), std::string::npos)
      << sentence(folded, 1.0);
}

}  // namespace
}  // namespace arthro::simulation
