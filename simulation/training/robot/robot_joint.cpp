#include "simulation/training/robot/robot_joint.h"

#include <algorithm>

#include "simulation/practice/living_tissues.h"
#include "simulation/practice/servo_loop.h"
#include "simulation/training/observe/exercise_targets.h"
#include "simulation/training/steps/exercise_index.h"
#include "simulation/training/steps/start_disturbances.h"

namespace arthro::simulation {
namespace {

constexpr int kTicksPerFrame = 10;
constexpr double kOutside = -0.01;  // m, insertion of an instrument that is out of the joint

RobotHands HandsAtStart(const StartPose& scope) {
  RobotHands hands;
  hands.scope = {scope.latitude, scope.longitude, scope.roll, scope.insertion};
  hands.instrument.depth = kOutside;
  return hands;
}

}  // namespace

RobotJoint::RobotJoint(const LoadedScene& loaded, const Exercise& exercise,
                       const std::vector<TissuePreset>& presets, AttemptLog* log)
    : loaded_(loaded),
      session_(loaded),
      eye_(loaded),
      places_(PlacesOfTargets(loaded, exercise)),
      live_(loaded, places_, session_.relief(), eye_),
      engine_(exercise),
      log_(log),
      hands_(HandsAtStart(exercise.setup.scope)),
      scope_(session_.scope_rig(), hands_.scope),
      instrument_(session_.instrument_rig(), hands_.instrument) {
  // The scope moves no tissue, so that without an instrument all of it stays as it is at rest.
  if (std::ranges::any_of(exercise.steps, UsesInstrument))
    EnlivenTissues(session_, loaded, presets, TissuePace::kInline);
  const ExerciseSetup& setup = exercise.setup;
  if (!setup.view_angles.empty()) session_.SetViewAngle(setup.view_angles.front());
  if (setup.incision_spacing) session_.SetIncisionSpacing(*setup.incision_spacing);
  if (!setup.instruments.empty())
    session_.SetInstrument(ToolKindFromString(setup.instruments.front()));
  if (setup.head != HeadChoice::kAny)
    session_.SetCameraHead({.is_upright = setup.head == HeadChoice::kUpright});
  session_.SetDisturbances(DisturbancesOf(setup.disturbances));
  Advance(hands_);
  Advance(hands_);  // a frame ends with the first tick of the next one
}

bool RobotJoint::Advance(const RobotHands& to) {
  if (HasEnded()) return false;
  hands_ = to;
  scope_.Set(to.scope);
  instrument_.Set(to.instrument);
  instrument_.SetButtons(to.closes ? 1u : 0u);
  const double end = kServoPeriod * static_cast<double>(ticks_ + kTicksPerFrame);
  for (int i = 0; i < kTicksPerFrame; ++i) {
    const double t = kServoPeriod * static_cast<double>(++ticks_);
    session_.Tick(scope_.Sample(t, end - t), instrument_.Sample(t, end - t), kServoPeriod);
    session_.TickTissues(kServoPeriod);
    live_.watch().AfterTick(session_.snapshot(), kServoPeriod);
  }
  const WorldPicture* world = session_.tissues();
  if (world != nullptr) eye_.Follow(*world);
  eye_.MoveTo(session_.snapshot().scope);
  for (const AttemptFrame& frame : live_.Update(world)) {
    frames_.push_back(frame);
    engine_.Advance(frame, acts_);
    acts_.clear();
    if (log_ != nullptr) log_->Add(frame);
    KeepEvents();
    if (HasEnded()) break;
  }
  KeepTissue(world);
  session_.SetDisturbances(
      DisturbancesOf(engine_.exercise().setup.disturbances, engine_.strip().haze));
  return !HasEnded();
}

void RobotJoint::KeepTissue(const WorldPicture* world) {
  if (log_ == nullptr || frames_.empty()) return;
  std::vector<TrackPiece> pieces;
  recorder_.Record(kFrameTime * static_cast<double>(frames_.size()),
                   world != nullptr ? *world : WorldPicture(), pieces);
  for (const TrackPiece& piece : pieces) log_->Add(piece);
}

void RobotJoint::KeepEvents() {
  const auto& events = engine_.events();
  if (log_ != nullptr)
    for (std::size_t i = kept_events_; i < events.size(); ++i) log_->Add(events[i]);
  kept_events_ = events.size();
}

void RobotJoint::Finish() {
  engine_.Finish();
  KeepEvents();
}

}  // namespace arthro::simulation
