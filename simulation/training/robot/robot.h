// Robot that practises an exercise as a trainee does: it leads scope and instrument through their
// portals along minimum-jerk legs with tremor, and acts as the kind of each step asks. It knows the
// exercise and the scene at rest, and reads the frames of its attempt, no result. An expert without
// a fault shows that an exercise can be passed; a novice with a planted fault shows that its
// criteria see the fault [method.md, Robots]. The same seed gives the same bits.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "simulation/core/options.h"
#include "simulation/scene/exercise/exercise.h"
#include "simulation/scene/files/loaded_scene.h"
#include "simulation/tissue/body/tissue_preset.h"
#include "simulation/training/attempt_log.h"
#include "simulation/training/attempt_result.h"

namespace arthro::simulation {

enum class RobotFault {
  kNone,
  kTooSlow,         // waits until the time that a criterion allows is over
  kPressesTooHard,  // presses once with more than the peak force that a criterion allows
  kLooksAway,       // turns the scope away while its instrument is in the joint
  kOffCentre,       // keeps targets beside the centre of the picture
  kLeavesLine,      // leads tip or view beside the path or the goal
  kMarksBeside,     // marks a point beside the target
  kAnswersWrong,    // chooses an answer that is not right
  kDrops,           // opens the jaws on the way, twice
  kEntersZone,      // leads a tool into the first zone to avoid
  kCutsOutside,     // takes tissue outside of the regions
  kGivesUp,         // ends the attempt before the last step is done
};
inline constexpr int kRobotFaults = static_cast<int>(RobotFault::kGivesUp) + 1;
std::string_view ToString(RobotFault fault);
std::optional<RobotFault> RobotFaultFromString(std::string_view word);

struct RobotOptions {
  int seed = 1;
  double speed = 25e-3, tremor = 2e-5;
  RobotFault fault = RobotFault::kNone;
  template <class V>
  void Visit(V&& v) {
    v("seed", seed, Range{0, 1e9}, "", "Start of the tremor.");
    v("speed", speed, Range{1e-3, 0.2}, "m/s", "Largest speed of a tip on a leg.");
    v("tremor", tremor, Range{0, 1e-3}, "m", "Root mean square of the tremor of a tip.");
  }
};

struct RobotRun {
  std::vector<AttemptFrame> frames;
  AttemptResult result;
  std::vector<std::string> troubles;  // sentences about what the robot could not do
};

// `log` gets the attempt as it runs, unless null. Throws Error for a scene or an exercise that
// cannot be practised.
RobotRun RunRobot(const LoadedScene& loaded, const Exercise& exercise,
                  const std::vector<TissuePreset>& presets, const RobotOptions& options = {},
                  AttemptLog* log = nullptr);

}  // namespace arthro::simulation
