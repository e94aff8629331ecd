// Deformable tissue on a thread beside a ticking servo: nothing waits, no result is lost, and it
// may end or restart at any time.
#include "simulation/practice/tissue_loop.h"

#include <chrono>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <numbers>
#include <thread>
#include <utility>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "tests/simulation/tissue/body/meniscus_body.h"
#include "tests/support/ticks.h"

namespace arthro::simulation {
namespace {

using test::kTick;

TissueWorld World(const BodySpec& spec) { return {{spec}, {}, nullptr, true}; }

// Probe 1 mm deep in the middle of the top, or far above it.
Instrumentation Probe(const BodySpec& spec, bool is_in = true) {
  Instrumentation hand;
  hand.kind = ToolKind::kProbe;
  hand.now.is_present = true;
  hand.now.portal_from_tool =
      spec.portal_from_body * Rigid3{glm::angleAxis(std::numbers::pi, glm::dvec3(1, 0, 0)),
                                     {0.015, 0.0, is_in ? 0.00275 : 0.05}};
  return hand;
}

bool IsFinite(const WorldPicture& picture) {
  for (const glm::dvec3& x : picture.bodies[0].positions)
    if (!std::isfinite(x.x + x.y + x.z)) return false;
  return true;
}

int ThreadsOfThisProcess() {
  using Folder = std::filesystem::directory_iterator;
  return static_cast<int>(std::distance(Folder("/proc/self/task"), Folder()));
}

// Ticks as fast as possible until `is_done`, for at most five minutes as a bound against a hang.
template <class Done>
bool TickUntil(TissueLoop& loop, const Instrumentation& hand, Done&& is_done) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(5);
  while (std::chrono::steady_clock::now() < end) {
    loop.Tick(hand, kTick);
    if (is_done()) return true;
    std::this_thread::sleep_for(std::chrono::microseconds(50));
  }
  return false;
}

TEST(TissueLoop, ThreadPublishesCouplingsAndPictures) {
  const BodySpec spec = test::MeniscusBody({8, 2, 1});
  TissueLoop loop(World(spec), TissuePace::kThread);
  const std::vector<glm::dvec3> at_rest = loop.Read().bodies[0].positions;
  ASSERT_FALSE(at_rest.empty()) << "there before the first step";
  ToolCoupling coupling;
  std::uint64_t last = 0;
  int taken = 0;
  EXPECT_TRUE(TickUntil(loop, Probe(spec), [&] {
    if (!loop.TakeCoupling(coupling)) return false;
    EXPECT_GT(coupling.step, last) << "never one of before";
    last = coupling.step;
    return ++taken >= 20;
  })) << taken;
  EXPECT_GT(coupling.count, 0);
  EXPECT_TRUE(IsFinite(coupling));
  const glm::dvec3 up = spec.portal_from_body.rotation * glm::dvec3(0, 0, 1);
  EXPECT_GT(glm::dot(ForceOf(coupling, coupling.tip).force, up), 0.01) << "N, out of the tissue";
  EXPECT_TRUE(TickUntil(loop, Probe(spec), [&] { return loop.HasNew(); }));
  const WorldPicture& picture = loop.Read();
  EXPECT_GT(picture.step, 0u);
  EXPECT_NE(picture.bodies[0].positions, at_rest);
  EXPECT_TRUE(IsFinite(picture));
}

TEST(TissueLoop, ResetDuringAStepRestoresTheTissueAndStepsGoOn) {
  const BodySpec spec = test::MeniscusBody({8, 2, 1});
  TissueLoop loop(World(spec), TissuePace::kThread);
  const std::vector<glm::dvec3> at_rest = loop.Read().bodies[0].positions;
  ToolCoupling coupling;
  for (int round = 0; round < 3; ++round) {
    int taken = 0;
    ASSERT_TRUE(
        TickUntil(loop, Probe(spec), [&] { return (taken += loop.TakeCoupling(coupling)) > 3; }));
    // Another step is running now.
    for (int i = 0; i < 20; ++i) loop.Tick(Probe(spec), kTick);
    loop.Reset();
    EXPECT_EQ(loop.Read().bodies[0].positions, at_rest) << round;
  }
  int taken = 0;
  EXPECT_TRUE(TickUntil(loop, Probe(spec), [&] {
    return (taken += loop.TakeCoupling(coupling)) > 3;
  })) << "after a reset";
}

TEST(TissueLoop, EndsWhileItSteps) {
  const BodySpec spec = test::MeniscusBody({8, 2, 1});
  const int threads = ThreadsOfThisProcess();
  for (int ticks : {0, 17, 18, 40}) {
    {
      TissueLoop loop(World(spec), TissuePace::kThread);
      EXPECT_GT(ThreadsOfThisProcess(), threads) << ticks;
      for (int i = 0; i < ticks; ++i) loop.Tick(Probe(spec), kTick);
    }
    // A thread that was joined can stand in the table of processes for a moment.
    for (int i = 0; i < 1000 && ThreadsOfThisProcess() > threads; ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    EXPECT_EQ(ThreadsOfThisProcess(), threads) << ticks;
  }
}

TEST(TissueLoop, InlineStepsRunOncePerPeriodAndAreReproducible) {
  const BodySpec spec = test::MeniscusBody({8, 2, 1});
  TissueLoop one(World(spec), TissuePace::kInline), other(World(spec), TissuePace::kInline);
  ToolCoupling of_one, of_other;
  int taken = 0;
  for (int i = 0; i < 500; ++i) {
    const Instrumentation hand = Probe(spec, i < 300);
    one.Tick(hand, kTick);
    other.Tick(hand, kTick);
    const bool is_new = one.TakeCoupling(of_one);
    ASSERT_EQ(other.TakeCoupling(of_other), is_new);
    if (!is_new) continue;
    ++taken;
    ASSERT_EQ(of_one.count, of_other.count);
    ASSERT_EQ(ForceOf(of_one, of_one.tip).force, ForceOf(of_other, of_other.tip).force);
  }
  EXPECT_EQ(taken, 30) << "half a second at 60 steps per second";
}

TEST(TissueLoop, ASceneWithoutTissueRunsNoStep) {
  TissueLoop loop(TissueWorld({}, {}, nullptr, true), TissuePace::kThread);
  ToolCoupling coupling;
  for (int i = 0; i < 100; ++i) {
    loop.Tick({}, kTick);
    EXPECT_FALSE(loop.TakeCoupling(coupling));
  }
  loop.Reset();
  EXPECT_TRUE(loop.Read().bodies.empty());
}

}  // namespace
}  // namespace arthro::simulation
