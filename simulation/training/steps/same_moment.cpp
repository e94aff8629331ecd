#include "simulation/training/steps/same_moment.h"

#include <algorithm>
#include <string>

namespace arthro::simulation {
namespace {

bool IsDone(const StepResult& step) {
  return step.outcome == StepOutcome::kDone && step.ended.has_value();
}

const StepResult* Find(std::span<const StepResult> steps, const std::string& id) {
  const auto found = std::ranges::find(steps, id, &StepResult::id);
  return found == steps.end() ? nullptr : &*found;
}

// Step that is done next at `t`; else the last one that has begun and was not done; else null.
const StepResult* StepAt(std::span<const StepResult> steps, double t) {
  const StepResult* at = nullptr;
  for (const StepResult& step : steps)
    if (IsDone(step) && *step.ended > t && (at == nullptr || *step.ended < *at->ended)) at = &step;
  if (at != nullptr) return at;
  for (const StepResult& step : steps)
    if (step.outcome != StepOutcome::kPending && !IsDone(step) && step.began <= t) at = &step;
  return at;
}

}  // namespace

StepTime TimeOf(std::span<const StepResult> steps, const StepResult& step) {
  StepTime time{step.began, step.ended.value_or(step.began)};
  for (const StepResult& each : steps)
    if (IsDone(each) && &each != &step && *each.ended < time.end)
      time.begin = std::max(time.begin, *each.ended);
  return time;
}

double SameMoment(std::span<const StepResult> own, std::span<const StepResult> other, double t) {
  const StepResult* step = StepAt(own, t);
  if (step == nullptr)
    for (const StepResult& each : own)  // all are done: the last of them
      if (IsDone(each) && (step == nullptr || *each.ended > *step->ended)) step = &each;
  if (step == nullptr) return t;
  const StepResult* same = Find(other, step->id);
  if (same == nullptr || !IsDone(*same)) return t;
  const StepTime there = TimeOf(other, *same);
  if (!IsDone(*step)) return std::clamp(there.begin + (t - step->began), there.begin, there.end);
  const StepTime here = TimeOf(own, *step);
  const double share = here.end > here.begin
                           ? std::clamp((t - here.begin) / (here.end - here.begin), 0.0, 1.0)
                           : 1.0;
  return there.begin + share * (there.end - there.begin);
}

}  // namespace arthro::simulation
