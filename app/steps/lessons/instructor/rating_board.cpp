#include "app/steps/lessons/instructor/rating_board.h"

#include <algorithm>

#include <fmt/format.h>

#include "app/platform/resource_folder.h"
#include "app/steps/lessons/keeping/lesson_records.h"

namespace arthro::app {

bool MayRate(const EditorState& state) {
  const LessonsStep& step = *state.steps.lessons;
  return !state.practice && step.page == LessonPage::kDebrief && step.finished &&
         !step.finished->id.empty() && step.records->open != nullptr;
}

void ToggleRating(EditorState& state) {
  RatingBoard& board = *state.steps.lessons->rating;
  if (board.forms.empty()) board.forms = ReadForms(ResourceFolder() / "forms");
  const std::string rater = board.filled.rater;
  const bool is_blinded = board.filled.blinded;
  board.filled = {};
  board.filled.rater = rater;
  board.filled.blinded = is_blinded;
  board.kept.clear();
  board.is_shown = !board.is_shown && !board.forms.empty();
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
  AddRating(*step.records->open, form, board.filled);
  const std::size_t left = form.items.size() - board.filled.items.size();
  board.kept = left == 0 ? "The rating is kept with the attempt."
                         : fmt::format("The rating is kept; {} items were left out.", left);
  if (IsPassed(form, board.filled))
    board.kept += fmt::format(" Each item reaches {}, which the form asks for.", form.pass_each);
  board.filled.items.clear();
  board.filled.comment.clear();
  state.message = board.kept;
}

}  // namespace arthro::app
