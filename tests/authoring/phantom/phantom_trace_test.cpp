// The scripted hands move smoothly and touch their targets only.
#include <cmath>
#include <cstdio>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "authoring/phantom/phantom.h"
#include "simulation/scope/rod_pose.h"

namespace arthro::authoring {
namespace {

using simulation::RodPose;
const double kSpacing = Phantom().incision_spacing;

struct Tips {
  std::vector<double> t;
  std::vector<RodPose> scope, instrument;
  std::vector<glm::dvec3> scope_tip, instrument_tip;
};

// Conversion as in a session: the hand's position and orientation to the rod's pose.
Tips TipsOf(const std::vector<TraceRow>& rows) {
  Tips tips;
  const DeviceRig rig;
  RodPose scope, instrument;
  for (const TraceRow& row : rows) {
    RodPose& pose = row.is_scope ? scope : instrument;
    pose = simulation::RodPoseFromHip(row.hip_in_device, row.handle_in_device, rig, pose);
    if (row.is_scope) {
      tips.t.push_back(row.t);
      tips.scope.push_back(pose);
      tips.scope_tip.push_back(simulation::TipInOwnPortal(pose));
    } else {
      tips.instrument.push_back(pose);
      tips.instrument_tip.push_back(glm::dvec3(kSpacing, 0, 0) + simulation::TipInOwnPortal(pose));
    }
  }
  return tips;
}

class EveryTrace : public testing::TestWithParam<int> {
 protected:
  const Cavity cavity = MakeCavity(static_cast<std::uint32_t>(GetParam()));
  const PhantomTissue meniscus = MakeMeniscus(cavity);
  const std::vector<TraceRow> rows = MakeTrace(cavity, meniscus, kSpacing);
  const Tips tips = TipsOf(rows);
};

TEST_P(EveryTrace, Runs12SecondsAt100Hertz) {
  ASSERT_EQ(rows.size(), 2402u);
  EXPECT_NEAR(rows.back().t, 12.0, 1e-9);
  for (const TraceRow& row : rows) EXPECT_NEAR(glm::length(row.handle_in_device), 1.0, 1e-9);
}

TEST_P(EveryTrace, MovesSmoothly) {
  double fastest = 0, sharpest = 0;
  for (const auto* path : {&tips.scope_tip, &tips.instrument_tip})
    for (std::size_t i = 1; i + 1 < path->size(); ++i) {
      fastest = std::max(fastest, glm::distance((*path)[i], (*path)[i - 1]) * 100.0);
      sharpest =
          std::max(sharpest, glm::length((*path)[i + 1] - 2.0 * (*path)[i] + (*path)[i - 1]) * 1e4);
    }
  std::printf("fastest %.0f mm/s, largest acceleration %.2f m/s2\n", fastest * 1e3, sharpest);
  EXPECT_LT(fastest, 0.15);  // a careful hand
  EXPECT_LT(sharpest, 1.5);
}

TEST_P(EveryTrace, ScopeStaysInFreeSpace) {
  for (std::size_t i = 0; i < tips.t.size(); ++i)
    EXPECT_GT(Clearance(cavity, tips.scope_tip[i]), 1e-3) << "t = " << tips.t[i];
}

TEST_P(EveryTrace, ScopeRollsMoreThanOneTurn) {
  double low = 0, high = 0;
  for (const RodPose& pose : tips.scope)
    low = std::min(low, pose.roll), high = std::max(high, pose.roll);
  EXPECT_GT(high - low, 2 * M_PI);
}

TEST_P(EveryTrace, InstrumentTouchesBackdropOnlyWhenMeantTo) {
  const auto contacts = ProbeContacts(cavity, meniscus);
  ASSERT_EQ(contacts.size(), 3u);
  const EdgeLift lift = LiftOfEdge(cavity);
  for (std::size_t i = 0; i < tips.t.size(); ++i) {
    const double clearance = Clearance(cavity, tips.instrument_tip[i]);
    bool meant = false;
    for (const ProbeContact& touch : contacts)
      meant = meant || (tips.t[i] > touch.from_t && tips.t[i] < touch.to_t);
    meant = meant || (tips.t[i] > lift.from_t && tips.t[i] < lift.to_t);
    EXPECT_GT(clearance, meant ? -2.5e-3 : 0.3e-3) << "t = " << tips.t[i];
  }
}

TEST_P(EveryTrace, ProbePressesCondyleAndPlateau) {
  const auto contacts = ProbeContacts(cavity, meniscus);
  for (std::size_t k = 0; k < 2; ++k) {
    double deepest = 1;
    for (std::size_t i = 0; i < tips.t.size(); ++i)
      if (tips.t[i] > contacts[k].from_t && tips.t[i] < contacts[k].to_t)
        deepest = std::min(deepest, Clearance(cavity, tips.instrument_tip[i]));
    EXPECT_LT(deepest, -1e-3) << "touch " << k;
  }
}

TEST_P(EveryTrace, ProbePressesIntoTheMeniscusAndOutAgain) {
  const ProbeContact touch = ProbeContacts(cavity, meniscus)[2];
  double deepest = 1;
  for (std::size_t i = 0; i < tips.t.size(); ++i)
    if (tips.t[i] > touch.from_t && tips.t[i] < touch.to_t)
      deepest =
          std::min(deepest, glm::dot(tips.instrument_tip[i] - touch.x_in_portal, touch.normal));
  EXPECT_NEAR(deepest, -touch.press, 0.1e-3);
}

INSTANTIATE_TEST_SUITE_P(Seeds, EveryTrace, testing::Values(0, 1, 2, 3, 4, 5, 17, 99));

}  // namespace
}  // namespace arthro::authoring
