#include "app/steps/lessons/author/target_edit.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "app/state/edits.h"
#include "simulation/core/error.h"
#include "simulation/training/observe/exercise_targets.h"

namespace arthro::app {
namespace {

constexpr double kBallAhead = 0.015;  // m in front of the portal, of a ball that lies nowhere yet

// Calls `use` for each name of a target in the step.
template <class Use>
void EachName(ExerciseStep& step, const Use& use) {
  const auto all = [&](std::vector<std::string>& ids) { std::ranges::for_each(ids, use); };
  all(BaseOf(step).targets);
  if (auto* track = std::get_if<TrackStep>(&step)) all(track->path);
  if (auto* follow = std::get_if<FollowStep>(&step)) all(follow->path);
  if (auto* resect = std::get_if<ResectStep>(&step)) all(resect->regions);
  if (auto* recover = std::get_if<RecoverStep>(&step)) use(recover->source);
  if (auto* transfer = std::get_if<TransferStep>(&step)) {
    all(transfer->bodies);
    use(transfer->to);
  }
}

// Lists of the step keep no name that is empty.
void DropEmptyNames(ExerciseStep& step) {
  const auto drop = [](std::vector<std::string>& ids) { std::erase(ids, ""); };
  drop(BaseOf(step).targets);
  if (auto* track = std::get_if<TrackStep>(&step)) drop(track->path);
  if (auto* follow = std::get_if<FollowStep>(&step)) drop(follow->path);
  if (auto* resect = std::get_if<ResectStep>(&step)) drop(resect->regions);
  if (auto* transfer = std::get_if<TransferStep>(&step)) drop(transfer->bodies);
}

void ClearPlace(ExerciseTarget& target) {
  target.bearing.reset(), target.point.reset(), target.ball.reset();
  target.on.clear(), target.regions.clear();
}

// Bearing from the portal of a point in its frame.
glm::dvec2 BearingOf(const glm::dvec3& x) {
  return {std::atan2(-x.y, std::hypot(x.x, x.z)), std::atan2(x.x, x.z)};
}

// Place of the target in the portal frame; nullopt: it lies on nothing.
std::optional<glm::dvec3> PlaceInPortal(const EditorState& state, const ExerciseTarget& target) {
  try {
    Exercise one;
    one.targets = {target};
    const auto place = simulation::PlacesOfTargets(state.document(), one).front();
    if (place.tissue < 0) return place.point;
    const auto tissue = static_cast<std::size_t>(place.tissue);
    return state.document().scene.tissues[tissue].pose * place.point;
  } catch (const Error&) {
    return std::nullopt;
  }
}

const Tissue* TissueWithRegions(const EditorState& state) {
  const auto& tissues = state.document().scene.tissues;
  const auto found =
      std::ranges::find_if(tissues, [](const Tissue& t) { return !t.regions.empty(); });
  return found == tissues.end() ? nullptr : &*found;
}

}  // namespace

TargetPlacing PlacingOf(const ExerciseTarget& target) {
  if (target.ball) return TargetPlacing::kBall;
  return target.regions.empty() ? TargetPlacing::kSurface : TargetPlacing::kRegions;
}

void AddTarget(EditorState& state) {
  const Exercise* exercise = ChosenExercise(state);
  if (exercise->targets.size() >= kMostTargets) {
    state.message = fmt::format("An exercise has at most {} targets.", kMostTargets);
    return;
  }
  EditExercise(state, "New target", "", [](Exercise& changed) {
    std::vector<std::string> ids;
    for (const ExerciseTarget& target : changed.targets) ids.push_back(target.id);
    ExerciseTarget target;
    target.id = FreeName(ids, "target");
    target.bearing = glm::dvec2(0.0);
    changed.targets.push_back(target);
  });
  LessonsStep& step = *state.steps.lessons;
  step.target = static_cast<int>(ChosenExercise(state)->targets.size()) - 1;
  step.takes_target = true;
  state.message = "Click where the target lies, in the scope's picture or in the overview.";
}

void SetTargetPlacing(EditorState& state, int target, TargetPlacing placing) {
  const ExerciseTarget before = ChosenExercise(state)->targets[static_cast<std::size_t>(target)];
  if (PlacingOf(before) == placing) return;
  const Tissue* with_regions = TissueWithRegions(state);
  if (placing == TargetPlacing::kRegions && with_regions == nullptr) {
    state.message = "No tissue has a region yet. Make one on the Cut page of a tissue.";
    return;
  }
  const glm::dvec3 place = PlaceInPortal(state, before).value_or(glm::dvec3(0, 0, kBallAhead));
  EditExercise(state, "Kind of target", "", [&](Exercise& changed) {
    ExerciseTarget& placed = changed.targets[static_cast<std::size_t>(target)];
    ClearPlace(placed);
    if (placing == TargetPlacing::kBall) placed.ball = place;
    if (placing == TargetPlacing::kSurface) placed.bearing = BearingOf(place);
    if (placing == TargetPlacing::kRegions) {
      placed.on = with_regions->name;
      placed.regions = {with_regions->regions.front().name};
      placed.is_loose = false;
    }
  });
  if (placing == TargetPlacing::kRegions) state.steps.lessons->takes_target = false;
}

void RemoveTarget(EditorState& state, int target) {
  const Exercise& exercise = *ChosenExercise(state);
  const std::string& own = exercise.targets[static_cast<std::size_t>(target)].id;
  for (std::size_t i = 0; i < exercise.steps.size(); ++i) {
    const auto* transfer = std::get_if<TransferStep>(&exercise.steps[i]);
    const auto* recover = std::get_if<RecoverStep>(&exercise.steps[i]);
    if ((transfer == nullptr || transfer->to != own) &&
        (recover == nullptr || recover->source != own))
      continue;
    state.message =
        fmt::format("Step {} needs this target. Choose another one there first.", i + 1);
    return;
  }
  EditExercise(state, "Remove target", "", [&](Exercise& changed) {
    const std::string id = changed.targets[static_cast<std::size_t>(target)].id;
    changed.targets.erase(changed.targets.begin() + target);
    for (ExerciseStep& step : changed.steps) {
      EachName(step, [&](std::string& name) {
        if (name == id) name.clear();
      });
      DropEmptyNames(step);
    }
    std::erase_if(changed.avoid, [&](const AvoidZone& zone) { return zone.target == id; });
  });
  state.steps.lessons->target = state.steps.lessons->zone = -1;
  state.steps.lessons->takes_target = false;
}

void RenameTarget(EditorState& state, int target, const std::string& name) {
  const auto& targets = ChosenExercise(state)->targets;
  const std::string old = targets[static_cast<std::size_t>(target)].id;
  if (name == old) return;
  if (name.empty() || std::ranges::count(targets, name, &ExerciseTarget::id) > 0) {
    state.message = name.empty() ? "A target needs a name."
                                 : fmt::format("Another target is called \"{}\".", name);
    return;
  }
  EditExercise(state, "Rename target", "", [&](Exercise& changed) {
    const auto rename = [&](std::string& id) {
      if (id == old) id = name;
    };
    rename(changed.targets[static_cast<std::size_t>(target)].id);
    for (AvoidZone& zone : changed.avoid) rename(zone.target);
    for (ExerciseStep& step : changed.steps) EachName(step, rename);
  });
}

bool TakesTarget(const EditorState& state) {
  return state.steps.lessons->takes_target && HasExercise(state) &&
         state.step == Step::kExercises && state.steps.lessons->target >= 0;
}

void PlaceTarget(EditorState& state, const authoring::Sight& sight,
                 const std::optional<TissueHit>& hit) {
  const auto relief = authoring::PointOnRelief(state.document(), sight);
  const auto& tissues = state.document().scene.tissues;
  const auto distance = [&](const glm::dvec3& x) {
    return glm::dot(x - sight.eye, sight.direction);
  };
  const Tissue* tissue = hit ? &tissues[static_cast<std::size_t>(hit->tissue)] : nullptr;
  const bool is_on_tissue =
      tissue != nullptr &&
      (!relief || distance(tissue->pose * hit->x_in_tissue) < distance(relief->x_in_portal));
  if (!is_on_tissue && !relief) {
    state.message = authoring::kNothingImaged;
    return;
  }
  const auto target = static_cast<std::size_t>(state.steps.lessons->target);
  const bool is_ball = ChosenExercise(state)->targets[target].ball.has_value();
  EditExercise(state, "Place target", "", [&](Exercise& changed) {
    ExerciseTarget& placed = changed.targets[target];
    ClearPlace(placed);
    if (is_ball) {
      placed.ball = is_on_tissue ? tissue->pose * hit->x_in_tissue : relief->x_in_portal;
    } else if (is_on_tissue) {
      placed.on = tissue->name;
      placed.point = hit->x_in_tissue;
    } else {
      placed.bearing = BearingOf(relief->x_in_portal);
    }
  });
  state.steps.lessons->takes_target = false;
  state.message = is_ball        ? std::string("The middle of the ball lies there.")
                  : is_on_tissue ? "The target lies on \"" + tissue->name + "\" and moves with it."
                                 : std::string("The target lies on the relief.");
}

}  // namespace arthro::app
