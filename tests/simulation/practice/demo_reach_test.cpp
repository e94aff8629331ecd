// Reach of an instrument in the demo scene from the portal of the scene: it presses the
// posteromedial meniscus, lifts its free edge, bites and shaves it, and the shaft touches nothing
// on the way.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <numbers>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "simulation/core/units.h"
#include "simulation/practice/living_tissues.h"
#include "simulation/practice/replay/replay.h"
#include "simulation/practice/scripted_device.h"
#include "simulation/scene/files/scene_io.h"
#include "tests/support/build_paths.h"
#include "tests/support/ticks.h"

namespace arthro::simulation {
namespace {

using test::kTick;
constexpr int kMeniscus = 1;  // contact index of the first tissue of the scene
// N; upper limit of the force of surgeons (PMC3023859).
constexpr double kSafe = 8.5;

class DemoReach : public testing::Test {
 protected:
  DemoReach() : demo(LoadScene(std::filesystem::path(ARTHRO_SOURCE_DIR) / "resources/demo")) {
    presets =
        ReadTissuePresets(std::filesystem::path(ARTHRO_SOURCE_DIR) / "resources/presets/tissues");
    bodies = LivingTissues(demo, presets);
    layers = LayersOf(demo, presets);
    // Free edge at 55° from medial to posterior about the middle of the crescent; the plateau is
    // 0.3 mm below the middle of the edge.
    const Pose& pose = demo.scene.tissues[0].pose;
    const auto& skin = demo.surfaces[0]->vertices;
    constexpr double kAngle = 55.0 * std::numbers::pi / 180;
    glm::dvec3 out =
        glm::conjugate(pose.quaternion) * glm::dvec3(std::cos(kAngle), 0, std::sin(kAngle));
    out = glm::normalize(glm::dvec3(out.x, out.y, 0));
    glm::dvec3 edge(0);
    double nearest = std::numeric_limits<double>::infinity();
    for (const glm::dvec3& x : skin) {
      const glm::dvec2 level(x);
      const double radius = glm::length(level);
      if (radius > nearest || glm::dot(level, glm::dvec2(out)) < std::cos(0.035) * radius) continue;
      nearest = radius;
      edge = x;
    }
    for (std::size_t i = 0; i < skin.size(); ++i)
      if (glm::distance(skin[i], edge) < 4 * kMm) near_edge.push_back(i);
    outwards = pose.quaternion * out;
    up = pose.quaternion * glm::dvec3(0, 0, 1);
    under_edge = pose * (edge - glm::dvec3(0, 0, 0.3 * kMm));
  }

  LoadedScene demo;
  std::vector<TissuePreset> presets;
  std::vector<BodySpec> bodies;
  std::vector<LayerSpec> layers;
  std::vector<std::size_t> near_edge;   // vertices of the skin
  glm::dvec3 outwards, up, under_edge;  // portal frame; point on the plateau

  // Returns the height of the highest point of the free edge above its rest position, m.
  double Raised(const WorldPicture* world) const {
    double most = 0;
    for (const BodyPicture& body : world->bodies)
      if (body.tissue == 0)
        for (const std::size_t i : near_edge)
          most = std::max(most, body.positions[i].z - body.skin->surface.vertices[i].z);
    return most;
  }
};

// Hand at the portal of the instrument that moves at constant speed from point to point.
class Hand {
 public:
  Hand(const LoadedScene& demo, std::vector<BodySpec> bodies, std::vector<LayerSpec> layers,
       ToolKind kind)
      : session(demo),
        portal_(session.incision_spacing(), 0, 0),
        scope_(session.scope_rig()),
        instrument_(session.instrument_rig()) {
    session.Enliven(std::move(bodies), TissuePace::kInline, std::move(layers));
    session.SetInstrument(kind);
  }
  void Start(const glm::dvec3& tip, double roll) {
    tip_ = tip;
    roll_ = roll;
    Go(tip, roll, 0.3);
  }
  void Go(const glm::dvec3& tip, double roll, double seconds) {
    const glm::dvec3 tip_before = tip_;
    const double roll_before = roll_;
    const int ticks = static_cast<int>(std::lround(seconds / kTick));
    most_on_meniscus = peak = 0;
    for (int i = 1; i <= ticks; ++i) {
      const double s = static_cast<double>(i) / ticks;
      tip_ = tip_before + s * (tip - tip_before);
      roll_ = roll_before + s * (roll - roll_before);
      const glm::dvec3 rod = tip_ - portal_;
      instrument_.Set({std::atan2(-rod.y, std::hypot(rod.x, rod.z)), std::atan2(rod.x, rod.z),
                       roll_, glm::length(rod)});
      t_ += kTick;
      session.Tick(scope_.Sample(t_), instrument_.Sample(t_), kTick);
      session.TickTissues(kTick);
      const ToolState& tool = session.snapshot().instrument;
      EXPECT_EQ(tool.fault, Fault::kNone);
      peak = std::max(peak, glm::length(tool.tip_force));
      if (tool.contact == kMeniscus)
        most_on_meniscus = std::max(most_on_meniscus, glm::length(tool.tip_force));
    }
  }
  void Press(bool is_pressed) { instrument_.SetButtons(is_pressed ? 1u : 0u); }
  double Removed() {
    for (const BodyPicture& body : session.tissues()->bodies)
      if (body.tissue == 0) return body.cut.removed;
    return 0;
  }
  // Returns the roll at which +y of the tool is as close to this direction as the rod allows.
  double RollTowards(const glm::dvec3& tip, const glm::dvec3& way) const {
    const Rigid3 straight = PortalFromTool(portal_, tip, 0.0);
    const glm::dvec3 in_tool = glm::conjugate(straight.rotation) * way;
    // +y turns from north to east, which is the tool's −x (tool_shape.h).
    return std::atan2(-in_tool.x, in_tool.y);
  }
  // Horizontal direction of the rod towards `x`.
  glm::dvec3 WayOf(const glm::dvec3& x, const glm::dvec3& up) const {
    const glm::dvec3 rod = x - portal_;
    return glm::normalize(rod - glm::dot(rod, up) * up);
  }

  Session session;
  double most_on_meniscus = 0, peak = 0;  // N on the tip, of the last Go

 private:
  glm::dvec3 portal_;
  ScriptedDevice scope_, instrument_;
  glm::dvec3 tip_{0};
  double roll_ = 0, t_ = 0;
};

// The path of the shaft to the free edge is clear from the portal of the scene; from a more distant
// portal the shaft touches the anterior rim.
TEST_F(DemoReach, TheShaftLiesOnNothingWhileTheTipIsBesideTheFreeEdge) {
  for (const double spacing : {demo.scene.portals.incision_spacing, 0.03}) {
    LoadedScene scene = demo;
    scene.scene.portals.incision_spacing = spacing;
    Hand hand(scene, bodies, layers, ToolKind::kProbe);
    const glm::dvec3 beside = under_edge - 4.0 * kMm * outwards;
    hand.Start(beside + 5.0 * kMm * up, 0.0);
    hand.Go(beside + 1.0 * kMm * up, 0.0, 0.5);
    std::printf("from %.0f mm: %.2f N of the meniscus on the shaft\n", 1e3 * spacing,
                hand.most_on_meniscus);
    if (spacing < 0.03)
      EXPECT_EQ(hand.most_on_meniscus, 0.0);
    else
      EXPECT_GT(hand.most_on_meniscus, 0.1) << "or this test would not see a shaft on the rim";
  }
}

TEST_F(DemoReach, AHookLiftsTheFreeEdgeAndLetsItGoWhenDrawnIn) {
  Hand hand(demo, bodies, layers, ToolKind::kProbe);
  constexpr double kReach = 3.4 * kMm;  // m, distance of the hook from its rod
  const double level = hand.RollTowards(under_edge, outwards);
  // Distance of the hook's end past the edge; the direction of roll that lowers it depends on the
  // side of the rod.
  const glm::dvec3 rod = hand.WayOf(under_edge, up);
  const glm::dvec3 hook = glm::normalize(
      outwards - glm::dot(outwards, rod) * rod);  // approximate, since the rod is not level
  const double lower = glm::dot(glm::cross(rod, hook), up) > 0.0 ? -1.0 : 1.0;
  const auto at = [&](double past, double height) {
    return under_edge + past * kMm * outwards - kReach * hook + height * kMm * up;
  };
  const double dipped = level + lower * 0.6, lifting = level - lower * 0.17;
  hand.Start(at(-3.5, 5), dipped);
  hand.Go(at(-3.5, 0), dipped, 0.6);
  EXPECT_EQ(hand.most_on_meniscus, 0.0);
  hand.Go(at(3.2, 0), dipped, 1.0);
  hand.Go(at(3.2, 0), lifting, 0.5);
  double peak = hand.peak;
  hand.Go(at(3.2, 2), lifting, 1.0);
  peak = std::max(peak, hand.peak);
  hand.Go(at(3.2, 2), lifting, 0.5);
  const double held = Raised(hand.session.tissues());
  std::printf("the edge is %.2f mm up, held with %.2f N, %.2f N on the way\n", 1e3 * held,
              hand.peak, peak);
  EXPECT_EQ(hand.session.snapshot().instrument.contact, kMeniscus);
  EXPECT_GT(held, 2.0 * kMm);
  EXPECT_LT(std::max(peak, hand.peak), kSafe);
  // Rolled back, the hook leaves the edge, which returns to rest.
  hand.Go(at(-4.5, 2), lifting, 1.0);
  hand.Go(at(-4.5, 2), lifting, 0.5);
  EXPECT_EQ(hand.most_on_meniscus, 0.0);
  EXPECT_LT(Raised(hand.session.tissues()), 0.1 * kMm);
}

TEST_F(DemoReach, AProbePressesIt) {
  Hand hand(demo, bodies, layers, ToolKind::kProbe);
  // 4 mm past the edge the wedge is some 2 mm high.
  const glm::dvec3 place = under_edge + 4.0 * kMm * outwards;
  hand.Start(place + 5.0 * kMm * up, 0.0);
  EXPECT_EQ(hand.most_on_meniscus, 0.0);
  hand.Go(place + 1.0 * kMm * up, 0.0, 0.8);
  std::printf("pressed with %.2f N\n", hand.peak);
  EXPECT_GT(hand.most_on_meniscus, 0.1);
  EXPECT_LT(hand.peak, kSafe);
  hand.Go(place + 5.0 * kMm * up, 0.0, 0.5);
  hand.Go(place + 5.0 * kMm * up, 0.0, 0.3);
  EXPECT_EQ(hand.most_on_meniscus, 0.0);
}

TEST_F(DemoReach, AForcepsBitesTheFreeEdge) {
  Hand hand(demo, bodies, layers, ToolKind::kPunch);
  const glm::dvec3 way = hand.WayOf(under_edge, up);
  // The jaws of 6 mm open upwards; the lower one goes below the edge.
  hand.Start(under_edge - 6.0 * kMm * way + 5.0 * kMm * up, 0.0);
  hand.Go(under_edge - 3.0 * kMm * way + 1.0 * kMm * up, 0.0, 0.8);
  EXPECT_EQ(hand.most_on_meniscus, 0.0);
  hand.Go(under_edge + 3.5 * kMm * way + 0.7 * kMm * up, 0.0, 1.0);
  double peak = hand.peak;
  EXPECT_GT(hand.most_on_meniscus, 0.1);
  EXPECT_EQ(hand.Removed(), 0.0);
  hand.Press(true);
  hand.Go(under_edge + 3.5 * kMm * way + 0.7 * kMm * up, 0.0, 0.4);
  peak = std::max(peak, hand.peak);
  hand.Press(false);
  hand.Go(under_edge - 6.0 * kMm * way + 4.0 * kMm * up, 0.0, 0.8);
  const double bite = hand.Removed();
  std::printf("a bite of %.1f mm3 with %.2f N\n", 1e9 * bite, peak);
  // The window takes a capsule of 19 mm3; one pass must remove a fair part of it.
  EXPECT_GT(bite, 1e-9);
  EXPECT_LT(bite, 19e-9);
  EXPECT_LT(peak, kSafe);
}

TEST_F(DemoReach, AShaverTakesOfTheFreeEdge) {
  Hand hand(demo, bodies, layers, ToolKind::kShaver);
  const glm::dvec3 way = hand.WayOf(under_edge, up);
  // The window faces down to the edge.
  constexpr double kDown = std::numbers::pi;
  const glm::dvec3 over = under_edge + 3.0 * kMm * way;
  hand.Start(over + 5.0 * kMm * up, kDown);
  EXPECT_EQ(hand.most_on_meniscus, 0.0);
  hand.Go(over + 1.0 * kMm * up, kDown, 0.8);
  EXPECT_GT(hand.most_on_meniscus, 0.1);
  hand.Press(true);
  hand.Go(over + 1.0 * kMm * up, kDown, 1.0);
  const double peak = hand.peak;
  hand.Press(false);
  hand.Go(over + 5.0 * kMm * up, kDown, 0.5);
  const double taken = hand.Removed();
  std::printf("a second of shaving takes %.1f mm3 with %.2f N\n", 1e9 * taken, peak);
  EXPECT_GT(taken, 1e-9);
  EXPECT_LT(taken, 30e-9) << "30 mm3/s is all that it can";
  EXPECT_LT(peak, kSafe);
}

// The trace of `arthroscene demo` lifts the edge, and nothing lifts it earlier.
TEST_F(DemoReach, TheDemosOwnTraceLiftsTheFreeEdgeAndLetsItGo) {
  double lifted = 0, before = 0, after = 0, peak = 0;
  Replay(demo, {ReadTrace(demo.folder / "trace.csv"), {}}, {}, {}, nullptr, presets,
         [&](double t, const Snapshot& snapshot, const WorldPicture* world) {
           peak = std::max(peak, glm::length(snapshot.instrument.tip_force));
           if (!world) return;
           double& most = t < 8.0 ? before : t < 11.0 ? lifted : after;
           most = std::max(most, Raised(world));
         });
  std::printf("lifted by %.2f mm; before %.2f, after %.2f mm; at most %.2f N\n", 1e3 * lifted,
              1e3 * before, 1e3 * after, peak);
  EXPECT_LT(before, 0.5 * kMm) << "a press beside it bulges it";
  EXPECT_GT(lifted, 2.0 * kMm);
  EXPECT_LT(after, 0.1 * kMm);
  EXPECT_LT(peak, kSafe);
}

}  // namespace
}  // namespace arthro::simulation
