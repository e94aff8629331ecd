#include "simulation/training/observed_recording.h"

#include "simulation/practice/scope_eye.h"
#include "simulation/practice/servo_loop.h"
#include "simulation/training/observe/exercise_targets.h"
#include "simulation/training/observe/live_attempt.h"
#include "simulation/training/observe/observer.h"
#include "simulation/training/steps/start_disturbances.h"
#include "simulation/training/steps/step_engine.h"

namespace arthro::simulation {
namespace {

constexpr int kTicksPerLook = 10;  // ticks of a frame

LoggedMount MountOf(const DeviceRig& rig) {
  return {rig.pivot, rig.portal_from_device, rig.rod_length};
}

// State of a session in which the exercise begins.
LoggedWish WishOf(const Scene& scene, const ExerciseSetup& setup) {
  LoggedWish wish;
  wish.view_angle = setup.view_angles.empty() ? scene.scope.view_angle : setup.view_angles.front();
  wish.incision_spacing = setup.incision_spacing.value_or(scene.portals.incision_spacing);
  if (!setup.instruments.empty())
    wish.instrument = static_cast<std::uint8_t>(ToolKindFromString(setup.instruments.front()));
  wish.is_complete = true;
  wish.is_head_upright = setup.head == HeadChoice::kUpright;
  wish.disturbance = StrengthsOf(DisturbancesOf(setup.disturbances));
  wish.mount = {MountOf(scene.rig.scope), MountOf(scene.rig.instrument)};
  return wish;
}

}  // namespace

std::vector<AttemptFrame> ObserveRecording(const LoadedScene& loaded, const Recording& recording,
                                           const Exercise& exercise, const SessionOptions& options,
                                           const Progress& progress,
                                           const std::vector<TissuePreset>& presets,
                                           std::vector<std::string>* messages) {
  std::vector<AttemptFrame> frames;
  if (recording.rows.empty()) return frames;
  Recording wished = recording;
  if (wished.wishes.empty())
    wished.wishes = {{wished.rows.front().sample.t - 1, WishOf(loaded.scene, exercise.setup)}};
  const DepthField relief = ReliefOf(loaded);
  ScopeEye eye(loaded);
  LiveAttempt live(loaded, PlacesOfTargets(loaded, exercise), relief, eye);
  double last = 0;
  long ticks = 0;
  const auto look = [&](const Snapshot& snapshot, const WorldPicture* world) {
    if (world != nullptr) eye.Follow(*world);
    eye.MoveTo(snapshot.scope);
    for (const AttemptFrame& frame : live.Update(world)) frames.push_back(frame);
  };
  ReplayReport report;
  Replay(loaded, wished, options, progress, &report, presets,
         [&](double, const Snapshot& snapshot, const WorldPicture* world) {
           live.watch().AfterTick(snapshot, snapshot.t - last);
           last = snapshot.t;
           if (++ticks % kTicksPerLook == 0) look(snapshot, world);
         });
  if (messages != nullptr) *messages = report.messages;
  StepEngine engine(exercise);
  std::size_t until = 0;
  while (until < frames.size() && engine.end() == AttemptEnd::kRunning)
    engine.Advance(frames[until++]);
  frames.resize(until);
  return frames;
}

void ObserveAnew(const LoadedScene& loaded, const Exercise& exercise,
                 std::vector<AttemptFrame>& frames) {
  const DepthField relief = ReliefOf(loaded);
  ScopeEye eye(loaded);
  const auto places = PlacesOfTargets(loaded, exercise);
  const Observer observer(loaded, places, relief, eye);
  for (AttemptFrame& frame : frames) {
    const Observation before = frame.sight;
    const ToolFrame& scope = frame.tool[Index(DeviceRole::kScope)];
    if (scope.is_inside())
      eye.MoveTo(HandOf(scope), glm::dvec3(scope.drawn_tip));
    else
      eye.Leave();
    observer.Observe(frame);
    if (before.targets != frame.sight.targets) continue;
    for (std::size_t i = 0; i < places.size(); ++i) {
      PointSight& sight = frame.sight.target[i];
      sight.taken_share = before.target[i].taken_share;
      if (!before.target[i].is_gone) continue;
      sight.is_gone = true;
      sight.is_clear = false;
    }
  }
}

}  // namespace arthro::simulation
