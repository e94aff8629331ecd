#include <gtest/gtest.h>

#include "app/cli/practice/replay_pictures.h"
#include "simulation/practice/hands/blade_speed.h"

namespace arthro::app {
namespace {

TEST(RecordedPicture, BladeTurnsWhileTheShaverRuns) {
  simulation::Snapshot snapshot;
  snapshot.kind = simulation::ToolKind::kShaver;
  snapshot.instrument.fault = simulation::Fault::kNone;
  snapshot.instrument.proxy_in_portal = {0, 0, 0.02};
  const auto turn_at = [&](double t, bool is_running) {
    snapshot.t = t;
    snapshot.instrument.is_running = is_running;
    return RecordedPicture(snapshot, {}, {}, {}).instrument->turn;
  };
  EXPECT_EQ(turn_at(1.0, false), 0.0);
  EXPECT_NEAR(turn_at(1.02, true) - turn_at(1.0, true), 0.02 * simulation::kBladeSpeed, 1e-12);
}

}  // namespace
}  // namespace arthro::app
