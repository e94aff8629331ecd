#include "simulation/training/observe/frame_builder.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/simulation/training/simulated_attempt.h"

namespace arthro::simulation {
namespace {

using test::FramesOf;
using test::ToolAt;

Snapshot Both(const ToolState& tool) {
  Snapshot snapshot;
  snapshot.scope = snapshot.instrument = tool;
  return snapshot;
}

TEST(FrameBuilder, FrameHoldsTheMeanOfItsTicks) {
  const auto frames = FramesOf(0.05, 1000, [](double t) {
    ToolState state = ToolAt({0.01 * t, 0, 0.02});
    state.tip_force = {0, 0, t};
    return Both(state);
  });
  ASSERT_EQ(frames.size(), 5U);
  for (std::size_t k = 0; k < frames.size(); ++k) {
    const ToolFrame& tool = frames[k].tool[0];
    // Ticks at 10 k + 1 … 10 k + 10 ms have their mean at 10 k + 5.5 ms.
    const double middle = 0.01 * static_cast<double>(k) + 0.0055;
    EXPECT_NEAR(tool.tip.x, 0.01 * middle, 1e-9);
    EXPECT_NEAR(tool.mean_force, middle, 1e-7);
    EXPECT_NEAR(tool.peak_force, 0.01 * static_cast<double>(k + 1), 1e-7);
    EXPECT_TRUE(tool.is_inside());
  }
}

TEST(FrameBuilder, LongTicksWeighMore) {
  FrameBuilder builder(0.0);
  builder.Add(0.008, Both(ToolAt({0, 0, 0.01})));
  builder.Add(0.010, Both(ToolAt({0, 0, 0.02})));
  builder.Finish();
  ASSERT_EQ(builder.frames().size(), 1U);
  EXPECT_NEAR(builder.frames()[0].tool[0].tip.z, 0.012, 1e-9);
}

TEST(FrameBuilder, FrameWithoutATickIsNotValid) {
  FrameBuilder builder(2.0);
  builder.Add(2.01, Both(ToolAt({0, 0, 0.01})));
  builder.Add(2.05, Both(ToolAt({0, 0, 0.01})));
  builder.Finish();
  ASSERT_EQ(builder.frames().size(), 5U);
  for (std::size_t k = 0; k < 5; ++k)
    EXPECT_EQ(builder.frames()[k].tool[1].is_valid, k == 0 || k == 4) << k;
}

TEST(FrameBuilder, FaultOfTheDeviceMakesItsToolUnknown) {
  for (const auto& [fault, is_known] : {std::pair{Fault::kNone, true},
                                        {Fault::kNotArmed, true},
                                        {Fault::kTissue, true},
                                        {Fault::kNoSample, false},
                                        {Fault::kStale, false},
                                        {Fault::kLost, false},
                                        {Fault::kNotFinite, false},
                                        {Fault::kTooFar, false},
                                        {Fault::kTooFast, false}}) {
    FrameBuilder builder(0.0);
    for (int i = 1; i <= 10; ++i) {
      Snapshot snapshot = Both(ToolAt({0, 0, 0.01}));
      if (i == 4) snapshot.instrument.fault = fault;
      builder.Add(0.001 * i, snapshot);
    }
    builder.Finish();
    EXPECT_EQ(builder.frames()[0].tool[1].is_valid, is_known) << ToString(fault);
    EXPECT_TRUE(builder.frames()[0].tool[0].is_valid) << ToString(fault);
  }
}

TEST(FrameBuilder, LongestContactIsNamed) {
  FrameBuilder builder(0.0);
  for (int i = 1; i <= 10; ++i) {
    Snapshot snapshot = Both(ToolAt({0, 0, 0.01}));
    snapshot.instrument.contact = i <= 2 ? kNoContact : i <= 5 ? kBackdropContact : 3;
    builder.Add(0.001 * i, snapshot);
  }
  builder.Finish();
  EXPECT_EQ(builder.frames()[0].tool[1].contact, 3);
  EXPECT_NEAR(builder.frames()[0].tool[1].contact_share, 0.5, 1e-6);
  EXPECT_EQ(builder.frames()[0].tool[0].contact, kNoContact);
}

TEST(FrameBuilder, TimesThatDoNotRiseAreLeftOut) {
  FrameBuilder builder(0.0);
  for (const double t : {0.004, 0.004, 0.001, std::nan(""), 0.01})
    builder.Add(t, Both(ToolAt({0, 0, 0.01})));
  builder.Finish();
  ASSERT_EQ(builder.frames().size(), 1U);
  EXPECT_NEAR(builder.frames()[0].tool[0].tip.z, 0.01, 1e-9);
}

}  // namespace
}  // namespace arthro::simulation
