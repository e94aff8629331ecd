// Forms that a person fills in about an attempt: rating scales and questionnaires. Forms are data
// (resources/forms): items with anchored scores, and what counts as a pass.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/records/attempts/attempt_record.h"
#include "app/records/store/records.h"
#include "simulation/core/options.h"

namespace arthro::app {

struct FormAnchor {
  int score = 0;
  std::string text;
  template <class V>
  void Visit(V&& v) {
    v("score", score, Range{0, 100}, "", "Score that the words stand for.");
    v("text", text, Any{}, "", "Words for the score; empty for the owner of the form to type.");
  }
};

struct FormItem {
  std::string id, title;
  int least = 1, most = 5;
  std::vector<FormAnchor> anchors;
  template <class V>
  void Visit(V&& v) {
    v("id", id, Required{Any{}}, "", "Id; it stays when the title changes.");
    v("title", title, Any{}, "", "Title; empty for the owner of the form to type.");
    v("least", least, Range{0, 100}, "", "Least score.");
    v("most", most, Range{1, 100}, "", "Largest score.");
    v("anchors", anchors, Any{}, "", "Words for some scores.");
  }
};

struct RatingForm {
  std::string id, title, source, note;
  int version = 1, pass_each = 0;
  std::vector<FormItem> items;
  template <class V>
  void Visit(V&& v) {
    v("id", id, Required{Any{}}, "", "Id of the form.");
    v("version", version, Range{1, 1e6}, "", "Raised by each edit.");
    v("title", title, Required{Any{}}, "", "Title.");
    v("source", source, Any{}, "", "Publication of the form.");
    v("note", note, Any{}, "", "Advice to who fills it in.");
    v("pass_each", pass_each, Range{0, 100}, "",
      "Score that every item must reach for a pass; 0 for a form without a pass.");
    v("items", items, Any{}, "", "Items.");
  }
};

// Throws Error(kBadData) with the first fault: a score outside its range, an id that comes twice.
RatingForm FormFromText(std::string_view text, const std::filesystem::path& file = {});
std::string FormText(const RatingForm& form);
std::string FormSchema();
// Forms of a folder, by id.
std::vector<RatingForm> ReadForms(const std::filesystem::path& folder);

// Throws Error(kBadArgument) for an item that the form does not have or a score outside its range.
void CheckRatings(const RatingForm& form, const FormRow& filled);
// Keeps a filled form with its attempt; gives it an id and a time. Throws as CheckRatings.
FormRow AddRating(Records& records, const RatingForm& form, FormRow filled);
// Attempts at an exercise that are over and that this rater has not rated, of one cohort or of all
// (an empty name), without robots.
struct UnratedAttempt {
  std::string id, log;
};
std::vector<UnratedAttempt> UnratedAttempts(Records& records, const std::string& exercise_hash,
                                            const std::string& cohort, const std::string& rater);
// Every item has its score of a pass. False for a form without a pass, and while an item is
// missing.
bool IsPassed(const RatingForm& form, const FormRow& filled);

}  // namespace arthro::app
