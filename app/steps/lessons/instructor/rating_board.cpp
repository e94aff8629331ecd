#include "app/steps/lessons/instructor/rating_board.h"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "app/platform/resource_folder.h"
#include "app/steps/lessons/instructor/cohort_board.h"
#include "app/steps/lessons/keeping/lesson_records.h"
#include "app/steps/lessons/value_words.h"
#include "simulation/core/error.h"

namespace arthro::app {

bool MayRate(const EditorState& state) {
  const LessonsStep& step = *state.steps.lessons;
  return !state.practice && step.page == LessonPage::kDebrief && step.finished &&
         !step.finished->id.empty() && step.records->open != nullptr;
}

namespace {

// An empty form of the same rater.
void ShowForm(RatingBoard& board) {
  if (board.forms.empty()) board.forms = ReadForms(ResourceFolder() / "forms");
  const std::string rater = board.filled.rater;
  board.filled = {};
  board.filled.rater = rater;
  board.kept.clear();
  board.is_shown = !board.forms.empty();
}

}  // namespace

void ToggleRating(EditorState& state) {
  RatingBoard& board = *state.steps.lessons->rating;
  if (board.is_shown)
    board.is_shown = false;
  else
    ShowForm(board);
}

bool IsBlinded(const EditorState& state) {
  const LessonsStep& step = *state.steps.lessons;
  return step.finished && !step.finished->id.empty() &&
         step.finished->id == step.rating->blinded_attempt;
}

bool MayRateBlinded(const EditorState& state) {
  const LessonsStep& step = *state.steps.lessons;
  return !state.practice && step.records->open != nullptr &&
         (step.page == LessonPage::kInstructor || step.page == LessonPage::kDebrief) &&
         !IsBlinded(state) && step.cohort->exercise >= 0 &&
         step.cohort->exercise < static_cast<int>(step.cohort->hashes.size());
}

void RateBlinded(EditorState& state) {
  LessonsStep& step = *state.steps.lessons;
  RatingBoard& board = *step.rating;
  Records& records = *step.records->open;
  if (board.filled.rater.empty()) board.filled.rater = step.cohort->who;
  auto attempts =
      UnratedAttempts(records, step.cohort->hashes[static_cast<std::size_t>(step.cohort->exercise)],
                      step.cohort->choice.cohort, board.filled.rater);
  // Only what was observed can be looked back at.
  std::erase_if(attempts, [&](const UnratedAttempt& attempt) {
    std::error_code ignored;
    return !std::filesystem::exists(records.folder() / attempt.log, ignored);
  });
  if (attempts.empty())
    throw Error(Code::kBadArgument,
                "no attempt at this exercise is left to rate on this station; choose another "
                "exercise or cohort");
  Random random = RandomFromSystem();
  const std::string id = attempts[random.Below(attempts.size())].id;
  ShowStoredAttempt(state, id);
  board.blinded_attempt = id;
  step.page = LessonPage::kDebrief;
  ShowForm(board);
  state.message = fmt::format("One of {} attempts that this rater has not rated.", attempts.size());
}

bool ShowsRating(const EditorState& state) {
  return state.steps.lessons->rating->is_shown && MayRate(state);
}

int ScoreOf(const FormRow& filled, const std::string& item) {
  const auto own = std::ranges::find(filled.items, item, &FormItemRow::item);
  return own == filled.items.end() ? -1 : own->score;
}

void SetScore(FormRow& filled, const std::string& item, int score) {
  const auto own = std::ranges::find(filled.items, item, &FormItemRow::item);
  if (own == filled.items.end())
    filled.items.push_back({item, score});
  else
    own->score = score;
}

bool MayKeepRating(const EditorState& state) {
  const RatingBoard& board = *state.steps.lessons->rating;
  return MayRate(state) && board.is_shown && !board.filled.rater.empty() &&
         !board.filled.items.empty();
}

void KeepRating(EditorState& state) {
  LessonsStep& step = *state.steps.lessons;
  RatingBoard& board = *step.rating;
  const RatingForm& form = board.forms.at(static_cast<std::size_t>(board.form));
  board.filled.attempt = step.finished->id;
  board.filled.blinded = IsBlinded(state);
  AddRating(*step.records->open, form, board.filled);
  const std::size_t left = form.items.size() - board.filled.items.size();
  board.kept = left == 0 ? "The rating is kept with the attempt."
                         : fmt::format("The rating is kept; {} items were left out.", left);
  if (IsPassed(form, board.filled))
    board.kept += fmt::format(" Each item reaches {}, which the form asks for.", form.pass_each);
  if (board.filled.blinded)
    board.kept += fmt::format(" It was blinded: trainee {}, {} UTC.", step.finished->trainee,
                              TimeWords(step.finished->started));
  board.blinded_attempt.clear();
  board.filled.items.clear();
  board.filled.comment.clear();
  state.message = board.kept;
}

}  // namespace arthro::app
