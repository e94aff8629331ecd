// The first hour as a conversation, with a computed person at a simulated device.
#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "app/cli/measuring/first_hour.h"
#include "tests/support/tried_hand.h"

namespace arthro::app {
namespace {

using simulation::HourStep;

// Answers by the words of a question, takes and releases the button, pulls and plugs the cable.
struct ComputedPerson {
  test::TriedHand hand;
  std::map<std::string, std::string> answers;  // key: part of the question
  std::string told, last;
  int asked = 0;

  ComputedPerson() {
    answers = {{"a button that you can hold", "yes"},
               {"push or buzz", "no"},
               {"Did the push end", "yes"},
               {"Go on", "no"}};
  }

  std::string Answer(const std::string& question) {
    last = question;
    ++asked;
    begin_ = hand.now;
    if (question.starts_with("Plug the cable in")) hand.device.SetPlugged(true);
    for (const auto& [part, answer] : answers)
      if (question.find(part) != std::string::npos) return answer;
    if (question.starts_with("Where did it push")) return ways_[way_++ % ways_.size()];
    if (question.starts_with("Reading in N")) return way_ == 6 ? (++way_, "1.1") : "1.9";
    return "";
  }

  // Before each tick: takes the button after a while, and does what the last question asked for.
  void Act() {
    const double t = hand.now - begin_;
    const bool releases = last.starts_with("Release the button") && t > 2;
    hand.device.SetButtons(t > 0.1 && !releases ? 1 : 0);
    if (last.starts_with("Pull the cable") && t > 2) hand.device.SetPlugged(false);
    if (last.starts_with("Press the emergency") && t > 2) hand.device.SetPlugged(false);
  }

  std::vector<HourRow> Walk() {
    const HourTicks ticks{[this] {
                            hand.now += 0.001;
                            Act();
                            return hand.now;
                          },
                          [] { return false; }};
    return TakeFirstHour(hand.device, ticks,
                         {[this](const std::string& line) { told += line + "\n"; },
                          [this](const std::string& question) { return Answer(question); }});
  }

 private:
  std::vector<std::string> ways_{"right", "left", "up", "down", "to me", "away"};
  std::size_t way_ = 0;
  double begin_ = 0;
};

std::string Words(const std::vector<HourRow>& rows) {
  std::string words;
  for (const HourRow& row : rows)
    words += std::string(ToString(row.step)) + ": " + row.verdict.sentence + "\n";
  return words;
}

TEST(FirstHourWalk, ASoundDevicePassesAllSixStepsByButtonAndByKey) {
  for (const char* has_button : {"yes", "no"}) {
    ComputedPerson person;
    person.answers["a button that you can hold"] = has_button;
    const std::vector<HourRow> rows = person.Walk();
    EXPECT_TRUE(HasPassed(rows)) << has_button << "\n" << Words(rows);
    EXPECT_EQ(person.hand.device.force(), glm::dvec3(0.0));
    const std::string text = RecordText(rows, person.hand.device, "2026-01-31", "Arthroscene 1");
    for (const char* part : {"simulated device", "2026-01-31", "All six steps passed", "signature"})
      EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
    EXPECT_EQ(text.find("not done"), std::string::npos) << text;
  }
}

TEST(FirstHourWalk, AFailedStepEndsTheWalkUnlessThePersonGoesOn) {
  ComputedPerson person;
  person.answers["push or buzz"] = "yes";
  const std::vector<HourRow> rows = person.Walk();
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_FALSE(rows[0].verdict.has_passed);
  const std::string text = RecordText(rows, person.hand.device, "", "");
  EXPECT_NE(text.find("not done    direction"), std::string::npos) << text;
  EXPECT_NE(text.find("give no forces"), std::string::npos) << text;

  ComputedPerson other;
  other.answers["push or buzz"] = "yes";
  other.answers["Go on"] = "yes";
  const std::vector<HourRow> all = other.Walk();
  EXPECT_EQ(all.size(), simulation::kHourSteps.size());
  EXPECT_FALSE(HasPassed(all));
}

TEST(FirstHourWalk, WithoutABalanceTheScaleIsNotPassed) {
  ComputedPerson person;
  person.answers["Reading in N"] = "-";
  const std::vector<HourRow> rows = person.Walk();
  ASSERT_EQ(rows.size(), 3u) << Words(rows);
  EXPECT_EQ(rows[2].step, HourStep::kScale);
  EXPECT_NE(rows[2].verdict.sentence.find("not measured"), std::string::npos);
}

TEST(FirstHourWalk, StopEndsItAtAnyQuestionWithoutForce) {
  ComputedPerson whole;
  whole.Walk();
  ASSERT_GT(whole.asked, 20);
  for (int last = 1; last <= whole.asked; ++last) {
    ComputedPerson person;
    int asked = 0;
    const HourTicks ticks{[&] {
                            person.hand.now += 0.001;
                            person.Act();
                            return person.hand.now;
                          },
                          [] { return false; }};
    const std::vector<HourRow> rows = TakeFirstHour(person.hand.device, ticks,
                                                    {[](const std::string&) {},
                                                     [&](const std::string& question) {
                                                       const auto answer = person.Answer(question);
                                                       return ++asked == last ? "stop" : answer;
                                                     }});
    EXPECT_EQ(asked, last);
    EXPECT_FALSE(HasPassed(rows)) << last;
    EXPECT_EQ(person.hand.device.force(), glm::dvec3(0.0)) << last;
  }
}

TEST(FirstHourWalk, NonsenseIsAskedAgain) {
  ComputedPerson person;
  int wrong = 0;
  const HourTicks ticks{[&] {
                          person.hand.now += 0.001;
                          person.Act();
                          return person.hand.now;
                        },
                        [] { return false; }};
  std::string before;
  const auto rows = TakeFirstHour(
      person.hand.device, ticks,
      {[](const std::string&) {},
       [&](const std::string& question) -> std::string {
         const bool is_choice = question.find("yes/no") != std::string::npos ||
                                question.starts_with("Where") || question.starts_with("Reading");
         if (is_choice && question != before) {
           before = question;
           ++wrong;
           return "1e9 perhaps";
         }
         before.clear();
         return person.Answer(question);
       }});
  EXPECT_TRUE(HasPassed(rows)) << Words(rows);
  EXPECT_GE(wrong, 10);
}

}  // namespace
}  // namespace arthro::app
