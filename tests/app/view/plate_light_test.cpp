// A hyaline plate has the light of the backdrop that it lies on, from every side.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include <glm/geometric.hpp>

#include "simulation/core/units.h"
#include "tests/app/view/lit_scene.h"
#include "tests/app/view/view_scene.h"
#include "tests/support/view/reference_tracer.h"

namespace arthro::test {
namespace {

using app::Picture;
using app::PictureFromPose;

constexpr double kRelief = 0.02, kBumpHeight = 0.2e-3, kHalf = 0.35;  // m, m, rad
constexpr int kLightSize = 256;

// Spherical cap about the portal, just over the relief, seen from the portal's side.
SurfaceMesh Cap(double radius) {
  constexpr int kRings = 24, kAround = 64;
  SurfaceMesh mesh;
  mesh.vertices.push_back({0, 0, radius});
  for (int ring = 1; ring <= kRings; ++ring)
    for (int i = 0; i < kAround; ++i) {
      const double off = kHalf * ring / kRings, turn = 2 * std::numbers::pi * i / kAround;
      mesh.vertices.push_back(radius * glm::dvec3(std::sin(off) * std::cos(turn),
                                                  std::sin(off) * std::sin(turn), std::cos(off)));
    }
  const auto at = [](int ring, int i) { return 1 + (ring - 1) * kAround + i % kAround; };
  for (int i = 0; i < kAround; ++i) {
    mesh.triangles.push_back({0, at(1, i + 1), at(1, i)});
    for (int ring = 1; ring < kRings; ++ring) {
      mesh.triangles.push_back({at(ring, i), at(ring + 1, i + 1), at(ring + 1, i)});
      mesh.triangles.push_back({at(ring, i), at(ring, i + 1), at(ring + 1, i + 1)});
    }
  }
  return mesh;
}

double LinearLuma(const std::uint8_t* rgb) {
  const auto linear = [](std::uint8_t byte) { return std::pow(byte / 255.0, 2.2); };
  return 0.2126 * linear(rgb[0]) + 0.7152 * linear(rgb[1]) + 0.0722 * linear(rgb[2]);
}

class PlateLight : public ViewTest {
 protected:
  struct Means {
    double high = 0, low = 0;          // light of the plate over that of the backdrop there
    double high_red = 0, low_red = 0;  // red over green of the plate
    int highs = 0, lows = 0;           // pixels
  };
  // One picture holds parts that face the lamp (cosine above 0.8) and parts that hardly do.
  Means Draw(double relight) {
    Backdrop backdrop = PlainBackdrop(512, 512);
    backdrop.relight = relight;
    view_->SetBackdrop(Grey(512, 512, 110), DepthMap(512, 512, kRelief), backdrop);
    Picture picture =
        PictureFromPose({0, -0.15, std::numbers::pi / 2, 0.0285}, RadiansFromDegrees(70), 1.5);
    picture.relief = app::kUsualRelief;
    view_->SetTissues({}, {});
    view_->Render(picture, kLightSize);
    const ColourImage bare = view_->ReadPixels();
    const std::vector<float> ground = view_->ReadDistances();
    Tissue plate;
    plate.colour = glm::dvec3(0.4);  // brightness of the backdrop: the automatic gain stays
    simulation::TissueLook look;
    look.structure = simulation::TissueStructure::kHyaline;
    look.gloss = 0;
    view_->SetTissues(std::span(&plate, 1),
                      std::vector{Share(Cap(backdrop.radius - kRelief - kBumpHeight))},
                      std::span(&look, 1));
    view_->Render(picture, kLightSize);
    const ColourImage drawn = view_->ReadPixels();
    const std::vector<float> distances = view_->ReadDistances();
    Means means;
    for (int y = 0; y < kLightSize; ++y)
      for (int x = 0; x < kLightSize; ++x) {
        const auto i = static_cast<std::size_t>(y) * kLightSize + static_cast<std::size_t>(x);
        const auto ray = ReferenceRay(picture.view, picture.field_of_view, kLightSize, {x, y});
        // Farther in than the fade at the relief.
        if (!ray || !(distances[i] > 0) || !(distances[i] < ground[i] - 0.1e-3)) continue;
        if (!(LinearLuma(bare.at(x, y)) > 1e-3)) continue;
        const glm::dvec3 place = picture.view.tip + double(distances[i]) * *ray;
        const double facing = glm::dot(glm::normalize(place), *ray);
        const double share = LinearLuma(drawn.at(x, y)) / LinearLuma(bare.at(x, y));
        const double red = double(drawn.at(x, y)[0]) / drawn.at(x, y)[1];
        if (facing > 0.7) {
          means.high += share, means.high_red += red, ++means.highs;
        } else if (facing < 0.45) {
          means.low += share, means.low_red += red, ++means.lows;
        }
      }
    means.high /= means.highs, means.high_red /= means.highs;
    means.low /= means.lows, means.low_red /= means.lows;
    return means;
  }
};

// A plate was lit like other models, as a round body that light passes through: at low angles it
// had 0.58 to 0.70 of the light of the surface around it in the footage's light, and was browner by
// 4 %. What is left comes of the backdrop's squares, which stand for sRGB.
TEST_F(PlateLight, IsThatOfItsBackdropAlsoFromALowAngle) {
  for (const double relight : {0.0, 0.3, 0.6, 1.0}) {
    const Means means = Draw(relight);
    std::printf(
        "relight %.1f: plate over backdrop %.3f facing (%d px), %.3f at low angles (%d "
        "px); red over green %.3f, %.3f\n",
        relight, means.high, means.highs, means.low, means.lows, means.high_red, means.low_red);
    ASSERT_GT(means.highs, 200);
    ASSERT_GT(means.lows, 200);
    EXPECT_NEAR(means.low / means.high, 1.0, 0.15);
    EXPECT_NEAR(means.low_red, means.high_red, 0.02);
  }
}

}  // namespace
}  // namespace arthro::test
