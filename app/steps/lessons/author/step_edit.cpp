#include "app/steps/lessons/author/step_edit.h"

#include <algorithm>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "app/state/capital.h"
#include "simulation/scene/files/exercise_check.h"

namespace arthro::app {
namespace {

constexpr double kHintAfter = 20;  // s, as in the exercises of the demo scene

template <std::size_t... kinds>
ExerciseStep StepOfKind(int kind, std::index_sequence<kinds...>) {
  ExerciseStep step;
  ((static_cast<int>(kinds) == kind ? void(step = std::variant_alternative_t<kinds, ExerciseStep>())
                                    : void()),
   ...);
  return step;
}

// Targets of the exercise for a list of a step, at most `most` of them.
std::vector<std::string> Suited(const Exercise& exercise, const std::string& key,
                                std::size_t most = kMostTargets) {
  std::vector<std::string> ids;
  for (const ExerciseTarget& target : exercise.targets)
    if (ids.size() < most && TakesInto(key, target)) ids.push_back(target.id);
  return ids;
}

std::string FirstSuited(const Exercise& exercise, const std::string& key) {
  const auto ids = Suited(exercise, key, 1);
  return ids.empty() ? "" : ids.front();
}

// First values of a step that is added to the exercise.
struct FirstValues {
  const Exercise& exercise;
  void operator()(SeeStep& step) const {
    for (const ExerciseTarget& target : exercise.targets) step.targets.push_back(target.id);
  }
  void operator()(TelescopeStep& step) const { step.targets = Suited(exercise, "targets", 1); }
  void operator()(MeasureStep& step) const { step.targets = Suited(exercise, "targets", 2); }
  void operator()(TrackStep& step) const { step.path = Suited(exercise, "path"); }
  void operator()(FollowStep& step) const { step.path = Suited(exercise, "path"); }
  void operator()(TransferStep& step) const {
    step.bodies = Suited(exercise, "bodies");
    step.to = FirstSuited(exercise, "to");
  }
  void operator()(ResectStep& step) const { step.regions = Suited(exercise, "regions"); }
  void operator()(RecoverStep& step) const { step.source = FirstSuited(exercise, "source"); }
  void operator()(AnswerStep& step) const {
    step.question = "Which answer is right?";
    step.choices = {{"The first", ""}, {"The second", ""}};
  }
  void operator()(StepBase& step) const { step.targets = Suited(exercise, "targets"); }
};

constexpr std::pair<std::string_view, const char*> kFieldWords[] = {
    {"targets", "Targets of the step"},
    {"path", "Path"},
    {"bodies", "Loose bodies"},
    {"to", "Bring them to"},
    {"source", "Bleeding from"},
    {"regions", "Regions"},
    {"choices", "Answers"},
    {"next.done", "After success"},
    {"next.failed", "After failure"},
    {"next", "After success"},
};

// The fault with the words of the page in place of its key in the file: "\"Path\" names 0 targets;
// …" of "exercises[1].steps[2].path names 0 targets; …".
std::string Sentence(const std::string& fault, std::size_t key) {
  const std::size_t begin = fault.find_first_not_of('.', key), end = fault.find(' ', key);
  if (end == std::string::npos || begin >= end) return Capital(fault.substr(begin)) + ".";
  return fmt::format("\"{}\"{}.", WordsOfStepField(fault.substr(begin, end - begin)),
                     fault.substr(end));
}

// Sentences about what lies below `key` of the chosen exercise. Their words begin after `hidden`,
// which is the begin of that key.
std::vector<std::string> FaultsOfChosen(const EditorState& state, const std::string& key,
                                        const std::string& hidden) {
  const std::string exercise = fmt::format("exercises[{}]", state.steps.lessons->chosen);
  std::vector<std::string> sentences;
  for (const std::string& fault : ExerciseFaults(state.document().scene))
    if (fault.starts_with(exercise + key))
      sentences.push_back(Sentence(fault, exercise.size() + hidden.size()));
  return sentences;
}

}  // namespace

std::string WordsOfStepField(const std::string& key) {
  for (const auto& [known, words] : kFieldWords)
    if (known == key) return words;
  std::string words = Capital(key);
  std::ranges::replace(words, '_', ' ');
  return words;
}

bool TakesInto(const std::string& key, const ExerciseTarget& target) {
  if (key == "regions") return !target.regions.empty();
  if (key == "bodies") return target.is_loose;
  if (key == "to" || key == "source") return target.regions.empty() && !target.is_loose;
  return target.regions.empty();
}

bool UsesTargets(const ExerciseStep& step) {
  return !std::holds_alternative<TrackStep>(step) && !std::holds_alternative<FollowStep>(step) &&
         !std::holds_alternative<TransferStep>(step) && !std::holds_alternative<ResectStep>(step) &&
         !std::holds_alternative<RecoverStep>(step);
}

void AddStep(EditorState& state, int kind) {
  const ExerciseStep first =
      StepOfKind(kind, std::make_index_sequence<std::variant_size_v<ExerciseStep>>());
  const bool needs_goal =
      std::holds_alternative<TransferStep>(first) || std::holds_alternative<RecoverStep>(first);
  if (needs_goal && FirstSuited(*ChosenExercise(state), "to").empty()) {
    state.message = "This kind of step needs a target. First add one that is no loose body.";
    return;
  }
  EditExercise(state, "New step", "", [&](Exercise& changed) {
    ExerciseStep step = first;
    std::visit(FirstValues{changed}, step);
    std::vector<std::string> ids;
    for (const ExerciseStep& other : changed.steps) ids.push_back(BaseOf(other).id);
    StepBase& base = BaseOf(step);
    base.id = FreeName(ids, "step");
    base.cue = CueKind::kOutline;
    base.cue_after = kHintAfter;
    changed.steps.push_back(std::move(step));
  });
  state.steps.lessons->step = static_cast<int>(ChosenExercise(state)->steps.size()) - 1;
}

void SetCue(EditorState& state, int step, CueKind cue) {
  EditExercise(state, "Hint of the step", "", [&](Exercise& changed) {
    StepBase& base = BaseOf(changed.steps[static_cast<std::size_t>(step)]);
    base.cue = cue;
    if (cue == CueKind::kNone) base.cue_after = 0;
    if (cue != CueKind::kNone && base.cue_after == 0) base.cue_after = kHintAfter;
  });
}

void RemoveStep(EditorState& state, int step) {
  EditExercise(state, "Remove step", "", [&](Exercise& changed) {
    const std::string id = BaseOf(changed.steps[static_cast<std::size_t>(step)]).id;
    changed.steps.erase(changed.steps.begin() + step);
    const auto forget = [&](std::string& next) {
      if (next == id) next.clear();
    };
    for (ExerciseStep& other : changed.steps) {
      forget(BaseOf(other).next.done);
      forget(BaseOf(other).next.failed);
      if (auto* answer = std::get_if<AnswerStep>(&other))
        for (AnswerChoice& choice : answer->choices) forget(choice.next);
    }
  });
  state.steps.lessons->step = -1;
}

void MoveStep(EditorState& state, int step, int by) {
  const int other = step + by;
  if (other < 0 || other >= static_cast<int>(ChosenExercise(state)->steps.size())) return;
  EditExercise(state, "Move step", "", [&](Exercise& changed) {
    std::swap(changed.steps[static_cast<std::size_t>(step)],
              changed.steps[static_cast<std::size_t>(other)]);
  });
  state.steps.lessons->step = other;
}

std::vector<std::string> LacksOfStep(const EditorState& state, std::size_t step) {
  const std::string key = fmt::format(".steps[{}]", step);
  return FaultsOfChosen(state, key, key);
}

std::vector<std::string> LacksOfExercise(const EditorState& state) {
  std::vector<std::string> sentences;
  const Exercise& exercise = *ChosenExercise(state);
  for (std::size_t i = 0; i < exercise.steps.size(); ++i)
    for (const std::string& sentence : LacksOfStep(state, i))
      sentences.push_back(fmt::format("Step {}: {}", i + 1, sentence));
  for (const char* key : {".targets", ".avoid", ".criteria", ".setup", ".needs"})
    for (const std::string& sentence : FaultsOfChosen(state, key, ""))
      sentences.push_back(sentence);
  return sentences;
}

}  // namespace arthro::app
