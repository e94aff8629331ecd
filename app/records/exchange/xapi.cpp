#include "app/records/exchange/xapi.h"

#include <algorithm>
#include <map>
#include <regex>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/records/store/utc_time.h"
#include "simulation/core/error.h"

namespace arthro::app {
namespace {

using Json = nlohmann::ordered_json;

// An attempt at an exercise without criteria that ran to its end is completed: nothing was asked.
std::string VerbOf(const AttemptRecord& attempt) {
  if (attempt.criteria.empty()) return "completed";
  return attempt.outcome == AttemptOutcome::kPassed ? "passed" : "failed";
}

// Letters that an address may hold as they are [RFC 3986].
std::string Encoded(const std::string& text) {
  std::string encoded;
  for (const unsigned char c : text)
    if (std::isalnum(c) || c == '-' || c == '.' || c == '_' || c == '~')
      encoded += static_cast<char>(c);
    else
      encoded += fmt::format("%{:02X}", c);
  return encoded;
}

}  // namespace

XapiStatements XapiOf(const RecordsBundle& bundle, const std::string& home) {
  if (!std::regex_match(home, std::regex("https?://[A-Za-z0-9.-]+(:[0-9]+)?(/[A-Za-z0-9._~/-]*)?")))
    throw Error(Code::kBadArgument,
                fmt::format("the home of the statements is \"{}\"; it must be an address such as "
                            "https://lab.example",
                            home));
  const std::string base = home.ends_with('/') ? home.substr(0, home.size() - 1) : home;
  XapiStatements statements;
  Json list = Json::array();
  for (const AttemptRecord& attempt : bundle.attempts) {
    const auto trainee = std::find_if(bundle.trainees.begin(), bundle.trainees.end(),
                                      [&](const auto& row) { return row.id == attempt.trainee; });
    const auto exercise =
        std::find_if(bundle.exercises.begin(), bundle.exercises.end(),
                     [&](const auto& row) { return row.hash == attempt.exercise; });
    const bool is_told =
        attempt.mode != AttemptMode::kRobot && trainee != bundle.trainees.end() &&
        exercise != bundle.exercises.end() &&
        (attempt.outcome == AttemptOutcome::kPassed || attempt.outcome == AttemptOutcome::kFailed);
    if (!is_told) {
      ++statements.left_out;
      continue;
    }
    const std::string verb = VerbOf(attempt);
    Json metrics = Json::object();
    for (const MetricRow& metric : attempt.metrics) {
      Json& entry = metrics[metric.part.empty() ? metric.name : metric.name + "/" + metric.part];
      entry["value"] = metric.value ? Json(*metric.value) : Json();
      entry["unit"] = metric.unit;
      if (!metric.value) entry["why_none"] = metric.why_none;
    }
    const double duration = attempt.duration.value_or(0);
    const std::int64_t ended =
        MillisecondsOf(attempt.started).value_or(0) + static_cast<std::int64_t>(duration * 1000);
    Json& own = list.emplace_back();
    own["id"] = attempt.id;
    own["actor"] = {{"objectType", "Agent"},
                    {"account", {{"homePage", base}, {"name", trainee->code}}}};
    own["verb"] = {{"id", "http://adlnet.gov/expapi/verbs/" + verb}, {"display", {{"en", verb}}}};
    own["object"] = {{"objectType", "Activity"},
                     {"id", fmt::format("{}/exercises/{}/versions/{}", base, Encoded(exercise->id),
                                        exercise->version)},
                     {"definition",
                      {{"type", "http://adlnet.gov/expapi/activities/simulation"},
                       {"name", {{"en", exercise->title}}}}}};
    own["result"]["completion"] = true;
    if (verb != "completed") own["result"]["success"] = verb == "passed";
    own["result"]["duration"] = fmt::format("PT{:.2f}S", duration);
    own["result"]["extensions"][base + "/metrics"] = metrics;
    own["context"]["platform"] = "Arthroscene";
    own["context"]["extensions"][base + "/attempt"] = {{"mode", ToString(attempt.mode)},
                                                       {"scene", attempt.scene},
                                                       {"metrics_version", attempt.metrics_version},
                                                       {"exercise_hash", attempt.exercise}};
    own["timestamp"] = UtcText(ended);
  }
  statements.text = list.dump(2) + "\n";
  return statements;
}

}  // namespace arthro::app
