// All tissues of a scene under a random hand: the same bits with and without the second thread, and
// no allocation after warm-up.
#include "simulation/tissue/body/tissue_world.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "tests/simulation/tissue/body/meniscus_body.h"
#include "tests/simulation/tissue/body/random_hand.h"
#include "tests/simulation/tissue/body/slab_body.h"
#include "tests/support/allocation_counter.h"

namespace arthro::simulation {
namespace {

using test::kFrame;

// Refreshes the preconditioner as often as possible.
BodyOptions Restless() {
  BodyOptions options;
  options.refresh_iterations = 1;
  return options;
}

bool AreSame(const ToolCoupling& a, const ToolCoupling& b) {
  if (a.step != b.step || a.count != b.count || a.is_faulty != b.is_faulty) return false;
  for (std::size_t i = 0; i < static_cast<std::size_t>(a.count); ++i)
    if (a.contact[i].rub != b.contact[i].rub || a.contact[i].normal != b.contact[i].normal ||
        a.contact[i].stiffness != b.contact[i].stiffness ||
        a.contact[i].depth != b.contact[i].depth || a.contact[i].power != b.contact[i].power ||
        a.contact[i].curvature != b.contact[i].curvature)
      return false;
  return true;
}

TEST(TissueWorld, SecondThreadChangesNoBit) {
  const BodySpec spec = test::MeniscusBody({8, 2, 1});
  TissueWorld alone({spec}, Restless(), nullptr, false);
  TissueWorld beside({spec}, Restless(), nullptr, true);
  test::RandomHand hand(11, spec.portal_from_body);
  WorldPicture of_alone, of_beside;
  int touched = 0, cuts = 0, youngest = 1000;
  for (int step = 0; step < 900; ++step) {
    const Instrumentation now = hand.Next(kFrame);
    alone.Step(now, kFrame);
    beside.Step(now, kFrame);
    alone.Show(of_alone);
    beside.Show(of_beside);
    ASSERT_TRUE(AreSame(alone.coupling(), beside.coupling())) << step;
    ASSERT_EQ(of_alone.bodies[0].positions, of_beside.bodies[0].positions) << step;
    ASSERT_EQ(of_alone.bodies[0].cut.removed, of_beside.bodies[0].cut.removed) << step;
    const BodyReport& report = of_alone.bodies[0].report;
    ASSERT_FALSE(report.was_reset) << step;
    touched += report.contacts > 0;
    cuts += report.was_cut;
    if (!report.is_asleep && step > 300) youngest = std::min(youngest, report.factor_age);
    if (step == 600) alone.Reset(), beside.Reset();
  }
  std::printf("%d steps touched, %d cuts, youngest factor %d steps\n", touched, cuts, youngest);
  EXPECT_GT(touched, 90) << "the comparison needs touched steps";
  EXPECT_GT(cuts, 0);
  EXPECT_LT(youngest, 10) << "factors were refreshed";
}

// However a hand moves, jumps and cuts, no step does much more than its share of work; before, one
// of a thousand did five times as much.
TEST(TissueWorld, NoStepDoesMuchMoreThanItsWork) {
  const BodySpec spec = test::MeniscusBody({8, 2, 1});
  const BodyOptions options;
  TissueWorld world({spec}, options, nullptr, false);
  test::RandomHand hand(11, spec.portal_from_body);
  WorldPicture picture;
  int most = 0, ended = 0, touched = 0;
  for (int step = 0; step < 1200; ++step) {
    world.Step(hand.Next(kFrame), kFrame);
    world.Show(picture);
    const BodyReport& report = picture.bodies[0].report;
    ASSERT_FALSE(report.was_reset) << step;
    most = std::max(most, report.step.work);
    ended += report.step.work >= options.solver.max_work;
    touched += report.contacts > 0;
  }
  std::printf("most work %d of %d; %d of %d touched steps ended early\n", most,
              options.solver.max_work, ended, touched);
  EXPECT_GT(ended, 0) << "the hand is too gentle for this test";
  // The last Newton iteration may begin just before the end, and may need a new factor: 16 for its
  // tangent, 36 for the factor, 6 at least for its system.
  EXPECT_LT(most, options.solver.max_work + 16 + 36 + 6);
}

TEST(TissueWorld, ResetWorldContinuesLikeANewOne) {
  const BodySpec spec = test::MeniscusBody({8, 2, 1});
  TissueWorld used({spec}, {}, nullptr, true);
  test::RandomHand before(11, spec.portal_from_body);
  for (int step = 0; step < 300; ++step) used.Step(before.Next(kFrame), kFrame);
  used.Reset();
  // The hand has let go: the memory of held tools is cleared, too.
  TissueWorld fresh({spec}, {}, nullptr, true);
  test::RandomHand one(5, spec.portal_from_body), other(5, spec.portal_from_body);
  WorldPicture of_used, of_fresh;
  for (int step = 0; step < 300; ++step) {
    used.Step(one.Next(kFrame), kFrame);
    fresh.Step(other.Next(kFrame), kFrame);
    used.Show(of_used);
    fresh.Show(of_fresh);
    ASSERT_EQ(of_used.bodies[0].positions, of_fresh.bodies[0].positions) << step;
  }
}

TEST(TissueWorld, StepsAllocateNothingAfterWarmUp) {
  const BodySpec spec = test::MeniscusBody({8, 2, 1});
  for (const bool has_thread : {false, true}) {
    TissueWorld world({spec}, Restless(), nullptr, has_thread);
    WorldPicture picture;
    const auto steps = [&](int count) {
      long allocations = 0;
      int touched = 0;
      for (int i = 0; i < count; ++i) {
        // Probe that strokes over the body's middle, 1 mm deep.
        Instrumentation hand;
        hand.kind = ToolKind::kProbe;
        hand.now.is_present = true;
        hand.now.portal_from_tool =
            spec.portal_from_body * Rigid3{glm::angleAxis(std::numbers::pi, glm::dvec3(1, 0, 0)),
                                           {0.015, 0.002 * std::sin(0.2 * i), 0.00375 - 0.001}};
        const long before = test::Allocations();
        world.Step(hand, kFrame);
        allocations += test::Allocations() - before;
        world.Show(picture);
        touched += picture.bodies[0].report.contacts > 0;
      }
      EXPECT_EQ(touched, count);
      return allocations;
    };
    EXPECT_GT(steps(90), 0) << "the first factors";
    EXPECT_EQ(steps(90), 0) << (has_thread ? "two threads" : "one thread");
    EXPECT_LT(picture.bodies[0].report.factor_age, 20) << "factors were refreshed meanwhile";
  }
}

}  // namespace
}  // namespace arthro::simulation
