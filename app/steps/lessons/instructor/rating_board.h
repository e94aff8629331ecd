// A rating form beside the look back at an attempt of the records. Forms are data
// (resources/forms); no sum of the scores is formed. A blinded rating is one of an attempt that the
// page has chosen, whose trainee, date, result and earlier ratings it hides until the form is kept.
#pragma once

#include <string>
#include <vector>

#include "app/records/exchange/rating_form.h"
#include "app/steps/lessons/lessons_step.h"

namespace arthro::app {

struct RatingBoard {
  std::vector<RatingForm> forms;
  int form = 0;
  FormRow filled;  // scores so far, rater and comment
  bool is_shown = false;
  std::string kept;             // sentence about what was kept; empty: nothing yet
  std::string blinded_attempt;  // id of the attempt that is rated blinded; empty: none
};

// Score of an item; −1: not rated.
int ScoreOf(const FormRow& filled, const std::string& item);
void SetScore(FormRow& filled, const std::string& item, int score);

}  // namespace arthro::app
