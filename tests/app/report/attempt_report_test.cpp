// The report says what was measured against which limit, and no more.
#include <algorithm>
#include <cctype>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "app/report/assessment_file.h"
#include "app/report/attempt_words.h"
#include "simulation/core/atomic_file.h"
#include "tests/support/sample_report.h"
#include "tests/support/schema_fault.h"

namespace arthro::app {
namespace {

using test::SampleReport;

std::string Lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  return text;
}

TEST(AttemptReport, StatesOutcomeCriteriaAndSources) {
  const std::string page = AttemptPage(SampleReport());
  EXPECT_TRUE(page.starts_with(kAttemptPageHead));
  for (const char* words :
       {"Not passed. The force on the instrument was 9.1 N; 8.5 N are allowed.",
        "Peak force (instrument)", "at most 8.5 N", "✗ not met", "✓ met", "PMC3023859",
        "own start value (start value)", "The tip was never in the joint.", "Not measured"})
    EXPECT_NE(page.find(words), std::string::npos) << words;
}

TEST(AttemptReport, ClaimsNothingAndSumsNothingUp) {
  for (const bool passes : {false, true}) {
    AttemptReport report = SampleReport();
    SetResult(report.attempt, test::SampleResult(74, passes));
    for (const std::string& text : {AttemptPage(report), AttemptJson(report), MetricTable(report)})
      for (const char* word : {"validated", "★", "score", "total", " %", "stars"})
        EXPECT_EQ(Lower(text).find(word), std::string::npos) << word;
  }
}

TEST(AttemptReport, NeedsNoOtherFileAndNoScript) {
  const std::string page = AttemptPage(SampleReport());
  for (const char* word : {"<script", "href=", "src=", "url(", "@import", "javascript"})
    EXPECT_EQ(page.find(word), std::string::npos) << word;
  EXPECT_NE(page.find("size:A4"), std::string::npos);
  EXPECT_EQ(page.find("nan"), std::string::npos);
}

TEST(AttemptReport, ShowsEndsOfStepsAndFaultsInTheOrderOfTime) {
  AttemptRecord attempt;
  attempt.steps = {{"a", "done", 0, 2.0}, {"b", "failed", 2, 9.0}, {"c", "pending", 0, {}}};
  attempt.events = {{3, "zone_in", "b", "ligament", "", {}},
                    {4, "force_over", "b", "", "", 9.5},
                    {5, "cut_outside", "b", "", "", {}}};
  CriterionRow criterion;
  criterion.metric = "peak_force";
  criterion.value = 9.5;
  attempt.criteria = {criterion};
  std::vector<simulation::AttemptFrame> frames(900);
  frames[399].tool[1].peak_force = 9.5F;
  const auto moments = MomentsOf(attempt, frames);
  std::vector<std::string> words;
  for (const ReportMoment& moment : moments) words.push_back(moment.words);
  EXPECT_EQ(words,
            (std::vector<std::string>{"a: done", "zone entered: ligament", "peak force: 9.5 N",
                                      "cut outside of the regions", "b: failed"}));
  EXPECT_FALSE(moments[0].is_fault);
  EXPECT_TRUE(moments[4].is_fault);
  EXPECT_NEAR(moments[2].t, 4, 1e-9);
  criterion.metric = "taken_outside";
  criterion.passed = true;
  attempt.criteria.push_back(criterion);
  EXPECT_EQ(MomentsOf(attempt, frames).size(), 4U) << "the criterion allows what was cut outside";
  attempt.events.assign(40, {3, "drop", "b", "ball", "", {}});
  EXPECT_EQ(MomentsOf(attempt, frames).size(), 2 + kMostFaultPictures);
}

TEST(AttemptReport, NamesEventsAsTheLookBackDoes) {
  AttemptReport report = SampleReport();
  report.attempt.events = {{1, "cue", "a", "", "", {}}, {2, "of_another_version", "a", "", "", {}}};
  const std::string page = AttemptPage(report);
  EXPECT_NE(page.find(">Hint<"), std::string::npos);
  EXPECT_NE(page.find(">of another version<"), std::string::npos);
}

TEST(AttemptReport, HoldsItsPicturesAndTheExpertsValuesItself) {
  AttemptReport report = SampleReport();
  report.pictures = {{{1.5, "s<1>: done", false}, "\xff\xd8\xff"}, {{2, "drop", true}, "Ma"}};
  report.expert = report.attempt.metrics;
  const std::string page = AttemptPage(report);
  EXPECT_NE(page.find("<img alt=\"\" src=\"data:image/jpeg;base64,/9j/\">"), std::string::npos);
  EXPECT_NE(page.find("base64,TWE=\""), std::string::npos);
  EXPECT_NE(page.find("1.5 s, s&lt;1&gt;: done"), std::string::npos);
  EXPECT_NE(page.find("shown at rest"), std::string::npos) << "no tissue was recorded";
  EXPECT_NE(page.find("<th>Expert</th>"), std::string::npos);
  for (std::size_t at = page.find("src="); at != std::string::npos; at = page.find("src=", at + 1))
    EXPECT_EQ(page.substr(at, 10), "src=\"data:");
}

TEST(AttemptReport, EscapesWhatATraineeTyped) {
  AttemptReport report = SampleReport();
  report.goal = "<script>alert(1)</script>";
  report.attempt.events[0].note = "a < b & \"c\"";
  const std::string page = AttemptPage(report);
  EXPECT_EQ(page.find("<script"), std::string::npos);
  EXPECT_NE(page.find("a &lt; b &amp; &quot;c&quot;"), std::string::npos);
}

TEST(AttemptReport, WithoutFramesHasTablesOnly) {
  AttemptReport report = SampleReport();
  report.frames.clear();
  const std::string page = AttemptPage(report);
  EXPECT_EQ(page.find("<h2>Force</h2>"), std::string::npos);
  EXPECT_NE(page.find("<h2>Steps</h2>"), std::string::npos);
}

TEST(AttemptReport, JsonAndTableHaveTheSameValues) {
  const AttemptReport report = SampleReport();
  const auto json = nlohmann::json::parse(AttemptJson(report));
  EXPECT_EQ(json["schema"], "arthroscene.assessment/1");
  EXPECT_EQ(json["outcome"], "failed");
  EXPECT_EQ(json["criteria"][0]["value"], 9.1);
  EXPECT_EQ(json["criteria"][0]["unit"], "N");
  EXPECT_FALSE(json["metrics"][2].contains("value"));
  EXPECT_EQ(json["metrics"][2]["why_none"], "The tip was never in the joint.");
  EXPECT_EQ(json["events"].size(), 4u);
  const std::string table = MetricTable(report);
  EXPECT_NE(table.find("peak_force,instrument,9.1,N,less,,8.5,0,PMC3023859,,\n"), std::string::npos)
      << table;
}

TEST(AttemptReport, JsonFollowsItsSchema) {
  EXPECT_EQ(test::SchemaFault("assessment-1", AttemptJson(SampleReport())), "");
  EXPECT_EQ(ReadWholeFile(std::filesystem::path(ARTHRO_SOURCE_DIR) /
                          "resources/schemas/assessment-1.schema.json"),
            AssessmentSchema())
      << "run `arthroscene records check --assessment-schema > "
         "resources/schemas/assessment-1.schema.json`";
}

// Rows of zeros and of what was not measured filled two of six pages.
TEST(AttemptReport, NamesZerosAndWhatWasNotMeasuredWithoutRows) {
  AttemptReport report = SampleReport();
  report.attempt.metrics = {{"peak_force", "instrument", "N", "", 9.1, 1},
                            {"peak_force", "scope", "N", "", 0.0, 1},
                            {"mean_force", "scope", "N", "the tool touched nothing", {}, 0},
                            {"drops", "instrument", "", "", 0.0, 1},
                            {"contour_error", "instrument", "m", "nothing <was> cut", {}, 0},
                            {"rim_left", "instrument", "m", "nothing <was> cut", {}, 0}};
  std::string page = AttemptPage(report);
  EXPECT_NE(page.find("<td>Peak force (instrument)</td><td>9.1 N</td></tr>"), std::string::npos);
  EXPECT_NE(page.find("<p class=\"small\">Zero: Peak force (scope); Drops (instrument).</p>"),
            std::string::npos);
  EXPECT_NE(
      page.find(
          "<p class=\"small\">Not measured (the tool touched nothing): Mean force (scope).</p>"),
      std::string::npos);
  EXPECT_NE(page.find("<p class=\"small\">Not measured (nothing &lt;was&gt; cut): "),
            std::string::npos);

  // A zero that others can be compared with has a row.
  report.expert = {{"drops", "instrument", "", "", 2.0, 1}};
  page = AttemptPage(report);
  EXPECT_NE(page.find("<td>Drops (instrument)</td><td>0</td><td>2</td></tr>"), std::string::npos);

  report.attempt.metrics.resize(2);
  report.attempt.metrics.erase(report.attempt.metrics.begin());
  report.expert.clear();
  page = AttemptPage(report);
  EXPECT_NE(page.find("<h2>Metrics</h2>\n<p class=\"small\">Zero: Peak force (scope).</p>"),
            std::string::npos);
}

TEST(AttemptReport, ShowsTheMiddleHalfAndZOfAReferenceGroup) {
  AttemptReport report = SampleReport();
  report.group = "experts";
  report.standings = {{"task_time", "both", 6, 60.0, 50.0, 66.0, -1.25}};
  const std::string page = AttemptPage(report);
  EXPECT_NE(page.find("Middle half of experts"), std::string::npos);
  EXPECT_NE(page.find("50 s to 66 s (n = 6), z = -1.2"), std::string::npos) << page;
  const auto json = nlohmann::json::parse(AttemptJson(report));
  EXPECT_EQ(json["metrics"][0]["group"]["median"], 60);
  EXPECT_EQ(json["metrics"][0]["group"]["z"], -1.25);
  EXPECT_FALSE(json["metrics"][1].contains("group"));
}

TEST(AttemptReport, DrawsNoBarForAStepThatWasNeverReached) {
  AttemptReport report = SampleReport();
  report.attempt.steps[1] = {"s2", "pending", 0, {}};
  EXPECT_NE(AttemptPage(report).find("s2: not begun"), std::string::npos);
}

TEST(AttemptReport, OfHandsWithoutAnExerciseHasNoOutcome) {
  AttemptReport report = SampleReport();
  report.exercise = {};
  report.is_mode_known = false;
  report.trainee.clear();
  const std::string page = AttemptPage(report);
  for (const char* word : {"class=\"outcome\"", "Criteria", "Trainee", "Mode"})
    EXPECT_EQ(page.find(word), std::string::npos) << word;
  const auto json = nlohmann::json::parse(AttemptJson(report));
  for (const char* key : {"exercise", "outcome", "mode", "trainee"})
    EXPECT_FALSE(json.contains(key)) << key;
}

TEST(AttemptReport, TenMinutesFitIntoASmallPage) {
  // 60000 frames: the curves are thinned, so that the page opens at once.
  EXPECT_LT(AttemptPage(SampleReport(600)).size(), 1u << 20);
}

TEST(AttemptReport, NamesStepsByNumberAndTitle) {
  AttemptReport report = SampleReport();
  report.steps = {{"s1", {1, "Touch the spine"}}, {"s2", {2, "Press the <edge>"}}};
  const std::string page = AttemptPage(report);
  EXPECT_NE(page.find("1. Touch the spine: done"), std::string::npos);
  EXPECT_NE(page.find("2. Press the &lt;edge&gt;: done"), std::string::npos);
  EXPECT_EQ(page.find("s1"), std::string::npos) << "an id is for files";
  const auto moments = MomentsOf(report.attempt, report.frames, report.steps);
  ASSERT_FALSE(moments.empty());
  EXPECT_EQ(moments[0].words, "1. Touch the spine: done");
}

}  // namespace
}  // namespace arthro::app
