// Living tissue on a thread of its own: what the three sides of it may do at the same time. Run it
// with the thread sanitizer too; on its own it sees only what tears or hangs.
#include <atomic>
#include <chrono>
#include <cmath>
#include <memory>
#include <thread>

#include <gtest/gtest.h>

#include "simulation/practice/tissue_loop.h"
#include "tests/simulation/tissue/body/slab_body.h"
#include "tests/support/ticks.h"

namespace arthro::simulation {
namespace {

using test::kTick;

// Pushes to 2 mm and leaves again, once a second, while it goes to and fro.
Instrumentation ProbeAt(const BodySpec& spec, double t) {
  const double depth = 2e-3 * std::sin(2.0 * std::numbers::pi * t);
  const double x = 3e-3 * std::sin(0.7 * std::numbers::pi * t);
  return {ToolKind::kProbe, test::ToolAbove(spec, ToolKind::kProbe, depth, x).now, {}};
}

TissueWorld SlabWorld(const BodySpec& spec, bool second_thread) {
  BodyOptions options;
  // A factor anew as often as can be, so that it is made beside many of the steps.
  options.refresh_iterations = 1;
  return TissueWorld({spec}, options, nullptr, second_thread);
}

bool IsWhole(const WorldPicture& picture) {
  for (const BodyPicture& body : picture.bodies) {
    if (body.positions.size() != body.skin->surface.vertices.size()) return false;
    if (body.normals.size() != body.positions.size()) return false;
    for (const glm::dvec3& x : body.positions)
      if (!std::isfinite(x.x + x.y + x.z)) return false;
  }
  return true;
}

TEST(TissueLoop, ServoAndPictureContinueDuringAStepAndItEndsWithinOne) {
  BodySpec spec = test::SlabBody();
  spec.is_cuttable = true;
  auto loop = std::make_unique<TissueLoop>(SlabWorld(spec, true), TissuePace::kThread);
  std::atomic<bool> is_over{false};
  int pictures = 0;
  bool were_whole = true;
  std::uint64_t last = 0;
  std::thread drawing([&] {
    while (!is_over.load()) {
      if (!loop->HasNew()) continue;
      const WorldPicture& picture = loop->Read();
      were_whole = were_whole && IsWhole(picture) && picture.step >= last;
      last = picture.step;
      ++pictures;
    }
  });
  // Ticks as fast as the tissue follows: time is that of the ticks, not of the machine.
  int couplings = 0, pushes = 0;
  ToolCoupling coupling;
  for (int tick = 0; tick < 2000; ++tick) {
    Instrumentation tool = ProbeAt(spec, tick * kTick);
    if (tick > 1000) tool.kind = ToolKind::kShaver;
    tool.now.is_running = true;
    loop->Tick(tool, kTick);
    if (loop->TakeCoupling(coupling)) {
      ++couplings;
      ASSERT_TRUE(IsFinite(coupling));
      if (coupling.count > 0) ++pushes;
    }
    std::this_thread::sleep_for(std::chrono::microseconds(500));
  }
  is_over.store(true);
  drawing.join();
  EXPECT_TRUE(were_whole);
  EXPECT_GT(pictures, 0);
  EXPECT_GT(couplings, 0);
  EXPECT_GT(pushes, 0);
  // A step is surely begun, and its end is not waited for here.
  while (loop->HasNew()) loop->Read();
  for (int tick = 0; tick < 40; ++tick) loop->Tick(ProbeAt(spec, 0.25), kTick);
  loop.reset();
}

TEST(TissueLoop, ResetDuringAStepRestoresTheTissue) {
  const BodySpec spec = test::SlabBody();
  TissueLoop loop(SlabWorld(spec, true), TissuePace::kThread);
  const std::vector<glm::dvec3> rest = loop.Read().bodies[0].positions;
  for (int tick = 0; tick < 300; ++tick) {
    loop.Tick(ProbeAt(spec, 0.25), kTick);
    std::this_thread::sleep_for(std::chrono::microseconds(200));
  }
  loop.Reset();
  ASSERT_TRUE(loop.HasNew());
  EXPECT_EQ(loop.Read().bodies[0].positions, rest);
}

TEST(TissueWorld, AFactorMadeOnASecondThreadGivesTheSameBits) {
  const BodySpec spec = test::SlabBody();
  TissueWorld one = SlabWorld(spec, false), two = SlabWorld(spec, true);
  WorldPicture picture_of_one, picture_of_two;
  int refreshes = 0, age = 0;
  for (int step = 0; step < 60; ++step) {
    const Instrumentation probe = ProbeAt(spec, step * test::kFrame);
    one.Step(probe, test::kFrame);
    two.Step(probe, test::kFrame);
    one.Show(picture_of_one);
    two.Show(picture_of_two);
    const int now = picture_of_one.bodies[0].report.factor_age;
    if (now < age) ++refreshes;
    age = now;
    ASSERT_EQ(picture_of_one.bodies[0].positions, picture_of_two.bodies[0].positions) << step;
    ASSERT_EQ(one.coupling().count, two.coupling().count) << step;
  }
  EXPECT_GT(refreshes, 0);
}

}  // namespace
}  // namespace arthro::simulation
