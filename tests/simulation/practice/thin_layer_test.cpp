// Cartilage without a mesh: a thin elastic layer that yields in the servo and shows a dent.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <random>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "simulation/core/error.h"
#include "simulation/practice/living_tissues.h"
#include "simulation/practice/session.h"
#include "simulation/scene/files/scene_io.h"
#include "simulation/tissue/cut/cutters.h"
#include "tests/simulation/practice/hand.h"
#include "tests/support/allocation_counter.h"
#include "tests/support/build_paths.h"
#include "tests/support/shapes.h"

namespace arthro::simulation {
namespace {

constexpr double kTip = 2.25e-3;      // m, round end of the shaver, which is in contact
constexpr double kLayerFace = 0.036;  // m, front of the tissue on the path of the instrument

// Scene with one tissue on the axis of the instrument.
LoadedScene LayerScene(const SurfaceMesh& surface, double scale = 1.0) {
  Tissue tissue;
  tissue.name = "plateau";
  tissue.material = "cartilage";
  tissue.pose.position = {0, 0, kLayerFace + 0.01};
  tissue.pose.scale = scale;
  return SceneOf(surface, tissue);
}
// A corner off the axis keeps the diagonal of the face away from the tip.
SurfaceMesh Block() { return test::Box({-0.013, -0.009, -0.01}, {0.011, 0.014, 0.01}); }

std::vector<TissuePreset> Presets() {
  return ReadTissuePresets(std::filesystem::path(ARTHRO_SOURCE_DIR) / "resources/presets/tissues");
}

struct LayerHand : Hand {
  explicit LayerHand(const LoadedScene& loaded, bool has_layers = true) : Hand(loaded) {
    if (has_layers) layers = LayersOf(loaded, Presets());
    session.Enliven({}, TissuePace::kInline, layers);
  }
  // Moves along the axis to a depth below the face, and holds.
  const ToolState& Press(double depth, int hold = 400) {
    return Lead({0, 0, kLayerFace + depth}, 400, hold);
  }
  std::vector<LayerSpec> layers;
};

TEST(ThinLayer, GivesTheForceOfTheSpringInSeriesWithItsClosedForm) {
  LayerHand hand(LayerScene(Block()));
  ASSERT_EQ(hand.layers.size(), 1u);
  hand.session.SetInstrument(ToolKind::kShaver);
  const ElasticLayer& layer = hand.layers[0].layer;
  double worst = 0;
  for (double depth : {0.02e-3, 0.1e-3, 0.3e-3, 1e-3, 2e-3, 4e-3, 12e-3}) {
    const ToolState& tool = hand.Press(depth);
    // Reference that is independent of the solver of the servo: bisection of the depth. Towards the
    // bone the force rises without bound (tool_on_layers.h).
    const auto force_at = [&](double sink) {
      const double way = sink / layer.thickness();
      return layer.PressBall(kTip, sink).force / (1 - way * way * way * way);
    };
    double low = 0, high = std::min(depth, 0.999 * layer.thickness());
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (low + high);
      (force_at(middle) < kSpring * (depth - middle) ? low : high) = middle;
    }
    const double force = kSpring * (depth - low);
    worst = std::max(worst, std::abs(-tool.tip_force.z - force));
    EXPECT_NEAR(-tool.tip_force.z, force, 1e-5) << depth;
    EXPECT_NEAR(tool.penetration, depth, 1e-8);
    EXPECT_NEAR(tool.proxy_in_portal.z, kLayerFace + low, 1e-8) << "the tool is drawn in the layer";
    EXPECT_EQ(tool.contact, 1);
    EXPECT_EQ(tool.layer, 0);
    EXPECT_EQ(tool.fault, Fault::kNone);
    EXPECT_EQ(tool.is_layer_deep, layer.PressBall(kTip, low).is_deep) << depth;
    std::printf("[ layer ] hand %.2f mm past the surface: %.4f N, tip %.3f mm in%s\n", 1e3 * depth,
                force, 1e3 * low, tool.is_layer_deep ? ", too deep for the theory" : "");
  }
  std::printf("[ layer ] largest difference from the closed form %.2g N\n", worst);
  EXPECT_TRUE(hand.session.snapshot().instrument.is_layer_deep);
  EXPECT_FALSE(hand.Press(-1e-3).is_layer_deep);
  EXPECT_EQ(hand.session.snapshot().instrument.tip_force, glm::dvec3(0.0));
}

TEST(ThinLayer, WithAWallBehindItTheSpringForceIsCountedOnce) {
  // The far corner of the slab is 1 mm in front of the backdrop; the tip passes its edge onto the
  // wall while the rod lies on the slab.
  LoadedScene loaded = LayerScene(test::Box({-0.02, 0.001, -0.02}, {0.02, 0.02, 0.0}));
  loaded.scene.backdrop.radius = 0.05;
  LayerHand hand(loaded);
  hand.session.SetInstrument(ToolKind::kShaver);
  hand.instrument.Set({0.05, 0, 0, 0.04});
  hand.Tick(500);
  for (int i = 1; i <= 2000; ++i) {
    hand.instrument.Set({0.05 - 0.09 * i / 2000, 0, 0, 0.04 + 0.0125 * i / 2000});
    hand.Tick();
  }
  const ToolState& tool = hand.Tick(1000);
  EXPECT_EQ(tool.layer, 0);
  EXPECT_GT(glm::length(tool.tip_force), 0.1);
  EXPECT_LT(glm::distance(tool.tip_force, kSpring * (tool.proxy_in_portal - tool.tip_in_portal)),
            1e-4);
  EXPECT_LT(glm::length(tool.proxy_in_portal), 0.05 + 1e-6) << "not in the wall";
}

// Pushes the scope of the demo scene past the edge of its cartilage and draws it back. Behind the
// edge its tube lies on the layer while its tip is in the backdrop's crevices: no place satisfies
// both.
TEST(ThinLayer, DoesNotPressTheScopeAgainstTheBackdropBehindItsEdge) {
  constexpr double kSpeed = 0.08;  // m/s
  const LoadedScene demo = LoadScene(std::filesystem::path(ARTHRO_SOURCE_DIR) / "resources/demo");
  LayerHand hand(demo);
  ASSERT_FALSE(hand.layers.empty());
  double beyond_proxy = 0;
  const auto go = [&](const RodPose& to) {
    const RodPose from = hand.scope.pose();
    const double way =
        0.03 * std::hypot(to.latitude - from.latitude, to.longitude - from.longitude) +
        std::abs(to.depth - from.depth);
    const int ticks = std::max(1, static_cast<int>(way / (kSpeed * kTick)));
    for (int i = 1; i <= ticks; ++i) {
      const double s = static_cast<double>(i) / ticks;
      hand.scope.Set({from.latitude + s * (to.latitude - from.latitude),
                      from.longitude + s * (to.longitude - from.longitude), 0,
                      from.depth + s * (to.depth - from.depth)});
      hand.Tick();
      const ToolState& scope = hand.session.snapshot().scope;
      const double off = glm::distance(scope.proxy_in_portal, scope.tip_in_portal);
      const double in_layer = scope.layer >= 0 ? scope.layer_depth : 0.0;
      beyond_proxy = std::max(beyond_proxy, scope.penetration - off - in_layer);
    }
  };
  std::mt19937 random(3);
  const auto within = [&random](double low, double high) {
    return low + (high - low) * static_cast<double>(random()) / std::mt19937::max();
  };
  for (int push = 0; push < 60; ++push) {
    const double latitude = within(-1.1, 0.6), longitude = within(-0.9, 0.9);
    const double to_latitude = std::clamp(latitude + within(-0.6, 0.6), -1.2, 1.0);
    const double to_longitude = longitude + within(-0.6, 0.6);
    go({latitude, longitude, 0, 0.015});
    go({latitude, longitude, 0, within(0.035, 0.055)});
    go({to_latitude, to_longitude, 0, within(0.035, 0.055)});
    go({to_latitude, to_longitude, 0, 0.012});
    hand.Tick(300);
    EXPECT_EQ(hand.session.snapshot().scope.tip_force, glm::dvec3(0.0)) << "push " << push;
  }
  std::printf("[ layer ] penetration beyond the proxy's offset %.3f mm\n", 1e3 * beyond_proxy);
  // The penetration is measured to the foot of the planes, the offset to the proxy. They differ by
  // the squeeze that is allowed, 0.5 mm, and by what the proxy is still on its way.
  EXPECT_LT(beyond_proxy, 1e-3);
}

TEST(ThinLayer, IsNeverStifferThanTheSpringFromTheFirstTouchOn) {
  LayerHand hand(LayerScene(Block()));
  hand.Press(-0.05e-3);
  constexpr double kStep = 1e-6;  // m per tick: 1 mm/s
  double last = 0, largest = 0;
  for (int i = 0; i < 600; ++i) {
    hand.instrument.Advance({0, 0, 0, kStep});
    const double force = -hand.Tick().tip_force.z;
    EXPECT_GE(force, 0.0);
    largest = std::max(largest, std::abs(force - last));
    last = force;
  }
  // Step of the spring, plus the viscosity that sets in over 0.1 mm: 1 mm/s · 1 Ns/m / 100.
  EXPECT_LE(largest, kSpring * (kStep + kSkin) + 1e-5);
  std::printf("[ layer ] largest step of force %.2g N in %.0f um steps, spring alone %.2g N\n",
              largest, 1e6 * kStep, kSpring * kStep);
  EXPECT_GT(last, 0.1);
}

TEST(ThinLayer, ALayerDoesNotChangeTheForceOfAnotherTissue) {
  // Block 1 is a layer, block 2 beside it is not; pressing 2 gives the same bits.
  LoadedScene loaded = LayerScene(Block());
  loaded.scene.tissues.push_back(loaded.scene.tissues[0]);
  loaded.scene.tissues[0].pose.position.x += 0.05;
  loaded.scene.tissues[1].material = "no preset has this name";
  loaded.surfaces.push_back(Share(Block()));
  LayerHand with(loaded), without(loaded, false);
  ASSERT_EQ(with.layers.size(), 1u);
  for (int i = 0; i < 1500; ++i) {
    const double s = i * kTick;
    const RodPose pose{0.03 * std::sin(5 * s), 0.03 * std::sin(7 * s), s,
                       kLayerFace - 5e-4 + 1e-3 * s};
    with.instrument.Set(pose);
    without.instrument.Set(pose);
    const ToolState &a = with.Tick(), &b = without.Tick();
    ASSERT_EQ(a.tip_force, b.tip_force) << i;
    ASSERT_EQ(a.proxy_in_portal, b.proxy_in_portal);
    ASSERT_EQ(a.tissue_tip_in_portal, b.tissue_tip_in_portal);
  }
  EXPECT_EQ(with.session.snapshot().instrument.contact, 2);
}

TEST(ThinLayer, ACurvedLayerGivesNoJumpsAcrossItsTriangles) {
  // The tip slides over a condyle of 10 mm radius in facets of 0.5 mm, at a depth of 1 mm.
  LayerHand soft(LayerScene(test::Sphere({0, 0, 0}, 0.01, 4)));
  LayerHand rigid(LayerScene(test::Sphere({0, 0, 0}, 0.01, 4)), false);
  double jump[2] = {0, 0};
  for (LayerHand* hand : {&soft, &rigid}) {
    hand->Press(1e-3);
    glm::dvec3 last = hand->Tick().tip_force;
    for (int i = 0; i < 1000; ++i) {
      hand->instrument.Advance({0, 1e-4, 0, 0});
      const glm::dvec3 force = hand->Tick().tip_force;
      double& most = jump[hand == &soft ? 0 : 1];
      most = std::max(most, glm::length(force - last));
      last = force;
    }
  }
  std::printf("[ layer ] largest step of force over facets: %.3g N, rigid %.3g N\n", jump[0],
              jump[1]);
  EXPECT_LE(jump[0], jump[1]) << "softer, so no rougher";
}

TEST(ThinLayer, AServoTickInContactAllocatesNothing) {
  LayerHand hand(LayerScene(Block()));
  hand.Press(0.5e-3);
  const long before = test::Allocations();
  for (int i = 0; i < 1000; ++i) {
    hand.t += kTick;
    hand.instrument.Advance({0, 0, 0, i % 2 == 0 ? 3e-4 : -3e-4});
    hand.session.Tick(hand.scope.Sample(hand.t), hand.instrument.Sample(hand.t), kTick);
  }
  EXPECT_EQ(test::Allocations(), before);
}

TEST(ThinLayer, DentsUnderTheToolAndRecovers) {
  const LoadedScene loaded = LayerScene(test::Sphere({0, 0, 0}, 0.005, 5), 2.0);
  LayerHand hand(loaded);
  hand.session.SetInstrument(ToolKind::kShaver);
  const WorldPicture* world = hand.session.tissues();
  ASSERT_NE(world, nullptr);
  ASSERT_EQ(world->bodies.size(), 1u);
  EXPECT_EQ(world->bodies[0].tissue, 0);
  EXPECT_TRUE(world->bodies[0].report.is_asleep);
  const auto rest = world->bodies[0].positions;
  const auto rest_normals = world->bodies[0].normals;
  const std::uint64_t shape = world->bodies[0].shape;
  EXPECT_NEAR(glm::length(rest[0]), 0.01, 1e-12) << "the scale is applied";
  hand.Press(-1e-3);
  EXPECT_EQ(hand.session.tissues()->bodies[0].shape, shape) << "nothing touched, nothing computed";

  const ToolState tool = hand.Press(2e-3);
  const double sink = tool.proxy_in_portal.z - kLayerFace;
  const BodyPicture pressed = hand.session.tissues()->bodies[0];
  EXPECT_FALSE(pressed.report.is_asleep);
  ASSERT_GT(sink, 2e-4);
  // The drawn tool contains no part of the surface, and the rest of the surface is not pressed
  // deeper.
  std::array<Capsule, kMaxCapsules> capsules;
  ToolInput drawn{true, PortalFromTool({0, 0, 0}, tool.proxy_in_portal, tool.pose.roll), 1, false};
  const int count = PosedCapsules(ShapeOf(ToolKind::kShaver), drawn, capsules);
  double deepest = 0, worst_inside = 0, steepest = 0;
  const glm::dvec3 origin = loaded.scene.tissues[0].pose.position;
  for (std::size_t v = 0; v < rest.size(); ++v) {
    deepest = std::max(deepest, glm::distance(pressed.positions[v], rest[v]));
    for (int i = 0; i < count; ++i) {
      const Capsule& c = capsules[static_cast<std::size_t>(i)];
      const glm::dvec3 axis = c.b - c.a, x = origin + pressed.positions[v];
      const double s = std::clamp(glm::dot(x - c.a, axis) / glm::dot(axis, axis), 0.0, 1.0);
      worst_inside = std::max(worst_inside, c.radius - glm::distance(x, c.a + s * axis));
    }
  }
  EXPECT_LT(worst_inside, 1e-7) << "the exit is found to 40 nm";
  EXPECT_GT(deepest, 0.9 * sink) << "a vertex each 0.3 mm";
  EXPECT_LT(deepest, sink + 2e-6);
  // The rim is smooth: no edge turns by more than the slope of the ball's flank there.
  for (const auto& triangle : loaded.surfaces[0]->triangles)
    for (int k = 0; k < 3; ++k) {
      const auto a = static_cast<std::size_t>(triangle[static_cast<std::size_t>(k)]);
      const auto b = static_cast<std::size_t>(triangle[static_cast<std::size_t>((k + 1) % 3)]);
      const double da = glm::distance(pressed.positions[a], rest[a]);
      const double db = glm::distance(pressed.positions[b], rest[b]);
      steepest = std::max(steepest, std::abs(da - db) / glm::distance(rest[a], rest[b]));
    }
  const double flank = std::sqrt(2 * kTip * sink - sink * sink) / (kTip - sink);
  std::printf("[ layer ] sink %.3f mm, deepest vertex %.3f mm, steepest %.2f of a flank of %.2f\n",
              1e3 * sink, 1e3 * deepest, steepest, flank);
  EXPECT_LT(steepest, flank);

  hand.Press(-1e-3);
  const BodyPicture& free = hand.session.tissues()->bodies[0];
  EXPECT_TRUE(free.report.is_asleep);
  EXPECT_EQ(free.positions, rest);
  EXPECT_EQ(free.normals, rest_normals);
}

TEST(ThinLayer, NoPartOfAToolThatLiesOnItIsDrawnDeeperThanItsDent) {
  // A condyle of 10 mm beside the rod is pressed by shaft, frame or hook, far behind the tip.
  for (const ToolKind kind : {ToolKind::kPunch, ToolKind::kProbe, ToolKind::kShaver}) {
    LoadedScene loaded = LayerScene(test::Sphere({0, 0, 0}, 0.01, 5));
    loaded.scene.tissues[0].pose.position = {0, 0.0105, 0.032};
    LayerHand hand(loaded);
    hand.session.SetInstrument(kind);
    const glm::dvec3 origin = loaded.scene.tissues[0].pose.position;
    const auto rest = hand.session.tissues()->bodies[0].positions;
    double worst_inside = 0, deepest = 0, least_force = 1e9;
    for (int i = 0; i <= 200; ++i) {
      hand.instrument.Set({-0.0015 * std::min(i, 100), 0, 0.05 * i, 0.038});
      const ToolState tool = hand.Tick(50);
      if (i < 100) continue;
      least_force = std::min(least_force, glm::length(tool.tip_force));
      const BodyPicture& shown = hand.session.tissues()->bodies[0];
      std::array<Capsule, kMaxCapsules> capsules;
      const ToolInput drawn{true, PortalFromTool({0, 0, 0}, tool.proxy_in_portal, tool.pose.roll),
                            tool.opening, false};
      const int count = PosedCapsules(ShapeOf(kind), drawn, capsules);
      for (std::size_t v = 0; v < rest.size(); ++v) {
        deepest = std::max(deepest, glm::distance(shown.positions[v], rest[v]));
        for (int c = 0; c < count; ++c) {
          const Capsule& part = capsules[static_cast<std::size_t>(c)];
          worst_inside = std::max(worst_inside, -DistanceToCapsule(origin + shown.positions[v],
                                                                   part.a, part.b, part.radius));
        }
      }
    }
    std::printf(
        "[ layer ] %s: dent of %.3f mm at most, a vertex of it %.4f mm in the tool, force "
        "%.2f N at least\n",
        kind == ToolKind::kPunch   ? "punch"
        : kind == ToolKind::kProbe ? "probe"
                                   : "shaver",
        1e3 * deepest, 1e3 * worst_inside, least_force);
    EXPECT_GT(least_force, 0.1);
    // The picture is up to 1/60 s behind, so this compares at a resting hand.
    EXPECT_LT(worst_inside, 2e-6);
    EXPECT_LT(deepest, 2.5e-3);
  }
}

TEST(ThinLayer, UsesTheValuesThatTheSceneOverrides) {
  LoadedScene loaded = LayerScene(Block());
  loaded.scene.tissues[0].elasticity.layer_thickness = 1e-3;
  loaded.scene.tissues[0].elasticity.young_modulus = 3e6;
  const auto thin = LayersOf(loaded, Presets());
  ASSERT_EQ(thin.size(), 1u);
  EXPECT_EQ(thin[0].layer.thickness(), 1e-3);
  Material material = FindTissuePreset(Presets(), "cartilage")->material;
  material.young_modulus = 3e6;
  EXPECT_EQ(thin[0].layer.foundation(), ElasticLayer(material, 1e-3).foundation());

  loaded.scene.tissues[0].mesh = "plateau.vtu";
  EXPECT_TRUE(LayersOf(loaded, Presets()).empty()) << "it is a body";
  loaded.scene.tissues[0].mesh.clear();
  loaded.scene.tissues[0].material = "meniscus";
  EXPECT_TRUE(LayersOf(loaded, Presets()).empty()) << "thick, and rigid";
  loaded.scene.tissues[0].material = "cartilage";
  loaded.scene.tissues[0].elasticity.layer_thickness = 0.0;
  try {
    LayersOf(loaded, Presets());
    FAIL() << "a layer of no thickness";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("plateau"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace arthro::simulation
