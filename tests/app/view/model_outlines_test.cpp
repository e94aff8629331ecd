// Models against the reference tracer: outlines, distances and occlusion by the backdrop, through
// every kind of lens that a scene may have.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <string>
#include <utility>

#include <glm/geometric.hpp>

#include "simulation/core/units.h"
#include "tests/app/view/view_scene.h"
#include "tests/support/view/reference_tracer.h"

namespace arthro::test {
namespace {

using namespace app;

constexpr int kOutlineSize = 256;  // px

struct Agreement {
  int wrong = 0,
      far_wrong = 0;  // pixels with the other of model and backdrop; those not at an edge
  int outline = 0, covered = 0;
  double worst_model = 0, worst_backdrop = 0;                 // distance, m
  double edge_px() const { return wrong / (0.5 * outline); }  // an edge has a pixel on either side
  void operator+=(const Agreement& other) {
    wrong += other.wrong, far_wrong += other.far_wrong, outline += other.outline;
    covered += other.covered;
    worst_model = std::max(worst_model, other.worst_model);
    worst_backdrop = std::max(worst_backdrop, other.worst_backdrop);
  }
};

// Compares a model (in the portal frame) over the bare sphere of `loaded`, inside the window's rim.
Agreement Compare(app::ArthroscopicView& view, const LoadedScene& loaded, const SurfaceMesh& model,
                  const Picture& picture, const Lens* lens) {
  Tissue tissue;
  view.SetTissues(std::span(&tissue, 1), std::vector{Share(model)});
  view.Render(picture, kOutlineSize);
  const std::vector<float> drawn = view.ReadDistances();
  const Backdrop& backdrop = loaded.scene.backdrop;
  const ReferenceMesh reference{&model};
  const TracedPicture traced =
      TraceWindow(backdrop, *loaded.panorama, picture.view, picture.field_of_view, kOutlineSize,
                  std::span(&reference, 1), nullptr, lens);
  const auto is_model = [&](int x, int y) {
    return traced.what[static_cast<std::size_t>(y) * kOutlineSize + x] == 1;
  };
  Agreement result;
  for (int y = 4; y < kOutlineSize - 4; ++y)
    for (int x = 4; x < kOutlineSize - 4; ++x) {
      if (std::hypot(x - 127.5, y - 127.5) > 116) continue;
      const std::size_t i = static_cast<std::size_t>(y) * kOutlineSize + x;
      const auto ray =
          ReferenceRay(picture.view, picture.field_of_view, kOutlineSize, {x, y}, lens);
      const double sphere = glm::distance(
          *ReferenceSphereHit(picture.view.tip, *ray, backdrop.radius), picture.view.tip);
      const bool drawn_model = drawn[i] < sphere - 20e-6;
      const bool edge =
          is_model(x, y) != is_model(x + 1, y) || is_model(x, y) != is_model(x - 1, y) ||
          is_model(x, y) != is_model(x, y + 1) || is_model(x, y) != is_model(x, y - 1);
      result.outline += edge;
      if (drawn_model != is_model(x, y)) {
        ++result.wrong;
        result.far_wrong += !edge;
        continue;
      }
      // At the outline the surface is edge-on, where a tiny displacement changes the distance much.
      const double off = std::abs(static_cast<double>(drawn[i]) - traced.distance[i]);
      if (drawn_model && !edge) result.worst_model = std::max(result.worst_model, off);
      if (!drawn_model) result.worst_backdrop = std::max(result.worst_backdrop, off);
      result.covered += drawn_model;
    }
  return result;
}

struct Glass {
  const char* name;
  std::optional<Lens> lens;  // none: equisolid, with 1.8 rad
  friend void PrintTo(const Glass& glass, std::ostream* out) { *out << glass.name; }
};

// Their axes are at least a tenth of the round window's radius off its centre.
Lens AsideLens(LensModel model, double focal_px, std::array<double, 4> k) {
  Lens lens;
  lens.model = model;
  lens.width = 720, lens.height = 576;
  lens.focal_px = focal_px;
  lens.cx = 388, lens.cy = 272;
  lens.k = k;
  lens.circle = {360, 288, 255};
  return lens;
}

class ModelOutlines : public ViewTest, public testing::WithParamInterface<Glass> {
 protected:
  void SetUp() override {
    ViewTest::SetUp();
    if (IsSkipped()) return;
    loaded = MakeViewScene(256, 256);
    loaded.scene.backdrop.projection.focal_px = 110;
    view_->SetBackdrop(*loaded.panorama, {}, loaded.scene.backdrop);
    ScopeSpec scope;
    scope.field_of_view = 1.8;
    optics = simulation::OpticsOf(scope, GetParam().lens);
  }
  Picture Look(const simulation::RodPose& pose, double view_angle) const {
    Picture picture = PictureFromPose(pose, view_angle, optics.field_of_view);
    picture.lens = optics.lens;
    return picture;
  }
  const Lens* lens() const { return GetParam().lens ? &*GetParam().lens : nullptr; }
  LoadedScene loaded;
  simulation::ScopeOptics optics;
};

// The bounds are those of the ellipsoids below, which have chords of the same length.
void ExpectWithinAPixel(const Agreement& result) {
  EXPECT_GT(result.covered, 5000);
  EXPECT_EQ(result.far_wrong, 0);
  EXPECT_LT(result.edge_px(), 0.1);
  EXPECT_LT(result.worst_model, 0.3e-3);
  EXPECT_LT(result.worst_backdrop, 5e-6);  // the bound of the backdrop alone (backdrop_test.cpp)
}

void Print(const char* name, const std::string& what, const Agreement& result) {
  std::printf(
      "%s, %s: %d of %d outline pixels differ from the tracer (mean %.3f px), %d further in; "
      "distance within %.3g mm over %d pixels, the backdrop's within %.2g mm\n",
      name, what.c_str(), result.wrong, result.outline, result.edge_px(), result.far_wrong,
      1e3 * result.worst_model, result.covered, 1e3 * result.worst_backdrop);
}

TEST_P(ModelOutlines, OfEllipsoidsAgreeWithTheReferenceTracerWithinAPixel) {
  const glm::dquat turn(std::cos(0.3), 0, std::sin(0.3), 0);
  Agreement all;
  for (const glm::dvec3 place : {glm::dvec3(0.001, 0.001, 0.032), glm::dvec3(0.012, -0.008, 0.028),
                                 glm::dvec3(-0.015, 0.01, 0.024)}) {
    SurfaceMesh model = Ellipsoid({0.007, 0.004, 0.005});
    for (glm::dvec3& vertex : model.vertices) vertex = place + turn * vertex;
    all += Compare(*view_, loaded, model, Look({0, 0, 0.4, 0.012}, 0.2), lens());
  }
  Print(GetParam().name, "ellipsoids", all);
  ExpectWithinAPixel(all);
}

// A ball of 4 mm at an angle from the view's axis, turned from right to up.
SurfaceMesh BallAt(const Picture& picture, double theta, double turn, double distance) {
  const simulation::ScopeView& v = picture.view;
  const glm::dvec3 ray = std::cos(theta) * v.view +
                         std::sin(theta) * (std::cos(turn) * v.right + std::sin(turn) * v.up);
  SurfaceMesh ball = Ellipsoid(glm::dvec3(0.004));
  for (glm::dvec3& vertex : ball.vertices) vertex += v.tip + distance * ray;
  return ball;
}

TEST_P(ModelOutlines, OfBallsAtAllViewAnglesAndPlacesAgreeWithTheReferenceTracerWithinAPixel) {
  const double half = 0.5 * optics.field_of_view;
  for (const double angle : {0.0, 30.0, 70.0}) {
    const Picture picture = Look({0.1, -0.15, 0.4, 0.012}, RadiansFromDegrees(angle));
    Agreement all;
    for (const auto& [theta, turn] : {std::pair(0.0, 0.0), std::pair(0.45 * half, 0.8),
                                      std::pair(0.8 * half, 2.5), std::pair(0.8 * half, -1.2)})
      all += Compare(*view_, loaded, BallAt(picture, theta, turn, 0.014), picture, lens());
    Print(GetParam().name, std::to_string(std::lround(angle)) + " degrees", all);
    ExpectWithinAPixel(all);
  }
}

// A ball with its centre 1.5 mm behind the backdrop: a cap stands out, and ends where the two
// surfaces intersect.
TEST_P(ModelOutlines, OfABallThatIntersectsTheBackdropAgreeWithTheReferenceTracer) {
  const double half = 0.5 * optics.field_of_view;
  for (const double angle : {0.0, 30.0, 70.0}) {
    const Picture picture = Look({0.1, -0.15, 0.4, 0.03}, RadiansFromDegrees(angle));
    const SurfaceMesh whole = BallAt(picture, 0.3 * half, -2.0, 0.0);
    const glm::dvec3 ray =
        glm::normalize(BallAt(picture, 0.3 * half, -2.0, 1.0).vertices[0] - whole.vertices[0]);
    const double sphere = glm::distance(
        *ReferenceSphereHit(picture.view.tip, ray, loaded.scene.backdrop.radius), picture.view.tip);
    const auto sunk = [&](double depth) {
      return Compare(*view_, loaded, BallAt(picture, 0.3 * half, -2.0, sphere + depth), picture,
                     lens());
    };
    const Agreement result = sunk(0.0015);
    Print(GetParam().name, "sunk, " + std::to_string(std::lround(angle)) + " degrees", result);
    EXPECT_EQ(result.far_wrong, 0);
    EXPECT_LT(result.edge_px(), 0.1);
    EXPECT_GT(result.covered, 300);
    EXPECT_LT(result.covered, 0.95 * sunk(-0.0015).covered) << "some of it is hidden";
  }
}

// The comparison must tell lenses apart, or the results above would prove little.
class OffAxisOutlines : public ModelOutlines {};
TEST_P(OffAxisOutlines, DetectALensWhoseAxisIsTakenForTheCentre) {
  Picture picture = Look({0.1, -0.15, 0.4, 0.012}, 0.5);
  picture.lens.axis = {0, 0};
  const Agreement result =
      Compare(*view_, loaded, BallAt(picture, 0.45, 0.0, 0.014), picture, lens());
  EXPECT_GT(result.edge_px(), 1.0);
  EXPECT_GT(result.far_wrong, 100);
}

const Glass kKannalaBrandt{"kannala_brandt",
                           AsideLens(LensModel::kKannalaBrandt, 290, {-0.09, 0.015, 0, 0})};
const Glass kPinhole{"pinhole", AsideLens(LensModel::kPinhole, 300, {})};
constexpr auto kNameOf = [](const auto& glass) { return std::string(glass.param.name); };
INSTANTIATE_TEST_SUITE_P(Lenses, ModelOutlines,
                         testing::Values(Glass{"equisolid", std::nullopt}, kKannalaBrandt,
                                         kPinhole),
                         kNameOf);
INSTANTIATE_TEST_SUITE_P(Lenses, OffAxisOutlines, testing::Values(kKannalaBrandt, kPinhole),
                         kNameOf);

}  // namespace
}  // namespace arthro::test
