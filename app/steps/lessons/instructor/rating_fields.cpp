// Fields of a rating form, in the place of the events of the look back.
#include <fmt/format.h>
#include <imgui.h>

#include "app/panels/command_button.h"
#include "app/panels/options_panel.h"
#include "app/steps/lessons/instructor/rating_board.h"

namespace arthro::app {
namespace {

std::string TitleOf(const FormItem& item) {
  std::string id = item.id;
  for (char& c : id)
    if (c == '-') c = '_';
  return item.title.empty() ? WordsOfField(id) : item.title;
}

void Item(Ui& ui, FormRow& filled, const FormItem& item) {
  const int score = ScoreOf(filled, item.id);
  Text(ui, TitleOf(item));
  for (int value = item.least; value <= item.most; ++value) {
    if (value > item.least) ImGui::SameLine(0, ui.Px(4));
    if (ToggleButton(ui, fmt::format("{}##{}", value, item.id), score == value, true,
                     {ui.Px(40), ui.Px(32)}))
      SetScore(filled, item.id, value);
  }
  for (const FormAnchor& anchor : item.anchors)
    if (anchor.score == score && !anchor.text.empty()) QuietText(ui, anchor.text);
  Gap(ui, 4);
}

}  // namespace

void RatingFields(Ui& ui, EditorState& state) {
  RatingBoard& board = *state.steps.lessons->rating;
  std::vector<std::string> titles;
  for (const RatingForm& form : board.forms) titles.push_back(form.title);
  int chosen = board.form;
  if (Combo(ui, "Form", chosen, titles)) {
    board.form = chosen;
    board.filled.items.clear();
    board.kept.clear();
  }
  if (board.kept.empty())
    QuietText(ui, IsBlinded(state)
                      ? "Blinded: trainee, date, result and earlier ratings are hidden until the "
                        "rating is kept."
                      : "Not blinded: the page has said whose attempt it is.");
  const RatingForm& form = board.forms.at(static_cast<std::size_t>(board.form));
  QuietText(ui, form.note);
  for (const FormItem& item : form.items) Item(ui, board.filled, item);
  TextField(ui, "Comment", board.filled.comment);
  TextField(ui, "Rater's code", board.filled.rater, "for example I-2");
  if (!board.kept.empty()) ColouredText(ui, board.kept, kGood);
  CommandButton(ui, state, "keep-rating", {-FLT_MIN, ui.Px(40)});
  if (MayRateBlinded(state)) CommandButton(ui, state, "rate-blinded", {-FLT_MIN, ui.Px(40)});
}

}  // namespace arthro::app
