// The camera's automatic gain against closed forms and against every pixel of the window.
#include "app/view/exposure/automatic_gain.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <limits>
#include <vector>

#include <glm/geometric.hpp>

#include "app/view/drawing/srgb.h"
#include "simulation/core/units.h"
#include "tests/app/view/lit_scene.h"
#include "tests/app/view/view_scene.h"
#include "tests/support/view/reference_tracer.h"

namespace arthro::test {
namespace {

using namespace app;

// From the portal all of a bare sphere is at D: what the lamp takes away the gain gives back.
TEST(FootageLight, GainOfAGreySphereIsTheClosedForm) {
  const Backdrop backdrop = PlainBackdrop(400, 400);
  const LightGrid grid = MakeLightGrid(Grey(400, 400, 60), {});
  const double reach = 0.0275;
  const double expected = (0.05 * 0.05 + kLampRadius * kLampRadius) / (reach * reach);
  const auto view = [](double depth) { return simulation::ViewFromPose({0, 0, 0, depth}, 0.0); };
  EXPECT_NEAR(AutomaticGain(grid, MeasureLight(grid), backdrop, view(0.0), {1.5, {}}, reach),
              expected, 1e-3 * expected);
  // White and near, the picture is as bright as the footage still was: it does not blow out.
  const LightGrid white = MakeLightGrid(Grey(400, 400, 250), {});
  const double near =
      AutomaticGain(white, MeasureLight(white), backdrop, view(0.044), {0.2, {}}, reach);
  EXPECT_NEAR(near, (0.006 * 0.006 + kLampRadius * kLampRadius) / (reach * reach), 0.02 * near);
  // Nearer it takes less gain, and goes there smoothly.
  double before = expected;
  for (double depth = 0.001; depth < 0.038; depth += 0.001) {
    const double gain =
        AutomaticGain(grid, MeasureLight(grid), backdrop, view(depth), {1.5, {}}, reach);
    EXPECT_LT(gain, before);
    EXPECT_GT(gain, 0.8 * before);
    before = gain;
  }
}

// Half of the window is 16 mm away, the other 50: 1.41 of the footage's brightness, where the plain
// mean would give 1.81.
TEST(FootageLight, WhatIsNearIsNotLostInWhiteWhenTheRestIsFar) {
  const Backdrop backdrop = PlainBackdrop(400, 400);
  DepthMap depth(400, 400, 0.0f);
  for (int y = 200; y < 400; ++y)
    for (int x = 0; x < 400; ++x) depth.at(x, y) = 0.034f;
  const LightGrid grid = MakeLightGrid(Grey(400, 400, 150), depth);
  const double reach = 0.0275;
  const double gain = AutomaticGain(grid, MeasureLight(grid), backdrop,
                                    simulation::ViewFromPose({0, 0, 0, 0}, 0.0), {1.5, {}}, reach);
  const auto lamp = [&](double distance) {
    return gain * reach * reach / (distance * distance + kLampRadius * kLampRadius);
  };
  // Half-way between the two; a row of rays lies on the edge.
  EXPECT_LT(lamp(0.016), 1.6);
}

TEST(FootageLight, NothingImagedOrBlackNeedsNoGain) {
  const Backdrop backdrop = PlainBackdrop(64, 48);
  const auto view = simulation::ViewFromPose({0, 0, 0, 0.01}, 0.0);
  const LightGrid nothing = MakeLightGrid(Grey(64, 48, 90), DepthMap(64, 48, NAN));
  EXPECT_EQ(AutomaticGain(nothing, MeasureLight(nothing), backdrop, view, {1.5, {}}, 0.03), 1.0);
  const LightGrid black = MakeLightGrid(Grey(64, 48, 0), {});
  EXPECT_EQ(AutomaticGain(black, MeasureLight(black), backdrop, view, {1.5, {}}, 0.03), 1.0);
  const LightGrid one = MakeLightGrid(Grey(1, 1, 90), {});
  EXPECT_TRUE(std::isfinite(
      AutomaticGain(one, MeasureLight(one), PlainBackdrop(1, 1), view, {1.5, {}}, 0.03)));
}

// A footage that grows darker from left to right, through a lens that stands aside: the gain by
// every pixel of the window through the lens' own formulas. 15 rays across instead of 401, and
// blocks of 5 px, are good to 1 %.
TEST(FootageLight, GainGoesByWhatTheScenesOwnLensShows) {
  const Backdrop backdrop = PlainBackdrop(480, 480);
  ColourImage footage(480, 480);
  const auto level = [](double x) { return std::lround(220 * std::exp(-x / 150)); };
  for (int y = 0; y < 480; ++y)
    for (int x = 0; x < 480; ++x)
      for (int c = 0; c < 3; ++c) footage.at(x, y)[c] = static_cast<std::uint8_t>(level(x));
  const LightGrid grid = MakeLightGrid(footage, {});
  const Lens lens = AsideLens();
  const simulation::ScopeOptics optics = simulation::OpticsOf({}, lens);
  const auto view = simulation::ViewFromPose({0.1, 0, 0, 0.02}, 0.2);
  const double reach = 0.0275;
  constexpr int kAcross = 401;
  double sum = 0, total = 0;
  for (int y = 0; y < kAcross; ++y)
    for (int x = 0; x < kAcross; ++x) {
      const auto ray = ReferenceRay(view, optics.field_of_view, kAcross, {x, y}, &lens);
      if (!ray) continue;
      const glm::dvec3 hit = *ReferenceSphereHit(view.tip, *ray, backdrop.radius);
      const auto pixel = ReferencePixel(backdrop.projection, hit);
      if (!pixel || pixel->x < 0 || pixel->y < 0 || pixel->x > 479 || pixel->y > 479) continue;
      const double away = glm::distance(hit, view.tip);
      const double r = std::hypot(x - 200.0, y - 200.0) / 200.5;
      const double light = reach * reach / (away * away + kLampRadius * kLampRadius);
      const double lit = LinearFromSrgb(static_cast<std::uint8_t>(level(pixel->x))) * light;
      sum += (1.25 - r * r) * lit * lit;
      total += 1.25 - r * r;
    }
  const FootageLight light = MeasureLight(grid);
  double metered = 0;
  for (int x = 0; x < 480; ++x)
    metered += std::pow(LinearFromSrgb(static_cast<std::uint8_t>(level(x))), 2) / 480;
  const double expected = std::sqrt(metered * total / sum);
  const double with = AutomaticGain(grid, light, backdrop, view, optics, reach);
  const double without =
      AutomaticGain(grid, light, backdrop, view, {optics.field_of_view, {}}, reach);
  std::printf("gain %.4f by every pixel, %.4f through the lens, %.4f through an equisolid one\n",
              expected, with, without);
  EXPECT_NEAR(with, expected, 0.01 * expected);
  EXPECT_GT(std::abs(without - expected), 0.1 * expected) << "an equisolid window is caught";
}

constexpr double kReach = 0.0275;  // m, for a backdrop of 50 mm
constexpr double kBallLuma = 0.5;

double LampWithoutGain(double distance) {
  return kReach * kReach / (distance * distance + kLampRadius * kLampRadius);
}

std::vector<float> Floats(const std::vector<glm::dvec3>& points) {
  std::vector<float> xyz;
  for (const glm::dvec3& x : points)
    for (int c = 0; c < 3; ++c) xyz.push_back(static_cast<float>(x[c]));
  return xyz;
}

// A ball before a backdrop with a bulge.
class BallScene {
 public:
  explicit BallScene(double ball_radius, bool has_bulge = true)
      : backdrop(PlainBackdrop(480, 480)),
        depth(480, 480, 0.0f),
        radius(ball_radius),
        ball(Ellipsoid(glm::dvec3(ball_radius), 96, 64)),
        footage(Grey(480, 480, 140)),
        has_relief(has_bulge) {
    for (int y = 0; y < 480; ++y)
      for (int x = 0; x < 480; ++x) {
        const double u = (x - 150) / 480.0, v = (y - 300) / 480.0;
        if (has_bulge)
          depth.at(x, y) = static_cast<float>(0.004 + 0.02 * std::exp(-40 * (u * u + v * v)));
      }
    grid = MakeLightGrid(footage, depth);
    light = MeasureLight(grid);
    xyz = Floats(ball.vertices);
  }

  double Gain(const simulation::ScopeView& view, const simulation::ScopeOptics& optics,
              const glm::dvec3& centre) {
    metered.Begin(view, optics);
    metered.Draw({xyz, ball.triangles, true, {centre, {1, 0, 0, 0}, 1.0}, kBallLuma});
    return AutomaticGain(grid, light, backdrop, view, optics, kReach, &metered);
  }

  // Reference over every pixel: sharp relief, searched in small steps, and a round ball.
  double GainByEveryPixel(const simulation::ScopeView& view, double field_of_view, const Lens* lens,
                          const glm::dvec3& centre) const {
    const int size = has_relief ? 71 : 201;
    double sum = 0, total = 0;
    for (int y = 0; y < size; ++y)
      for (int x = 0; x < size; ++x) {
        const auto ray = ReferenceRay(view, field_of_view, size, {x, y}, lens);
        if (!ray) continue;
        const double r = std::hypot(x - 0.5 * (size - 1), y - 0.5 * (size - 1)) / (0.5 * size);
        const auto hit = has_relief ? ReferenceReliefHit(backdrop, depth, view.tip, *ray)
                                    : ReferenceSphereHit(view.tip, *ray, backdrop.radius);
        double away = hit ? glm::distance(*hit, view.tip) : 1e9;
        const auto pixel = hit ? ReferencePixel(backdrop.projection, *hit) : std::nullopt;
        double lit = pixel && pixel->x > 0 && pixel->y > 0 && pixel->x < 479 && pixel->y < 479
                         ? light.metered * LampWithoutGain(away)
                         : -1;
        const glm::dvec3 to = centre - view.tip;
        const double foot = glm::dot(to, *ray);
        const double chord2 = radius * radius - (glm::dot(to, to) - foot * foot);
        if (foot > 0 && chord2 > 0 && foot - std::sqrt(chord2) < away) {
          away = foot - std::sqrt(chord2);
          const glm::dvec3 normal = (view.tip + away * *ray - centre) / radius;
          const double faces = -glm::dot(normal, *ray), t = std::min(faces / 0.75, 1.0);
          lit = kBallLuma * LampWithoutGain(away) * (0.745 + 0.255 * t * t * (3 - 2 * t)) *
                (0.12 + 0.88 * (faces + 0.3) / 1.3);
        }
        if (lit < 0) continue;
        sum += (1.25 - r * r) * lit * lit;
        total += 1.25 - r * r;
      }
    return light.metered / std::sqrt(sum / total);
  }

  Backdrop backdrop;
  DepthMap depth;
  double radius;
  SurfaceMesh ball;
  ColourImage footage;
  bool has_relief;
  LightGrid grid;
  FootageLight light;
  std::vector<float> xyz;
  MeteredModels metered;
};

class GainOfModels : public testing::TestWithParam<bool> {
 protected:
  Lens lens_ = AsideLens();
  simulation::ScopeOptics optics_ =
      GetParam() ? simulation::OpticsOf({}, lens_) : simulation::ScopeOptics{1.5, {}};
  const Lens* lens() const { return GetParam() ? &lens_ : nullptr; }
};
INSTANTIATE_TEST_SUITE_P(Lenses, GainOfModels, testing::Bool(), [](const auto& has) {
  return std::string(has.param ? "kannala_brandt" : "equisolid");
});

// Poses before and beside the bulge, with no ball and with one from 2 to 25 mm before the lens, in
// the middle and aside, in part behind the relief. A twentieth is less than a tenth of a stop.
TEST_P(GainOfModels, IsThatOfEveryPixel) {
  BallScene scene(0.006);
  struct Errors {
    int count = 0;
    double squares = 0, worst = 0;
    void Add(double gain, double expected) {
      const double off = std::abs(gain / expected - 1);
      ++count;
      squares += off * off;
      worst = std::max(worst, off);
    }
    void Print(const char* what) const {
      std::printf("gain, %d views%s: off by rms %.2f %%, at most %.2f %%\n", count, what,
                  100 * std::sqrt(squares / count), 100 * worst);
    }
  } bare, with, blind;
  std::vector<double> times;
  for (const double angle : {0.0, 30.0, 70.0})
    for (const double depth : {0.005, 0.018, 0.03}) {
      const auto view =
          simulation::ViewFromPose({0.15, -0.2, 0.3, depth}, RadiansFromDegrees(angle));
      const double gain_without =
          AutomaticGain(scene.grid, scene.light, scene.backdrop, view, optics_, kReach);
      const auto by_every_pixel = [&](const glm::dvec3& centre) {
        return scene.GainByEveryPixel(view, optics_.field_of_view, lens(), centre);
      };
      bare.Add(gain_without, by_every_pixel({0, 0, -1}));
      for (const double gap : {0.002, 0.006, 0.025})
        for (const double aside : {0.0, 0.008}) {
          const glm::dvec3 centre =
              view.tip + (gap + scene.radius) * view.view + aside * view.right;
          const double expected = by_every_pixel(centre);
          const auto start = std::chrono::steady_clock::now();
          with.Add(scene.Gain(view, optics_, centre), expected);
          const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
          times.push_back(took.count());
          blind.Add(gain_without, expected);
        }
    }
  bare.Print(" without a model");
  with.Print(" with one");
  blind.Print(" with one that is not seen");
  std::sort(times.begin(), times.end());
  std::printf("in %.2f ms (median; slowest %.2f) with %zu triangles\n",
              1e3 * times[times.size() / 2], 1e3 * times.back(), scene.ball.triangles.size());
  EXPECT_LT(bare.worst, 0.05);
  EXPECT_LT(with.worst, 0.05);
  EXPECT_GT(blind.worst, 1.0) << "a meter that does not see the model is caught";
}

// A ball that comes into the window from its side, 3 mm from the lens and far before the backdrop,
// by a fiftieth of a millimetre a step: each step is that of every pixel, to 3 %.
TEST_P(GainOfModels, StepsAsThatOfEveryPixelDoes) {
  BallScene scene(0.0015, false);
  const auto view = simulation::ViewFromPose({0, 0, 0, 0.01}, 0.0);
  double before = 0, before_expected = 0, greatest = 0, greatest_expected = 0, worst = 0;
  for (double aside = 0.0075; aside > 0.0; aside -= 0.00002) {
    const glm::dvec3 centre = view.tip + 0.0045 * view.view + aside * view.right;
    const double gain = scene.Gain(view, optics_, centre);
    const double expected = scene.GainByEveryPixel(view, optics_.field_of_view, lens(), centre);
    if (before > 0) {
      const double step = std::log(gain / before), true_step = std::log(expected / before_expected);
      greatest = std::max(greatest, std::abs(step));
      greatest_expected = std::max(greatest_expected, std::abs(true_step));
      worst = std::max(worst, std::abs(step - true_step));
    }
    before = gain;
    before_expected = expected;
  }
  std::printf("gain steps by at most %.2f %%, that of every pixel by %.2f, they differ by %.2f\n",
              100 * greatest, 100 * greatest_expected, 100 * worst);
  EXPECT_LT(before, 0.1);
  EXPECT_LT(worst, 0.03);
}

// Each place against the ball's own closed form; the mesh is flatter than the ball by 2 um.
TEST_P(GainOfModels, DistancesAreThoseOfTheBall) {
  BallScene scene(0.006);
  const auto view = simulation::ViewFromPose({0.1, 0.3, -0.5, 0.01}, RadiansFromDegrees(30));
  const glm::dvec3 centre = view.tip + 0.011 * view.view - 0.003 * view.up;
  scene.Gain(view, optics_, centre);
  int seen = 0, wrong = 0;
  double worst = 0;
  for (int j = 0; j < MeteredModels::kAcross; ++j)
    for (int i = 0; i < MeteredModels::kAcross; ++i) {
      const glm::vec2 place = MeteredModels::WindowPlace(i, j);
      const double found = scene.metered.at(i, j).distance;
      if (glm::dot(place, place) > 1) {
        EXPECT_EQ(found, 0);
        continue;
      }
      const glm::dvec3 ray = simulation::RayThrough(optics_, view, place), to = centre - view.tip;
      const double foot = glm::dot(to, ray);
      const double chord2 = scene.radius * scene.radius - (glm::dot(to, to) - foot * foot);
      const bool is_hit = foot > 0 && chord2 > 0;
      if (is_hit != (found > 0)) {
        ++wrong;
        EXPECT_LT(std::abs(chord2), 0.01 * scene.radius * scene.radius) << i << " " << j;
      } else if (is_hit && chord2 > 0.04 * scene.radius * scene.radius) {
        ++seen;
        worst = std::max(worst, std::abs(found - (foot - std::sqrt(chord2))));
      }
    }
  std::printf("%d places, off by at most %.4f mm; %d at the outline\n", seen, 1e3 * worst, wrong);
  EXPECT_GT(seen, 300);
  EXPECT_LT(wrong, 20);
  EXPECT_LT(worst, 0.05e-3);
}

class GainOfPictures : public ViewTest {};

// The whole of it, shaders and all: a ball that fills the window is drawn as bright as the footage
// was (a grey whose light is not bent by the shoulder), however near it is. The shine on it is not
// metered, so a seventh more is allowed; the rim's softness is taken back.
TEST_F(GainOfPictures, ABallIsAsBrightAsTheFootageWas) {
  Backdrop backdrop = PlainBackdrop(480, 480);
  backdrop.relight = 1;
  view_->SetBackdrop(Grey(480, 480, 90), DepthMap(480, 480, 0.001f), backdrop);
  const double footage = LinearFromSrgb(90);
  Tissue tissue;
  tissue.colour = glm::dvec3(0.6);
  const SurfaceMesh ball = Ellipsoid(glm::dvec3(0.02), 128, 96);
  const Picture picture = PictureFromPose({0, 0, 0, 0.001}, 0.0, 1.2);
  constexpr int kSize = 128;
  for (const double gap : {0.003, 0.006, 0.012}) {
    tissue.pose.position = picture.view.tip + (gap + 0.02) * picture.view.view;
    view_->SetTissues({&tissue, 1}, std::vector{Share(ball)});
    view_->Render(picture, kSize);
    const ColourImage drawn = view_->ReadPixels();
    double sum = 0, total = 0;
    for (int y = 0; y < kSize; ++y)
      for (int x = 0; x < kSize; ++x) {
        const double r = std::hypot(x - 63.5, y - 63.5) / 64;
        if (r > 0.95 || (r > 0.85 && y < 20)) continue;  // rim and mark
        const double t = std::clamp((r - 0.55) / 0.45, 0.0, 1.0);
        const double soft = 1 - 0.22 * t * t * (3 - 2 * t);
        const double linear = std::pow(drawn.at(x, y)[1] / 255.0 / soft, 2.2);
        sum += (1.25 - r * r) * linear * linear;
        total += 1.25 - r * r;
      }
    const double ratio = std::sqrt(sum / total) / footage;
    std::printf("ball %g mm away: %.3f times as bright as the footage\n", 1e3 * gap, ratio);
    EXPECT_NEAR(ratio, 1.0, 1.0 / 7);
  }
}

TEST(MeteredModels, WhatIsBehindOrNoNumberOrInsideOutIsNotSeen) {
  const auto view = simulation::ViewFromPose({0, 0, 0, 0.01}, 0.0);
  const simulation::ScopeOptics optics{1.5, {}};
  SurfaceMesh ball = Ellipsoid(glm::dvec3(0.004));
  const auto sees = [&](const SurfaceMesh& surface, const glm::dvec3& centre, bool is_closed) {
    MeteredModels metered;
    metered.Begin(view, optics);
    const std::vector<float> xyz = Floats(surface.vertices);
    metered.Draw({xyz, surface.triangles, is_closed, {centre, {1, 0, 0, 0}, 1.0}, 0.5});
    return !metered.empty();
  };
  EXPECT_TRUE(sees(ball, {0, 0, 0.02}, true));
  EXPECT_FALSE(sees(ball, {0, 0, 0.0}, true)) << "behind";
  EXPECT_FALSE(sees(ball, view.tip, true)) << "the lens is inside of it";
  EXPECT_TRUE(sees(ball, view.tip, false)) << "an open surface has two sides";
  EXPECT_FALSE(sees({}, {0, 0, 0.02}, false));
  SurfaceMesh broken = ball;
  for (glm::dvec3& x : broken.vertices) x.y = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(sees(broken, {0, 0, 0.02}, false));
  for (glm::dvec3& x : broken.vertices) x = {1e30, -1e30, 1e30};
  EXPECT_FALSE(sees(broken, {0, 0, 0.02}, false));
  for (glm::dvec3& x : broken.vertices) x = {0, 0, 0};
  EXPECT_FALSE(sees(broken, {0, 0, 0.02}, false)) << "all of it in one point";
}

// Earlier models leave no trace.
TEST(MeteredModels, BeginsAnew) {
  BallScene scene(0.004);
  const auto view = simulation::ViewFromPose({0, 0, 0, 0.01}, 0.0);
  const simulation::ScopeOptics optics{1.5, {}};
  const double far = scene.Gain(view, optics, {0, 0, -0.05});
  const double near = scene.Gain(view, optics, {0, 0, 0.02});
  EXPECT_LT(near, far);
  EXPECT_EQ(scene.Gain(view, optics, {0, 0, -0.05}), far);
}

}  // namespace
}  // namespace arthro::test
