#include "app/records/people/reference_groups.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/records/store/table.h"
#include "simulation/core/error.h"
#include "simulation/core/json_text.h"

namespace arthro::app {
namespace {

std::string RuleText(const ReferenceRule& rule) {
  return nlohmann::ordered_json{{"trainees", rule.trainees},
                                {"mode", rule.mode},
                                {"rig", rule.rig},
                                {"last_only", rule.is_last_only}}
      .dump();
}

ReferenceRule RuleOf(const std::string& text) {
  const nlohmann::json json = ParseJson(text, Code::kBadData);
  return {json.value("trainees", std::vector<std::string>{}), json.value("mode", "test"),
          json.value("rig", ""), json.value("last_only", true)};
}

// Quantile of sorted values by linear interpolation (type 7) [Hyndman & Fan 1996].
double Quantile(const std::vector<double>& sorted, double share) {
  const double at = share * static_cast<double>(sorted.size() - 1);
  const auto low = static_cast<std::size_t>(at);
  const std::size_t high = std::min(low + 1, sorted.size() - 1);
  return sorted[low] + (at - static_cast<double>(low)) * (sorted[high] - sorted[low]);
}

ReferenceValueRow Summary(const std::string& metric, const std::string& part,
                          std::vector<double> values) {
  ReferenceValueRow row{metric, part, static_cast<int>(values.size()), {}, {}, {}, {}, {}};
  if (values.empty()) return row;
  std::sort(values.begin(), values.end());
  const auto n = static_cast<double>(values.size());
  double sum = 0, squares = 0;
  for (const double value : values) sum += value;
  row.mean = sum / n;
  for (const double value : values) squares += (value - *row.mean) * (value - *row.mean);
  if (values.size() > 1) row.sd = std::sqrt(squares / (n - 1));
  row.median = Quantile(values, 0.5);
  row.q1 = Quantile(values, 0.25);
  row.q3 = Quantile(values, 0.75);
  return row;
}

struct Counted {
  std::set<std::string> attempts;
  int metrics_version = -1;
};

Counted AttemptsThatCount(Records& records, const std::string& exercise,
                          const ReferenceRule& rule) {
  Counted counted;
  std::map<std::string, std::string> last;  // trainee -> attempt
  for (const std::string& code : rule.trainees)
    for (const Row& row :
         records.database().Ask(R"(SELECT attempts.id, attempts.metrics_version FROM attempts
    JOIN trainees ON trainees.id = attempts.trainee
    JOIN sessions ON sessions.id = attempts.session
    WHERE trainees.code = :code AND attempts.exercise = :exercise
    AND attempts.mode = :mode AND sessions.rig = :rig
    AND attempts.outcome IN ('passed', 'failed')
    ORDER BY attempts.started, attempts.id)",
                                {code, exercise, rule.mode, rule.rig})) {
      const int version = static_cast<int>(WholeOf(row[1]));
      if (counted.metrics_version >= 0 && counted.metrics_version != version)
        throw Error(Code::kBadData,
                    fmt::format("the attempts of this group have metrics of versions {} and {}; "
                                "assess the older ones again",
                                counted.metrics_version, version));
      counted.metrics_version = version;
      if (rule.is_last_only && last.contains(code)) counted.attempts.erase(last[code]);
      counted.attempts.insert(last[code] = TextOf(row[0]));
    }
  return counted;
}

MetricValues ValuesOf(Database& database, const Counted& counted) {
  MetricValues values;
  for (const std::string& attempt : counted.attempts)
    for (const Row& row : database.Ask(
             "SELECT name, part, value FROM metrics WHERE attempt = :attempt", {attempt})) {
      auto& list = values[{TextOf(row[0]), TextOf(row[1])}];
      if (!std::holds_alternative<std::monostate>(row[2])) list.push_back(NumberOf(row[2]));
    }
  return values;
}

void Remove(Records& records, const std::string& id) {
  records.database().Do("DELETE FROM reference_values WHERE grp = :id", {{id}});
  records.database().Do("DELETE FROM reference_groups WHERE id = :id", {{id}});
}

// Within a transaction; empty without an attempt that counts.
std::optional<ReferenceGroup> Compute(Records& records, const std::string& name,
                                      const std::string& exercise, const ReferenceRule& rule) {
  Database& database = records.database();
  for (const Row& row : database.Ask(
           "SELECT id, rule FROM reference_groups WHERE name = :name AND exercise = :exercise",
           {name, exercise}))
    if (RuleOf(TextOf(row[1])).rig == rule.rig) Remove(records, TextOf(row[0]));
  const Counted counted = AttemptsThatCount(records, exercise, rule);
  if (counted.attempts.empty()) return std::nullopt;
  MetricValues values = ValuesOf(database, counted);
  ReferenceGroup group{records.NewId(),         name, exercise, RuleText(rule), records.Now(),
                       counted.metrics_version, {}};
  for (auto& [key, list] : values)
    group.values.push_back(Summary(key.first, key.second, std::move(list)));
  Insert(database, "reference_groups", std::vector{group});
  Insert(database, "reference_values", group.values, {{"grp", group.id}});
  return group;
}

// Groups with their values in two statements. `where`: a condition on the groups.
std::vector<ReferenceGroup> GroupsWhere(Records& records, const std::string& where,
                                        const Row& values) {
  auto groups = Select<ReferenceGroup>(records.database(), "reference_groups",
                                       where + " ORDER BY name, made", values);
  std::map<std::string, ReferenceGroup*> by_id;
  for (ReferenceGroup& group : groups) by_id[group.id] = &group;
  for (Row& row : records.database().Ask(
           fmt::format("SELECT grp, {} FROM reference_values WHERE grp IN (SELECT id FROM "
                       "reference_groups {}) ORDER BY grp, metric, part",
                       fmt::join(ColumnsOf<ReferenceValueRow>(), ", "), where),
           values)) {
    const auto group = by_id.find(TextOf(row[0]));
    if (group == by_id.end()) continue;
    row.erase(row.begin());
    group->second->values.emplace_back().Visit(internal::RowReader{row});
  }
  return groups;
}

}  // namespace

std::string RigOf(const ReferenceGroup& group) { return RuleOf(group.rule).rig; }

ReferenceGroup MakeReferenceGroup(Records& records, const std::string& name,
                                  const std::string& exercise_hash, const ReferenceRule& rule) {
  std::optional<ReferenceGroup> group;
  records.database().Write([&] {
    group = Compute(records, name, exercise_hash, rule);
    if (!group)
      throw Error(
          Code::kBadArgument,
          fmt::format("no attempt counts for the group {}: {} trainees, mode {}, rig \"{}\"; "
                      "check the codes, the mode and the rig",
                      name, rule.trainees.size(), rule.mode, rule.rig));
  });
  return *group;
}

std::vector<ReferenceGroup> ReferenceGroupsOf(Records& records) {
  return GroupsWhere(records, "", {});
}

std::vector<ReferenceGroup> ReferenceGroupsAt(Records& records, const std::string& exercise_hash,
                                              int metrics_version, const std::string& rig) {
  auto groups = GroupsWhere(records, "WHERE exercise = :exercise AND metrics_version = :version",
                            {exercise_hash, static_cast<std::int64_t>(metrics_version)});
  std::erase_if(groups, [&](const ReferenceGroup& group) { return RigOf(group) != rig; });
  return groups;
}

MetricValues MemberValues(Records& records, const ReferenceGroup& group) {
  return ValuesOf(records.database(),
                  AttemptsThatCount(records, group.exercise, RuleOf(group.rule)));
}

std::vector<std::string> PassedAttemptsOf(Records& records, const ReferenceGroup& group) {
  const Counted counted = AttemptsThatCount(records, group.exercise, RuleOf(group.rule));
  std::vector<std::string> passed;
  for (const Row& row : records.database().Ask(
           "SELECT id FROM attempts WHERE exercise = :exercise AND outcome = 'passed' "
           "ORDER BY started DESC, id",
           {group.exercise}))
    if (counted.attempts.contains(TextOf(row[0]))) passed.push_back(TextOf(row[0]));
  return passed;
}

std::vector<std::string> UpdateGroupsWithout(Records& records, const std::string& code) {
  std::vector<std::string> names;
  for (const ReferenceGroup& group :
       Select<ReferenceGroup>(records.database(), "reference_groups", "ORDER BY name, made")) {
    ReferenceRule rule = RuleOf(group.rule);
    if (std::erase(rule.trainees, code) == 0) continue;
    Compute(records, group.name, group.exercise, rule);
    names.push_back(group.name);
  }
  return names;
}

}  // namespace arthro::app
