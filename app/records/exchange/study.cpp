#include "app/records/exchange/study.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "app/records/store/records.h"
#include "app/records/store/utc_time.h"

namespace arthro::app {
namespace {

// Every attempt of a trainee is as long after this time as it was after the first one.
constexpr std::int64_t kEarliest = 946684800000;  // ms; 2000-01-01T00:00:00.000Z

class Pseudonyms {
 public:
  Pseudonyms(std::uint64_t seed, const char* letter) : random_(seed), letter_(letter) {}

  // Names in a random order, so that their order tells nothing.
  void Take(std::vector<std::string> names) {
    std::sort(names.begin(), names.end());
    names.erase(std::unique(names.begin(), names.end()), names.end());
    for (std::size_t i = names.size(); i > 1; --i) std::swap(names[i - 1], names[random_.Below(i)]);
    for (std::size_t i = 0; i < names.size(); ++i)
      given_[names[i]] = fmt::format("{}-{:03}", letter_, i + 1);
  }
  std::string operator()(const std::string& name) const {
    return name.empty() ? name : given_.at(name);
  }

 private:
  Random random_;
  const char* letter_;
  std::map<std::string, std::string> given_;
};

template <class T>
std::vector<std::string> All(const std::vector<T>& rows, std::string T::*field) {
  std::vector<std::string> names;
  for (const T& row : rows)
    if (!(row.*field).empty()) names.push_back(row.*field);
  return names;
}

}  // namespace

RecordsBundle ForStudy(RecordsBundle bundle, std::uint64_t seed) {
  Pseudonyms codes(seed, "S"), cohorts(seed + 1, "C"), raters(seed + 2, "R");
  codes.Take(All(bundle.trainees, &TraineeRow::code));
  cohorts.Take(All(bundle.cohorts, &CohortRow::name));
  raters.Take(All(bundle.forms, &FormRow::rater));
  Random random(seed + 3);
  std::map<std::string, std::string> ids;
  const auto new_id = [&](std::string& id) {
    if (id.empty()) return;
    std::string& own = ids[id];
    if (own.empty()) own = UuidOf(random);
    id = own;
  };
  std::map<std::string, std::int64_t> first;  // ms, of each trainee
  const auto note = [&](const std::string& trainee, const std::string& time) {
    const std::int64_t ms = MillisecondsOf(time).value_or(kEarliest);
    const auto [entry, is_new] = first.emplace(trainee, ms);
    if (!is_new) entry->second = std::min(entry->second, ms);
  };
  for (const AttemptRecord& attempt : bundle.attempts) note(attempt.trainee, attempt.started);
  for (const SessionRow& session : bundle.sessions) note(session.trainee, session.started);
  const auto shift = [&](const std::string& trainee, std::string& time) {
    if (const auto ms = MillisecondsOf(time)) time = UtcText(kEarliest + *ms - first[trainee]);
  };
  std::map<std::string, std::string> trainee_of;  // attempt -> trainee, by the old ids
  for (AttemptRecord& attempt : bundle.attempts) {
    trainee_of[attempt.id] = attempt.trainee;
    shift(attempt.trainee, attempt.started);
    attempt.log.clear();
    attempt.log_sha256.clear();
    attempt.log_bytes = -1;
    for (EventRow& event : attempt.events) event.note.clear();
  }
  for (FormRow& form : bundle.forms) {
    shift(trainee_of[form.attempt], form.made);
    form.rater = raters(form.rater);
    form.comment.clear();
    new_id(form.id);
    new_id(form.attempt);
  }
  for (SessionRow& session : bundle.sessions) {
    shift(session.trainee, session.started);
    shift(session.trainee, session.ended);
    session.station.clear();
    new_id(session.id);
    new_id(session.trainee);
  }
  for (AttemptRecord& attempt : bundle.attempts) {
    new_id(attempt.id);
    new_id(attempt.session);
    new_id(attempt.trainee);
  }
  for (TraineeRow& trainee : bundle.trainees) {
    trainee.code = codes(trainee.code);
    trainee.created = UtcText(kEarliest);
    new_id(trainee.id);
    new_id(trainee.cohort);
  }
  for (CohortRow& cohort : bundle.cohorts) {
    cohort.name = cohorts(cohort.name);
    new_id(cohort.id);
  }
  const auto by = [](auto& rows, auto key) {
    std::sort(rows.begin(), rows.end(),
              [&](const auto& a, const auto& b) { return a.*key < b.*key; });
  };
  by(bundle.trainees, &TraineeRow::code);
  by(bundle.cohorts, &CohortRow::name);
  by(bundle.sessions, &SessionRow::id);
  by(bundle.attempts, &AttemptRecord::id);
  by(bundle.forms, &FormRow::id);
  return bundle;
}

}  // namespace arthro::app
