#include "simulation/training/steps/step_engine.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "simulation/training/steps/step_rules.h"
#include "simulation/training/steps/step_words.h"

namespace arthro::simulation {
namespace {

constexpr int kLongestLoss = 100;  // frames, 1 s, without a device
constexpr int kQuiet = 10;         // frames, 0.1 s, that end a bite
constexpr std::size_t kUsualEvents = 256;

bool SeesTargets(const ExerciseStep& step) {
  return std::holds_alternative<SeeStep>(step) || std::holds_alternative<HoldStep>(step) ||
         std::holds_alternative<PeriscopeStep>(step);
}

}  // namespace

StepEngine::StepEngine(Exercise exercise, double safe_force)
    : exercise_(std::move(exercise)), safe_force_(safe_force) {
  events_.reserve(kUsualEvents);
  states_.resize(exercise_.steps.size());
  strip_.open.reserve(exercise_.steps.size());
  std::size_t most_cues = 0;
  for (const ExerciseStep& step : exercise_.steps) {
    results_.push_back({BaseOf(step).id, StepOutcome::kPending, 0, std::nullopt});
    uses_instrument_ = uses_instrument_ || UsesInstrument(step);
    const auto targets = static_cast<int>(TargetsOf(exercise_, step).size());
    most_cues += static_cast<std::size_t>(targets) + 1;
    if (SeesTargets(step)) measures_.to_see += targets;
    if (std::holds_alternative<ProbeStep>(step)) measures_.to_probe += targets;
  }
  strip_.cues.reserve(most_cues);
  for (const AvoidZone& zone : exercise_.avoid)
    for (const AvoidBy by : {AvoidBy::kInstrument, AvoidBy::kScope}) {
      const bool counts = zone.by == by || zone.by == AvoidBy::kBoth;
      zones_.push_back({counts ? TargetIndex(exercise_, zone.target) : -1});
    }
}

double StepEngine::now() const { return kFrameTime * static_cast<double>(frames_); }
double StepEngine::duration() const { return kFrameTime * static_cast<double>(unpaused_); }

void StepEngine::Event(EventKind kind, const std::string& step, std::string_view note,
                       double value) {
  events_.push_back({now(), kind, step, "", value, std::string(note)});
}

void StepEngine::Add(EventKind kind, int target, double value, std::string_view note) {
  AttemptEvent& event = events_.emplace_back();
  event.t = now();
  event.kind = kind;
  if (emitting_ >= 0) event.step = results_[static_cast<std::size_t>(emitting_)].id;
  if (target >= 0) event.target = exercise_.targets[static_cast<std::size_t>(target)].id;
  event.value = value;
  event.note = note;
}

void StepEngine::End(AttemptEnd end, std::string reason) {
  if (end_ != AttemptEnd::kRunning) return;
  end_ = end;
  reason_ = std::move(reason);
  EndBite();
  Event(EventKind::kAttemptEnd, "", reason_);
}

void StepEngine::Begin(std::size_t step, const StepFrame& at) {
  StepResult& result = results_[step];
  result.outcome = StepOutcome::kRunning;
  result.began = now();
  result.ended.reset();
  Event(EventKind::kStepStart, result.id);
  // A step that begins again counts its targets anew.
  const auto counted =
      static_cast<int>(std::ranges::count_if(states_[step].dwell, &Dwell::is_done));
  if (std::holds_alternative<ProbeStep>(exercise_.steps[step])) measures_.probed -= counted;
  if (SeesTargets(exercise_.steps[step])) measures_.seen -= counted;
  StartStep(exercise_.steps[step], at, states_[step]);
  if (const auto* recover = std::get_if<RecoverStep>(&exercise_.steps[step])) {
    bleeding_ = static_cast<int>(step);
    bled_at_ = unpaused_;
    stanched_at_ = -1;
    Event(EventKind::kBleed, result.id, {}, recover->haze);
  }
}

void StepEngine::Conclude(std::size_t step, StepOutcome outcome, const std::string& next,
                          const StepFrame& at) {
  const bool is_done = outcome == StepOutcome::kDone;
  StepResult& result = results_[step];
  result.outcome = outcome;
  result.ended = now();
  Event(is_done ? EventKind::kStepDone : EventKind::kStepFailed, result.id);
  if (is_done && bleeding_ == static_cast<int>(step)) stanched_at_ = unpaused_;
  const StepBase& base = BaseOf(exercise_.steps[step]);
  const auto is_over = [](const StepResult& each) {
    return each.outcome == StepOutcome::kDone || each.outcome == StepOutcome::kFailed;
  };
  if (exercise_.order == StepOrder::kFree) {
    if (!is_done && !base.is_optional)
      End(AttemptEnd::kStepFailed, StepWords(exercise_, step) + " has failed.");
    else if (std::all_of(results_.begin(), results_.end(), is_over))
      End(AttemptEnd::kCompleted, "");
    return;
  }
  std::string follows = next;
  if (follows.empty()) follows = is_done ? base.next.done : base.next.failed;
  int index = static_cast<int>(step) + 1;
  if (follows == kEndOfExercise || (follows.empty() && !is_done && !base.is_optional))
    index = static_cast<int>(exercise_.steps.size());
  else if (!follows.empty())
    index = StepIndex(exercise_, follows);
  if (index >= 0 && index < static_cast<int>(exercise_.steps.size()))
    return Begin(static_cast<std::size_t>(index), at);
  if (is_done || base.is_optional)
    End(AttemptEnd::kCompleted, "");
  else
    End(AttemptEnd::kStepFailed, StepWords(exercise_, step) + " has failed.");
}

void StepEngine::TakeActs(std::span<const TraineeAct> acts) {
  for (const TraineeAct& act : acts) switch (act.kind) {
      case ActKind::kHint:
        is_hint_asked_ = true;
        break;
      case ActKind::kReset:
        Event(EventKind::kReset, "", act.note);
        break;
      case ActKind::kLookDown:
        Event(EventKind::kLookDown, "", act.note);
        break;
      case ActKind::kNote:
        Event(EventKind::kNote, "", act.note);
        break;
      case ActKind::kStop:
        Event(EventKind::kStopped, "", act.note);
        End(AttemptEnd::kStopped, "The trainee ended the attempt.");
        break;
      case ActKind::kMark:
      case ActKind::kAnswer:
        break;  // taken by the steps
    }
}

bool StepEngine::CheckLimits(const AttemptFrame& frame) {
  // A device that fails for longer makes the attempt void.
  const bool is_known = frame.tool[Index(DeviceRole::kScope)].is_valid &&
                        (!uses_instrument_ || frame.tool[Index(DeviceRole::kInstrument)].is_valid);
  lost_frames_ = is_known ? 0 : lost_frames_ + 1;
  if (lost_frames_ > kLongestLoss) {
    Event(EventKind::kFault, "", "no samples of a device for more than a second");
    End(AttemptEnd::kVoid, "A device gave no samples for more than a second.");
    return false;
  }
  double peak = 0;
  for (const ToolFrame& tool : frame.tool)
    if (tool.is_valid) peak = std::max(peak, static_cast<double>(tool.peak_force));
  const bool is_over = peak > safe_force_;
  if (is_over && !is_over_force_) Event(EventKind::kForceOver, "", {}, peak);
  is_over_force_ = is_over;
  for (const ToolFrame& tool : frame.tool)
    if (tool.is_valid && static_cast<double>(tool.peak_force) > safe_force_ &&
        tool.contact != kNoContact)
      marked_.Add(glm::dvec3(tool.drawn_tip));
  measures_.marked_area = marked_.area();
  const ExerciseLimits& limits = exercise_.limits;
  if (limits.time && unpaused_ >= FramesOf(*limits.time))
    End(AttemptEnd::kLimit, fmt::format("The time of {:g} s is over.", *limits.time));
  else if (limits.force && peak > *limits.force)
    End(AttemptEnd::kLimit,
        fmt::format("A force of {:.1f} N was more than the limit of {:g} N.", peak, *limits.force));
  else if (limits.marked_area && marked_.area() > *limits.marked_area)
    End(AttemptEnd::kLimit, fmt::format("More than {:g} mm² were touched with more than {:g} N.",
                                        *limits.marked_area * 1e6, safe_force_));
  return end_ == AttemptEnd::kRunning;
}

void StepEngine::CheckZones(const AttemptFrame& frame) {
  for (std::size_t i = 0; i < zones_.size(); ++i) {
    ZoneState& zone = zones_[i];
    if (zone.target < 0) continue;
    const DeviceRole role = i % 2 == 0 ? DeviceRole::kInstrument : DeviceRole::kScope;
    const ToolFrame& tool = frame.tool[Index(role)];
    const double above = exercise_.avoid[i / 2].above;
    const auto place = PlaceOf(exercise_, frame, zone.target);
    const double radius = exercise_.targets[static_cast<std::size_t>(zone.target)].radius;
    const bool is_inside = place && tool.is_inside() &&
                           glm::distance(glm::dvec3(tool.drawn_tip), *place) <= radius &&
                           (above == 0 || static_cast<double>(tool.peak_force) > above);
    zone.outside = is_inside ? 0 : zone.outside + 1;
    const bool was_inside = zone.is_inside;
    zone.is_inside = is_inside || (was_inside && zone.outside <= kForgivenGap);
    if (zone.is_inside == was_inside) continue;
    emitting_ = -1;
    Add(zone.is_inside ? EventKind::kZoneIn : EventKind::kZoneOut, zone.target,
        zone.is_inside ? static_cast<double>(tool.peak_force) : 0.0,
        role == DeviceRole::kScope ? "scope" : "instrument");
  }
}

void StepEngine::CheckTissue(const AttemptFrame& frame) {
  const bool is_closed =
      frame.instrument == ToolKind::kPunch && static_cast<double>(frame.opening) < kJawsClosed;
  const bool closes = is_closed && !is_closed_;
  is_closed_ = is_closed;
  if (closes || frame.taken > 0) {
    taking_.is_under_way = true;
    taking_.quiet = 0;
  }
  if (!taking_.is_under_way) return;
  taking_.taken += frame.taken;
  taking_.outside += frame.taken_outside;
  if (!(frame.taken > 0) && ++taking_.quiet > kQuiet) EndBite();
}

// A bite that took nothing has the value 0.
void StepEngine::EndBite() {
  if (!taking_.is_under_way) return;
  Event(EventKind::kBite, "", {}, taking_.taken);
  if (taking_.outside > 0) Event(EventKind::kCutOutside, "", {}, taking_.outside);
  taking_ = {};
}

void StepEngine::AdvanceSteps(const StepFrame& at) {
  const bool is_free = exercise_.order == StepOrder::kFree;
  if (unpaused_ == 1) {
    for (std::size_t i = 0; i < exercise_.steps.size(); ++i)
      if (is_free || i == 0) Begin(i, at);
  }
  for (std::size_t i = 0; i < exercise_.steps.size() && end_ == AttemptEnd::kRunning; ++i) {
    if (results_[i].outcome != StepOutcome::kRunning) continue;
    const StepBase& base = BaseOf(exercise_.steps[i]);
    StepState& state = states_[i];
    ++state.frames;
    emitting_ = static_cast<int>(i);
    const double since = kFrameTime * state.frames;
    const bool is_cue_due =
        base.cue != CueKind::kNone && (is_hint_asked_ || since >= base.cue_after);
    if (is_cue_due && !state.is_cue_due)
      Add(EventKind::kCue, -1, 0, since >= base.cue_after ? "" : kAskedFor);
    state.is_cue_due = state.is_cue_due || is_cue_due;
    std::string next;
    StepOutcome outcome = AdvanceStep(exercise_.steps[i], at, state, &next);
    if (outcome == StepOutcome::kRunning && base.limit > 0 && state.frames >= FramesOf(base.limit))
      outcome = StepOutcome::kFailed;
    emitting_ = -1;
    if (outcome == StepOutcome::kRunning) continue;
    Conclude(i, outcome, next, at);
    if (!is_free) break;  // the next step begins with the next frame
  }
  is_hint_asked_ = false;
}

void StepEngine::UpdateHaze() {
  strip_.haze = exercise_.setup.disturbances.haze;
  if (bleeding_ < 0) return;
  const auto& step = std::get<RecoverStep>(exercise_.steps[static_cast<std::size_t>(bleeding_)]);
  const auto risen = [&](long frame) {
    const double since = kFrameTime * static_cast<double>(frame - bled_at_);
    return step.rise > 0 ? step.haze * std::min(1.0, since / step.rise) : step.haze;
  };
  double haze = risen(stanched_at_ < 0 ? unpaused_ : stanched_at_);
  if (stanched_at_ >= 0) {
    const double since = kFrameTime * static_cast<double>(unpaused_ - stanched_at_);
    haze *= step.decay > 0 ? std::exp(-since / step.decay) : 0.0;
  }
  strip_.haze = std::max(strip_.haze, haze);
}

void StepEngine::UpdateStrip(const StepFrame& at) {
  const auto running = std::find_if(results_.begin(), results_.end(), [](const StepResult& result) {
    return result.outcome == StepOutcome::kRunning;
  });
  strip_.done = static_cast<int>(
      std::count_if(results_.begin(), results_.end(),
                    [](const StepResult& result) { return result.outcome == StepOutcome::kDone; }));
  strip_.time = duration();
  strip_.force = at.frame.tool[Index(DeviceRole::kInstrument)].mean_force;
  UpdateHaze();
  strip_.step = running == results_.end() ? -1 : static_cast<int>(running - results_.begin());
  strip_.force_band.reset();
  strip_.step_time_left.reset();
  strip_.goal.reset();
  strip_.is_cue_due = false;
  strip_.progress = 0;
  strip_.open.clear();
  strip_.cues.clear();
  for (std::size_t i = 0; i < results_.size(); ++i) {
    if (results_[i].outcome != StepOutcome::kRunning) continue;
    strip_.open.push_back({static_cast<int>(i), states_[i].progress});
    if (states_[i].is_cue_due) AddCues(static_cast<int>(i), at, states_[i], strip_.cues);
  }
  if (strip_.step < 0) return;
  const auto index = static_cast<std::size_t>(strip_.step);
  const ExerciseStep& step = exercise_.steps[index];
  const StepState& state = states_[index];
  strip_.progress = state.progress;
  strip_.is_cue_due = state.is_cue_due;
  strip_.force_band = ForceBandOf(step);
  strip_.goal = MovingGoal(step, at, state);
  if (BaseOf(step).limit > 0)
    strip_.step_time_left =
        std::max(0.0, BaseOf(step).limit - kFrameTime * static_cast<double>(state.frames));
}

void StepEngine::Advance(const AttemptFrame& frame, std::span<const TraineeAct> acts) {
  if (end_ != AttemptEnd::kRunning) return;
  if (frames_ == 0) Event(EventKind::kAttemptStart, "");
  ++frames_;
  TakeActs(acts);
  if (end_ != AttemptEnd::kRunning) return;
  if (frame.is_paused != is_paused_)
    Event(frame.is_paused ? EventKind::kPause : EventKind::kResume, "");
  strip_.is_paused = is_paused_ = frame.is_paused;
  if (is_paused_) return;
  ++unpaused_;
  CheckTissue(frame);
  if (!CheckLimits(frame)) return;
  CheckZones(frame);
  const StepFrame at{exercise_, frame, acts, measures_, *this};
  AdvanceSteps(at);
  UpdateStrip(at);
}

void StepEngine::Finish() {
  if (end_ != AttemptEnd::kRunning) return;
  Event(EventKind::kStopped, "", kRecordingEnds);
  End(AttemptEnd::kStopped, "The attempt was stopped before its end.");
}

void AdvanceAll(StepEngine& engine, std::span<const AttemptFrame> frames,
                std::span<const std::vector<TraineeAct>> acts) {
  for (std::size_t k = 0; k < frames.size(); ++k)
    engine.Advance(frames[k], k < acts.size() ? std::span<const TraineeAct>(acts[k])
                                              : std::span<const TraineeAct>());
}

}  // namespace arthro::simulation
