// Practice of a robot without a window: a session at 1 kHz with living tissue, the frames of an
// attempt at 100 Hz and the steps of an exercise, all on the caller's clock. The same hands give
// the same bits. Portal frame, m, s.
#pragma once

#include <memory>
#include <vector>

#include "simulation/practice/scope_eye.h"
#include "simulation/practice/scripted_device.h"
#include "simulation/practice/session.h"
#include "simulation/training/attempt_log.h"
#include "simulation/training/observe/live_attempt.h"
#include "simulation/training/steps/step_engine.h"
#include "simulation/training/track/track_recorder.h"

namespace arthro::simulation {

// Poses of the hands at the end of a frame.
struct RobotHands {
  RodPose scope, instrument;
  bool closes = false;  // the button: jaws close, a shaver runs
};

class RobotJoint {
 public:
  // Begins in the state of the exercise, with the instrument outside of the joint. `log` gets
  // frames, events and the tissue track; null: none. `loaded` and `log` outlive this. Throws Error
  // for a scene or an exercise that cannot be practised.
  RobotJoint(const LoadedScene& loaded, const Exercise& exercise,
             const std::vector<TissuePreset>& presets, AttemptLog* log = nullptr);

  // Advances by one frame, in which the hands move at constant speed. Returns false at the end of
  // the attempt.
  bool Advance(const RobotHands& to);
  // The acts belong to the next frame.
  void Act(const TraineeAct& act) { acts_.push_back(act); }
  void SetViewAngle(double view_angle) { session_.SetViewAngle(view_angle); }
  void SetInstrument(ToolKind kind) { session_.SetInstrument(kind); }

  bool HasEnded() const { return engine_.end() != AttemptEnd::kRunning; }
  const RobotHands& hands() const { return hands_; }
  const AttemptFrame& frame() const { return frames_.back(); }  // after the first Advance
  const std::vector<AttemptFrame>& frames() const { return frames_; }
  const StepEngine& engine() const { return engine_; }
  const LoadedScene& loaded() const { return loaded_; }
  const std::vector<TargetPlace>& places() const { return places_; }
  const DepthField& relief() const { return session_.relief(); }
  const ScopeEye& eye() const { return eye_; }
  const WorldPicture* tissues() { return session_.tissues(); }
  double view_angle() const { return session_.view_angle(); }
  glm::dvec3 instrument_portal() const { return {session_.incision_spacing(), 0.0, 0.0}; }

  // Ends an attempt that still runs, and gives its last events to the log.
  void Finish();

 private:
  void KeepEvents();
  void KeepTissue(const WorldPicture* world);

  const LoadedScene& loaded_;
  Session session_;
  ScopeEye eye_;
  std::vector<TargetPlace> places_;
  LiveAttempt live_;
  StepEngine engine_;
  AttemptLog* log_;
  RobotHands hands_;
  ScriptedDevice scope_, instrument_;
  std::vector<AttemptFrame> frames_;
  std::vector<TraineeAct> acts_;
  std::size_t kept_events_ = 0;
  TrackRecorder recorder_;
  long ticks_ = 0;
};

}  // namespace arthro::simulation
