#include "app/records/exchange/rating_form.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "app/records/store/json_file.h"
#include "app/records/store/table.h"
#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"

namespace arthro::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* kSchema = "arthroscene.form/1";

const FormItem* ItemOf(const RatingForm& form, const std::string& id) {
  const auto found = std::find_if(form.items.begin(), form.items.end(),
                                  [&](const FormItem& item) { return item.id == id; });
  return found == form.items.end() ? nullptr : &*found;
}

void CheckItems(const RatingForm& form, const fs::path& file) {
  std::set<std::string> ids;
  for (const FormItem& item : form.items) {
    if (!ids.insert(item.id).second)
      throw Error(Code::kBadData, fmt::format("the item {} comes twice; rename one", item.id),
                  file);
    if (item.least >= item.most)
      throw Error(Code::kBadData,
                  fmt::format("the scores of {} go from {} to {}; the second must be larger",
                              item.id, item.least, item.most),
                  file);
    for (const FormAnchor& anchor : item.anchors)
      if (anchor.score < item.least || anchor.score > item.most)
        throw Error(Code::kBadData,
                    fmt::format("an anchor of {} is at {}, outside of {} to {}", item.id,
                                anchor.score, item.least, item.most),
                    file);
  }
}

}  // namespace

RatingForm FormFromText(std::string_view text, const fs::path& file) {
  RatingForm form = FromJsonFile<RatingForm>(text, kSchema, "a form", file);
  CheckItems(form, file);
  return form;
}

std::string FormText(const RatingForm& form) { return JsonFileText(form, kSchema); }

std::string FormSchema() {
  return JsonFileSchema<RatingForm>(
      kSchema, "Form", "Rating form or questionnaire that a person fills in about an attempt.");
}

std::vector<RatingForm> ReadForms(const fs::path& folder) {
  std::vector<RatingForm> forms;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored))
    if (entry.path().extension() == ".json")
      forms.push_back(FormFromText(ReadWholeFile(entry.path()), entry.path()));
  std::sort(forms.begin(), forms.end(), [](const auto& a, const auto& b) { return a.id < b.id; });
  return forms;
}

void CheckRatings(const RatingForm& form, const FormRow& filled) {
  for (const FormItemRow& rating : filled.items) {
    const FormItem* item = ItemOf(form, rating.item);
    if (item == nullptr)
      throw Error(Code::kBadArgument, fmt::format("the form {} has no item {}; its items are in "
                                                  "resources/forms/{}.json",
                                                  form.id, rating.item, form.id));
    if (rating.score != -1 && (rating.score < item->least || rating.score > item->most))
      throw Error(Code::kBadArgument,
                  fmt::format("the score of {} is {}; it must be between {} and {}", rating.item,
                              rating.score, item->least, item->most));
  }
}

FormRow AddRating(Records& records, const RatingForm& form, FormRow filled) {
  CheckRatings(form, filled);
  filled.id = records.NewId();
  filled.form = form.id;
  filled.form_version = form.version;
  filled.made = records.Now();
  records.database().Write([&] {
    Insert(records.database(), "forms", std::vector{filled});
    Insert(records.database(), "form_items", filled.items, {{"form", filled.id}});
  });
  return filled;
}

std::vector<UnratedAttempt> UnratedAttempts(Records& records, const std::string& exercise_hash,
                                            const std::string& cohort, const std::string& rater) {
  std::vector<UnratedAttempt> attempts;
  for (const Row& row : records.database().Ask(
           R"(SELECT attempts.id, attempts.log FROM attempts
    JOIN trainees ON trainees.id = attempts.trainee
    LEFT JOIN cohorts ON cohorts.id = trainees.cohort
    WHERE attempts.exercise = :exercise AND attempts.mode <> 'robot'
    AND attempts.outcome IN ('passed', 'failed', 'stopped')
    AND (:any = 1 OR cohorts.name = :cohort)
    AND attempts.id NOT IN (SELECT attempt FROM forms WHERE rater = :rater) ORDER BY attempts.id)",
           {exercise_hash, static_cast<std::int64_t>(cohort.empty()), cohort, rater}))
    attempts.push_back({TextOf(row[0]), TextOf(row[1])});
  return attempts;
}

bool IsPassed(const RatingForm& form, const FormRow& filled) {
  return form.pass_each > 0 &&
         std::all_of(form.items.begin(), form.items.end(), [&](const FormItem& item) {
           return std::any_of(filled.items.begin(), filled.items.end(), [&](const auto& rating) {
             return rating.item == item.id && rating.score >= form.pass_each;
           });
         });
}

}  // namespace arthro::app
