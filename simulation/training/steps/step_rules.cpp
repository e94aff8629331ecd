#include "simulation/training/steps/step_rules.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/geometric.hpp>

#include "simulation/training/steps/path_pieces.h"

namespace arthro::simulation {
namespace {

constexpr double kAngleApart = RadiansFromDegrees(1);  // a view angle within it is the same
constexpr int kOffCentre = 20;         // frames, 0.2 s, off the centre that restart a telescope
constexpr double kTrackCaught = 5e-3;  // m from the goal, within which it departs
constexpr int kFurthestPiece = 3;      // pieces ahead that a tip may reach next
constexpr double kReach = 1.5e-3;      // m from a body's surface within which jaws take it
constexpr double kRest = 5e-3;         // m/s below which a body rests
constexpr double kAtRest = 0.5;        // s of rest
constexpr double kOffTissue = 5e-3;    // m from the last bite

const ToolFrame& Instrument(const StepFrame& at) {
  return at.frame.tool[Index(DeviceRole::kInstrument)];
}
const ToolFrame& Scope(const StepFrame& at) { return at.frame.tool[Index(DeviceRole::kScope)]; }

const PointSight* SightOf(const StepFrame& at, int target) {
  if (target < 0 || target >= at.frame.sight.targets) return nullptr;
  return &at.frame.sight.target[static_cast<std::size_t>(target)];
}

struct SightLimits {
  double centre;
  glm::dvec2 distance;
  double incidence;
};

// Frames hold floats; a limit is compared as one, so that a value at the limit is within it.
bool IsWithin(float value, double least, double most) {
  return value >= static_cast<float>(least) && value <= static_cast<float>(most);
}

bool IsSeen(const StepFrame& at, int target, const SightLimits& limits) {
  const PointSight* sight = SightOf(at, target);
  return sight != nullptr && sight->is_clear && !sight->is_gone && Scope(at).is_inside() &&
         IsWithin(sight->centre, 0, limits.centre) &&
         IsWithin(sight->distance, limits.distance.x, limits.distance.y) &&
         IsWithin(sight->incidence, 0, limits.incidence);
}

// The metrics of camera handling, while the target is in the picture.
// Without a distance that is asked for, only the place in the picture is measured.
void MeasureView(const StepFrame& at, int target,
                 const std::optional<glm::dvec2>& distance = std::nullopt) {
  const PointSight* sight = SightOf(at, target);
  if (sight == nullptr || !sight->is_clear) return;
  const double r = sight->distance;
  at.measures.centring.Add(sight->centre);
  if (distance) at.measures.distance_error.Add(std::max({0.0, distance->x - r, r - distance->y}));
}

double RadiusOf(const StepFrame& at, int target) {
  return at.exercise.targets[static_cast<std::size_t>(target)].radius;
}

bool IsTipAt(const StepFrame& at, int target) {
  const auto place = PlaceOf(at.exercise, at.frame, target);
  return place && Instrument(at).is_inside() &&
         glm::distance(glm::dvec3(Instrument(at).drawn_tip), *place) <= RadiusOf(at, target);
}

bool IsPressed(const StepFrame& at, int target, const glm::dvec2& force, bool must_see) {
  return IsTipAt(at, target) && IsWithin(Instrument(at).mean_force, force.x, force.y) &&
         (!must_see || at.frame.sight.is_tip_visible);
}

// Counts a frame in which the tip touches a target that is to be pressed.
void MeasureForceBand(const StepFrame& at, const StepState& state, const glm::dvec2& force) {
  if (Instrument(at).contact == kNoContact) return;
  for (std::size_t i = 0; i < state.targets.size(); ++i) {
    if (state.dwell[i].is_done || !IsTipAt(at, state.targets[i])) continue;
    ++at.measures.pressed;
    at.measures.in_band += IsWithin(Instrument(at).mean_force, force.x, force.y) ? 1 : 0;
    return;
  }
}

// Places of a path now; false where one is not known.
bool PathNow(const StepFrame& at, StepState& state) {
  for (std::size_t i = 0; i < state.targets.size(); ++i) {
    const auto place = PlaceOf(at.exercise, at.frame, state.targets[i]);
    if (!place) return false;
    state.places[i] = *place;
  }
  return state.places.size() > 1;
}

double ShareOf(std::size_t part, std::size_t all) {
  return all > 0 ? static_cast<double>(part) / static_cast<double>(all) : 1.0;
}

// Advances a step by one frame.
struct Rule {
  const StepFrame& at;
  StepState& state;
  std::string* next;

  // Each target for itself, in any order.
  template <class Holds, class Found>
  StepOutcome EachTarget(double hold, const Holds& holds, const Found& found) {
    std::size_t done = 0;
    int longest = 0;
    for (std::size_t i = 0; i < state.targets.size(); ++i) {
      Dwell& dwell = state.dwell[i];
      const int target = state.targets[i];
      if (!dwell.is_done) {
        if (dwell.Add(holds(target))) at.events.Add(EventKind::kLost, target, 0, "");
        if (dwell.frames >= FramesOf(hold)) {
          dwell.is_done = true;
          found(target);
        } else {
          longest = std::max(longest, dwell.frames);
        }
      }
      done += dwell.is_done ? 1 : 0;
    }
    const auto all = static_cast<double>(state.targets.size());
    state.progress = (static_cast<double>(done) + static_cast<double>(longest) / FramesOf(hold)) /
                     std::max(1.0, all);
    return done == state.targets.size() ? StepOutcome::kDone : StepOutcome::kRunning;
  }

  // The target whose view is measured: the first that is not done yet.
  void MeasureFirst(const glm::dvec2& distance) {
    for (std::size_t i = 0; i < state.targets.size(); ++i)
      if (!state.dwell[i].is_done) return MeasureView(at, state.targets[i], distance);
  }

  StepOutcome operator()(const SeeStep& step) {
    return EachTarget(
        step.hold,
        [&](int target) {
          return IsSeen(at, target, {step.centre, step.distance, step.incidence});
        },
        [&](int target) {
          ++at.measures.seen;
          at.events.Add(EventKind::kSeen, target, 0, "");
        });
  }

  StepOutcome operator()(const HoldStep& step) {
    MeasureFirst(step.distance);
    return EachTarget(
        step.hold,
        [&](int target) {
          return IsSeen(at, target, {step.centre, step.distance, kAnyIncidence});
        },
        [&](int target) {
          ++at.measures.seen;
          at.events.Add(EventKind::kSeen, target, 0, "");
        });
  }

  StepOutcome operator()(const TelescopeStep& step) {
    const int target = state.targets.front();
    const PointSight* sight = SightOf(at, target);
    const bool is_centred = IsSeen(at, target, {step.centre, {0.0, kFarAway}, kAnyIncidence});
    MeasureView(at, target);
    if (state.dwell.front().Add(is_centred, kOffCentre)) {
      at.events.Add(EventKind::kLost, target, 0, "");
      state.at = 0;
      state.cycles = 0;
    }
    // 0: to the far end first; 1: on the way in; 2: on the way out.
    if (is_centred && state.at == 0 && IsWithin(sight->distance, step.far, kFarAway)) state.at = 1;
    if (is_centred && state.at == 1 && IsWithin(sight->distance, 0, step.near)) state.at = 2;
    if (is_centred && state.at == 2 && IsWithin(sight->distance, step.far, kFarAway)) {
      state.at = 1;
      ++state.cycles;
    }
    state.progress = (state.cycles + (state.at == 2 ? 0.5 : 0.0)) / step.cycles;
    return state.cycles >= step.cycles ? StepOutcome::kDone : StepOutcome::kRunning;
  }

  StepOutcome operator()(const PeriscopeStep& step) {
    const int target = state.targets[state.at];
    const glm::dvec3 tip(Scope(at).drawn_tip);
    Dwell& dwell = state.dwell[state.at];
    const bool is_begun = state.at > 0 || dwell.frames > 0;
    const bool holds =
        std::abs(static_cast<double>(at.frame.view_angle) - step.view_angle) <= kAngleApart &&
        IsSeen(at, target, {step.centre, step.distance, kAnyIncidence}) &&
        (!is_begun || glm::distance(tip, state.anchor) <= step.tip_within);
    if (holds && !is_begun) state.anchor = tip;
    if (dwell.Add(holds)) at.events.Add(EventKind::kLost, target, 0, "");
    if (dwell.frames >= FramesOf(step.hold)) {
      dwell.is_done = true;
      ++at.measures.seen;
      at.events.Add(EventKind::kSeen, target, 0, "");
      ++state.at;
    } else if (state.at > 0 && Scope(at).is_valid &&
               glm::distance(tip, state.anchor) > step.tip_within) {
      // The ring is seen from one place: a tip that has left it begins anew.
      at.events.Add(EventKind::kLost, target, glm::distance(tip, state.anchor),
                    "the tip left its place");
      at.measures.seen -= static_cast<int>(state.at);
      state.at = 0;
      for (Dwell& each : state.dwell) each = {};
    }
    state.progress = ShareOf(state.at, state.targets.size());
    return state.at == state.targets.size() ? StepOutcome::kDone : StepOutcome::kRunning;
  }

  StepOutcome operator()(const TrackStep& step) {
    if (!PathNow(at, state)) return StepOutcome::kRunning;
    const double length = LengthOf(state.places);
    const glm::dvec3 goal = PointAt(state.places, state.way);
    const bool is_known =
        step.by == StepBy::kView ? Scope(at).is_inside() : Instrument(at).is_inside();
    const Pointer pointer = step.by == StepBy::kView ? ViewPointer(at.frame) : TipPointer(at.frame);
    const double error = DistanceTo(pointer, goal, goal);
    if (!state.has_departed && is_known && error <= kTrackCaught) state.has_departed = true;
    if (!state.has_departed) return StepOutcome::kRunning;
    if (is_known) at.measures.track_error.Add(error);
    state.way += step.speed * kFrameTime;
    state.progress = length > 0 ? std::min(1.0, state.way / length) : 1.0;
    return state.way >= length ? StepOutcome::kDone : StepOutcome::kRunning;
  }

  StepOutcome operator()(const ProbeStep& step) {
    MeasureForceBand(at, state, step.force);
    return EachTarget(
        step.hold, [&](int target) { return IsPressed(at, target, step.force, step.must_see); },
        [&](int target) {
          ++at.measures.probed;
          at.events.Add(EventKind::kProbed, target, Instrument(at).mean_force, "");
        });
  }

  StepOutcome operator()(const FollowStep& step) {
    const bool is_known =
        step.by == StepBy::kView ? Scope(at).is_inside() : Instrument(at).is_inside();
    if (!is_known || !PathNow(at, state)) return StepOutcome::kRunning;
    const Pointer pointer = step.by == StepBy::kView ? ViewPointer(at.frame) : TipPointer(at.frame);
    const auto count = static_cast<int>(state.pieces.size());
    const double piece = LengthOf(state.places) / count;
    const auto distance = [&](int i) {
      return DistanceTo(pointer, PointAt(state.places, piece * i),
                        PointAt(state.places, piece * (i + 1)));
    };
    // Only pieces near the frontier count, so that a path may cross itself.
    const int frontier = static_cast<int>(state.at);
    int nearest = frontier;
    double error = kFarAway;
    const int ahead = state.has_departed ? kFurthestPiece : 1;  // the first piece begins the path
    for (int i = std::max(0, frontier - kFurthestPiece); i < std::min(count, frontier + ahead);
         ++i) {
      const double d = distance(i);
      if (!(d < error)) continue;
      error = d;
      nearest = i;
    }
    if (state.has_departed) at.measures.line_error.Add(error);
    if (nearest >= frontier && nearest < count && error <= step.within) {
      state.has_departed = true;
      state.pieces[static_cast<std::size_t>(nearest)] = 1;
      state.at = static_cast<std::size_t>(nearest) + 1;
    }
    const auto covered =
        static_cast<int>(std::count(state.pieces.begin(), state.pieces.end(), std::uint8_t{1}));
    const int needed = std::max(1, static_cast<int>(std::ceil(step.cover * count - 1e-9)));
    state.progress = std::min(1.0, static_cast<double>(covered) / needed);
    if (covered >= needed) return StepOutcome::kDone;
    if (covered + count - static_cast<int>(state.at) < needed) {
      // Too much was left out; the path begins anew.
      at.events.Add(EventKind::kLost, state.targets.front(), covered * piece,
                    "too much of the path was left out");
      std::fill(state.pieces.begin(), state.pieces.end(), std::uint8_t{0});
      state.at = 0;
      state.has_departed = false;
    }
    return StepOutcome::kRunning;
  }

  StepOutcome operator()(const MeasureStep&) {
    for (const TraineeAct& act : at.acts) {
      if (act.kind != ActKind::kMark) continue;
      int target = -1;
      for (std::size_t i = 0; i < state.targets.size(); ++i) {
        if (!IsTipAt(at, state.targets[i]) || Instrument(at).contact == kNoContact) continue;
        target = state.targets[i];
        state.marks[i] = glm::dvec3(Instrument(at).drawn_tip);
        state.dwell[i].is_done = true;
      }
      at.events.Add(EventKind::kMark, target, 0,
                    target < 0 ? "the tip touched no target of the measurement" : "");
    }
    const auto marked = static_cast<std::size_t>(std::count_if(
        state.dwell.begin(), state.dwell.end(), [](const Dwell& dwell) { return dwell.is_done; }));
    state.progress = ShareOf(marked, state.dwell.size());
    if (marked < state.dwell.size()) return StepOutcome::kRunning;
    if (PathNow(at, state))
      at.measures.measure_error.Add(std::abs(glm::distance(state.marks[0], state.marks[1]) -
                                             glm::distance(state.places[0], state.places[1])));
    return StepOutcome::kDone;
  }

  StepOutcome operator()(const TransferStep& step) {
    const bool is_holding = Instrument(at).is_inside() &&
                            at.frame.instrument == ToolKind::kGrasper &&
                            static_cast<double>(at.frame.opening) < kJawsClosed;
    const int to = TargetIndex(at.exercise, step.to);
    const auto goal = PlaceOf(at.exercise, at.frame, to);
    const glm::dvec3 tip(Instrument(at).drawn_tip);
    const auto is_there = [&](const glm::dvec3& place) {
      return goal && glm::distance(place, *goal) <= RadiusOf(at, to);
    };
    if (is_holding && state.held < 0)
      for (const int body : state.targets) {
        const auto place = PlaceOf(at.exercise, at.frame, body);
        if (state.held >= 0 || !place || glm::distance(tip, *place) > RadiusOf(at, body) + kReach)
          continue;
        state.held = body;
        at.events.Add(EventKind::kGrasp, body, 0, "");
      }
    if (!is_holding && state.held >= 0) {
      const auto place = PlaceOf(at.exercise, at.frame, state.held);
      const bool is_good = place && is_there(*place);
      at.events.Add(is_good ? EventKind::kPlaced : EventKind::kDrop, state.held, 0, "");
      state.held = -1;
    }
    std::size_t placed = 0;
    for (std::size_t i = 0; i < state.targets.size(); ++i) {
      const auto place = PlaceOf(at.exercise, at.frame, state.targets[i]);
      const bool rests = place && state.frames > 1 && state.targets[i] != state.held &&
                         glm::distance(*place, state.places[i]) <= kRest * kFrameTime;
      if (place) state.places[i] = *place;
      state.dwell[i].Add(rests && is_there(*place));
      placed += state.dwell[i].frames >= FramesOf(kAtRest) ? 1 : 0;
    }
    state.progress = ShareOf(placed, state.targets.size());
    return placed == state.targets.size() ? StepOutcome::kDone : StepOutcome::kRunning;
  }

  StepOutcome operator()(const ResectStep& step) {
    if (at.frame.taken > 0) {
      state.bite = glm::dvec3(Instrument(at).drawn_tip);
      state.has_bitten = true;
    }
    float least = 1;
    for (const int target : state.targets)
      if (const PointSight* sight = SightOf(at, target))
        least = std::min(least, sight->taken_share);
      else
        least = 0;
    state.progress = step.share > 0 ? std::min(1.0, static_cast<double>(least) / step.share) : 1.0;
    const bool is_off = Instrument(at).contact == kNoContact &&
                        (!state.has_bitten || glm::distance(glm::dvec3(Instrument(at).drawn_tip),
                                                            state.bite) >= kOffTissue);
    return IsWithin(least, step.share, 1) && is_off ? StepOutcome::kDone : StepOutcome::kRunning;
  }

  StepOutcome operator()(const RecoverStep& step) {
    MeasureForceBand(at, state, step.force);
    return EachTarget(
        step.hold, [&](int target) { return IsPressed(at, target, step.force, true); },
        [&](int target) {
          at.events.Add(EventKind::kProbed, target, Instrument(at).mean_force, "");
        });
  }

  StepOutcome operator()(const AnswerStep& step) {
    for (const TraineeAct& act : at.acts) {
      if (act.kind != ActKind::kAnswer || act.answer < 0 ||
          act.answer >= static_cast<int>(step.choices.size()))
        continue;
      const AnswerChoice& choice = step.choices[static_cast<std::size_t>(act.answer)];
      at.events.Add(EventKind::kAnswer, -1, act.answer, choice.text);
      *next = choice.next;
      if (act.answer != step.right) return StepOutcome::kFailed;
      state.progress = 1;
      return StepOutcome::kDone;
    }
    return StepOutcome::kRunning;
  }

  static constexpr double kAnyIncidence = std::numbers::pi;
  static constexpr double kFarAway = 1e9;  // m
};

// A target whose tissue was cut away can no longer be reached. A resection wants just that.
bool IsGone(const ExerciseStep& step, const StepFrame& at, const StepState& state) {
  if (std::holds_alternative<ResectStep>(step)) return false;
  for (std::size_t i = 0; i < state.targets.size(); ++i) {
    const PointSight* sight = SightOf(at, state.targets[i]);
    if (sight == nullptr || !sight->is_gone || state.dwell[i].is_done) continue;
    at.events.Add(EventKind::kNote, state.targets[i], 0, "the tissue of this target was cut away");
    return true;
  }
  return false;
}

}  // namespace

void StartStep(const ExerciseStep& step, const StepFrame& at, StepState& state) {
  std::vector<int> targets = std::move(state.targets);
  state = {};
  state.targets = targets.empty() ? TargetsOf(at.exercise, step) : std::move(targets);
  state.dwell.resize(state.targets.size());
  state.marks.resize(state.targets.size());
  state.places.resize(state.targets.size());
  if (std::holds_alternative<FollowStep>(step) && PathNow(at, state))
    state.pieces.resize(static_cast<std::size_t>(PieceCount(state.places)));
}

StepOutcome AdvanceStep(const ExerciseStep& step, const StepFrame& at, StepState& state,
                        std::string* next) {
  if (IsGone(step, at, state)) return StepOutcome::kFailed;
  if (state.targets.empty() && !std::holds_alternative<AnswerStep>(step))
    return StepOutcome::kFailed;
  if (std::holds_alternative<FollowStep>(step) && state.pieces.empty() && PathNow(at, state))
    state.pieces.resize(static_cast<std::size_t>(PieceCount(state.places)));
  return std::visit(Rule{at, state, next}, step);
}

std::optional<glm::dvec3> MovingGoal(const ExerciseStep& step, const StepFrame& at,
                                     const StepState& state) {
  if (state.places.empty()) return std::nullopt;
  if (std::holds_alternative<TrackStep>(step)) return PointAt(state.places, state.way);
  if (std::holds_alternative<FollowStep>(step) && !state.pieces.empty())
    return PointAt(state.places, LengthOf(state.places) * ShareOf(state.at, state.pieces.size()));
  if (const auto* transfer = std::get_if<TransferStep>(&step); transfer && state.held >= 0)
    return PlaceOf(at.exercise, at.frame, TargetIndex(at.exercise, transfer->to));
  return std::nullopt;
}

void AddCues(int number, const StepFrame& at, const StepState& state, std::vector<StripCue>& cues) {
  const ExerciseStep& step = at.exercise.steps[static_cast<std::size_t>(number)];
  const auto add = [&](int target) { cues.push_back({number, target, BaseOf(step).cue}); };
  if (std::holds_alternative<PeriscopeStep>(step)) {
    if (state.at < state.targets.size()) add(state.targets[state.at]);
    return;
  }
  const auto* transfer = std::get_if<TransferStep>(&step);
  if (transfer != nullptr && state.held >= 0) return add(TargetIndex(at.exercise, transfer->to));
  for (std::size_t i = 0; i < state.targets.size(); ++i) {
    const bool is_done =
        transfer != nullptr ? state.dwell[i].frames >= FramesOf(kAtRest) : state.dwell[i].is_done;
    if (!is_done) add(state.targets[i]);
  }
}

std::optional<glm::dvec2> ForceBandOf(const ExerciseStep& step) {
  if (const auto* probe = std::get_if<ProbeStep>(&step)) return probe->force;
  if (const auto* recover = std::get_if<RecoverStep>(&step)) return recover->force;
  return std::nullopt;
}

}  // namespace arthro::simulation
