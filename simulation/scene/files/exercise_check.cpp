#include "simulation/scene/files/exercise_check.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>
#include <string_view>

#include <fmt/format.h>

namespace arthro {
namespace {

// Appends sentences that begin with the key of the exercise.
class Faults {
 public:
  Faults(std::string key, std::vector<std::string>& list) : key_(std::move(key)), list_(list) {}
  void Add(const std::string& key, const std::string& sentence) {
    list_.push_back(key_ + key + " " + sentence);
  }

 private:
  std::string key_;
  std::vector<std::string>& list_;
};

const ExerciseTarget* FindTarget(const Exercise& exercise, const std::string& id) {
  const auto found = std::find_if(exercise.targets.begin(), exercise.targets.end(),
                                  [&](const ExerciseTarget& target) { return target.id == id; });
  return found == exercise.targets.end() ? nullptr : &*found;
}

void CheckTarget(const Scene& scene, const ExerciseTarget& target, const std::string& key,
                 Faults& faults) {
  if (PlacesOf(target) != 1)
    faults.Add(key, fmt::format("has {} places; give one of bearing_deg, point, ball and regions",
                                PlacesOf(target) == 0 ? "no" : "several"));
  const bool needs_tissue = target.point || !target.regions.empty();
  if (needs_tissue && target.on.empty())
    return faults.Add(key + ".on", "is missing; name the tissue that carries the target");
  if (!needs_tissue && !target.on.empty())
    faults.Add(key + ".on", "is given without a point or regions on that tissue; remove it");
  if (target.is_loose && !target.regions.empty())
    faults.Add(key + ".loose", "is true of regions, which cannot be carried; remove it");
  if (target.on.empty()) return;
  const auto tissue = std::find_if(scene.tissues.begin(), scene.tissues.end(),
                                   [&](const Tissue& t) { return t.name == target.on; });
  if (tissue == scene.tissues.end())
    return faults.Add(key + ".on",
                      fmt::format("is \"{}\", which is no tissue of this scene", target.on));
  for (const std::string& region : target.regions)
    if (std::none_of(tissue->regions.begin(), tissue->regions.end(),
                     [&](const Region& r) { return r.name == region; }))
      faults.Add(key + ".regions",
                 fmt::format("names \"{}\", which is no region of \"{}\"", region, target.on));
}

// Checks of one step; `key` is its place.
struct StepCheck {
  const Exercise& exercise;
  std::string key;
  Faults& faults;

  void Known(const char* field, const std::string& id) const {
    if (FindTarget(exercise, id) == nullptr)
      faults.Add(key + field, fmt::format("names the target \"{}\", which does not exist", id));
  }
  void Known(const char* field, const std::vector<std::string>& ids, std::size_t least) const {
    for (const std::string& id : ids) Known(field, id);
    if (ids.size() < least)
      faults.Add(key + field, fmt::format("names {} target{}; this kind of step needs {}",
                                          ids.size(), ids.size() == 1 ? "" : "s", least));
  }
  void Ordered(const char* field, double least, double most) const {
    if (least > most)
      faults.Add(key + field,
                 fmt::format("runs from {} to {}; give the smaller value first", least, most));
  }

  void operator()(const SeeStep& step) const {
    Known(".targets", step.targets, 1);
    Ordered(".distance", step.distance.x, step.distance.y);
  }
  void operator()(const HoldStep& step) const {
    Known(".targets", step.targets, 1);
    Ordered(".distance", step.distance.x, step.distance.y);
  }
  void operator()(const TelescopeStep& step) const {
    Known(".targets", step.targets, 1);
    if (!(step.near < step.far))
      faults.Add(key + ".near", "is not less than far, so the scope has no way to go");
  }
  void operator()(const PeriscopeStep& step) const {
    Known(".targets", step.targets, 1);
    Ordered(".distance", step.distance.x, step.distance.y);
  }
  void operator()(const TrackStep& step) const { Known(".path", step.path, 2); }
  void operator()(const ProbeStep& step) const {
    Known(".targets", step.targets, 1);
    Ordered(".force", step.force.x, step.force.y);
  }
  void operator()(const FollowStep& step) const { Known(".path", step.path, 2); }
  void operator()(const MeasureStep& step) const {
    Known(".targets", step.targets, 2);
    if (step.targets.size() > 2)
      faults.Add(key + ".targets", "names more than the two targets whose distance is measured");
  }
  void operator()(const TransferStep& step) const {
    Known(".bodies", step.bodies, 1);
    Known(".to", step.to);
    for (const std::string& id : step.bodies)
      if (const ExerciseTarget* body = FindTarget(exercise, id); body && !body->is_loose)
        faults.Add(
            key + ".bodies",
            fmt::format("names \"{}\", which is not loose; set \"loose\" of the target", id));
  }
  void operator()(const ResectStep& step) const {
    Known(".regions", step.regions, 1);
    for (const std::string& id : step.regions)
      if (const ExerciseTarget* target = FindTarget(exercise, id);
          target && target->regions.empty())
        faults.Add(key + ".regions", fmt::format("names \"{}\", a target without regions", id));
  }
  void operator()(const RecoverStep& step) const {
    Known(".source", step.source);
    Ordered(".force", step.force.x, step.force.y);
  }
  void operator()(const AnswerStep& step) const {
    if (step.choices.size() < 2)
      faults.Add(key + ".choices", "has fewer than two answers");
    else if (step.right >= static_cast<int>(step.choices.size()))
      faults.Add(key + ".right", fmt::format("is {}, but there are {} answers, counted from 0",
                                             step.right, step.choices.size()));
  }
};

int IndexOfStep(const Exercise& exercise, const std::string& id) {
  for (std::size_t i = 0; i < exercise.steps.size(); ++i)
    if (BaseOf(exercise.steps[i]).id == id) return static_cast<int>(i);
  return -1;
}

void CheckNext(const Exercise& exercise, const std::string& next, const std::string& key,
               Faults& faults) {
  if (!next.empty() && next != kEndOfExercise && IndexOfStep(exercise, next) < 0)
    faults.Add(key, fmt::format("names the step \"{}\", which does not exist", next));
}

// The step after success; the number of steps is the end, −1 a step that does not exist.
int StepAfter(const Exercise& exercise, std::size_t index) {
  const ExerciseStep& step = exercise.steps[index];
  std::string next = BaseOf(step).next.done;
  if (const auto* answer = std::get_if<AnswerStep>(&step))
    if (answer->right < static_cast<int>(answer->choices.size()) &&
        !answer->choices[static_cast<std::size_t>(answer->right)].next.empty())
      next = answer->choices[static_cast<std::size_t>(answer->right)].next;
  if (next.empty()) return static_cast<int>(index) + 1;
  return next == kEndOfExercise ? static_cast<int>(exercise.steps.size())
                                : IndexOfStep(exercise, next);
}

// An exercise in which every step succeeds must come to its end.
void CheckLoops(const Exercise& exercise, Faults& faults) {
  std::set<int> passed;
  int at = 0;
  while (at >= 0 && at < static_cast<int>(exercise.steps.size())) {
    if (!passed.insert(at).second)
      return faults.Add(
          fmt::format(".steps[{}].next", at),
          fmt::format("runs in a loop: step \"{}\" comes again after success; let a step lead to "
                      "\"{}\"",
                      BaseOf(exercise.steps[static_cast<std::size_t>(at)]).id, kEndOfExercise));
    at = StepAfter(exercise, static_cast<std::size_t>(at));
  }
}

void CheckSteps(const Exercise& exercise, Faults& faults) {
  for (std::size_t i = 0; i < exercise.steps.size(); ++i) {
    const std::string key = fmt::format(".steps[{}]", i);
    const ExerciseStep& step = exercise.steps[i];
    std::visit(StepCheck{exercise, key, faults}, step);
    CheckNext(exercise, BaseOf(step).next.done, key + ".next.done", faults);
    CheckNext(exercise, BaseOf(step).next.failed, key + ".next.failed", faults);
    if (const auto* answer = std::get_if<AnswerStep>(&step))
      for (std::size_t k = 0; k < answer->choices.size(); ++k)
        CheckNext(exercise, answer->choices[k].next, fmt::format("{}.choices[{}].next", key, k),
                  faults);
  }
  if (exercise.order == StepOrder::kFixed) CheckLoops(exercise, faults);
}

void CheckCriteria(const Exercise& exercise, Faults& faults) {
  for (std::size_t i = 0; i < exercise.criteria.size(); ++i) {
    const Criterion& criterion = exercise.criteria[i];
    const std::string key = fmt::format(".criteria[{}]", i);
    if (!criterion.min && !criterion.max)
      faults.Add(key, criterion.max_from
                          ? "has a group but no max, which holds until the group is large enough"
                          : "has no limit; give min, max or both");
    if (criterion.min && criterion.max && *criterion.min > *criterion.max)
      faults.Add(key + ".min", "is more than max, so no value can be right");
  }
}

void CheckSetup(const Exercise& exercise, Faults& faults) {
  const auto known = std::span(kInstrumentKinds);
  for (const std::string& word : exercise.setup.instruments)
    if (std::find(known.begin(), known.end(), word) == known.end())
      faults.Add(".setup.instruments",
                 fmt::format("names \"{}\"; it must be one of: {}", word, fmt::join(known, ", ")));
  for (const double angle : exercise.setup.view_angles)
    if (angle < 0 || angle > RadiansFromDegrees(120))
      faults.Add(".setup.view_angles_deg", "has an angle outside of 0 to 120 degrees");
}

// An exercise whose needs lead back to it can never be opened.
void CheckNeeds(const Scene& scene, const Exercise& exercise, Faults& faults) {
  const auto find = [&](const std::string& id) -> const Exercise* {
    for (const Exercise& other : scene.exercises)
      if (other.id == id) return &other;
    return nullptr;
  };
  std::set<std::string> reached;
  std::vector<std::string> open = exercise.needs;
  for (const std::string& id : exercise.needs)
    if (find(id) == nullptr)
      faults.Add(".needs", fmt::format("names the exercise \"{}\", which does not exist", id));
  while (!open.empty()) {
    const std::string id = open.back();
    open.pop_back();
    if (!reached.insert(id).second) continue;
    if (const Exercise* other = find(id))
      open.insert(open.end(), other->needs.begin(), other->needs.end());
  }
  if (reached.contains(exercise.id))
    faults.Add(".needs", "leads back to this exercise, so it never opens");
}

}  // namespace

std::vector<std::string> ExerciseFaults(const Scene& scene) {
  std::vector<std::string> list;
  for (std::size_t e = 0; e < scene.exercises.size(); ++e) {
    const Exercise& exercise = scene.exercises[e];
    Faults faults(fmt::format("exercises[{}]", e), list);
    if (exercise.targets.size() > static_cast<std::size_t>(kMostTargets))
      faults.Add(".targets", fmt::format("has {} targets; an exercise has at most {}",
                                         exercise.targets.size(), kMostTargets));
    for (std::size_t i = 0; i < exercise.targets.size(); ++i)
      CheckTarget(scene, exercise.targets[i], fmt::format(".targets[{}]", i), faults);
    CheckSetup(exercise, faults);
    CheckSteps(exercise, faults);
    for (std::size_t i = 0; i < exercise.avoid.size(); ++i)
      if (FindTarget(exercise, exercise.avoid[i].target) == nullptr)
        faults.Add(
            fmt::format(".avoid[{}].target", i),
            fmt::format("names the target \"{}\", which does not exist", exercise.avoid[i].target));
    CheckCriteria(exercise, faults);
    CheckNeeds(scene, exercise, faults);
  }
  return list;
}

}  // namespace arthro
