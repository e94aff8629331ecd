// One rule for the numbers of every flag of every job (app/cli/flags/number_flags.h).
#include "app/cli/flags/number_flags.h"

#include <algorithm>
#include <array>
#include <functional>
#include <sstream>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <gtest/gtest.h>

#include "app/bench/jobs/bench_jobs.h"
#include "app/cli/jobs.h"

namespace arthro::app {
namespace {

// No flag takes these, whatever its range.
constexpr std::array kNoNumbers = {"nan",
                                   "-nan",
                                   "NaN",
                                   "inf",
                                   "-inf",
                                   "Infinity",
                                   "",
                                   "abc",
                                   "0x10",
                                   "1e999",
                                   " 1",
                                   "1 ",
                                   "1e",
                                   "--1",
                                   "1;5",
                                   "-1e999",
                                   "1.5.2",
                                   "+-1",
                                   "99999999999999999999",
                                   "-99999999999999999999"};

bool IsNumeric(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  return type.starts_with(kNumberType) || type.starts_with(kWholeType) ||
         type.starts_with(kListType);
}

// Every job and bench below `app`, with the words that lead there.
void VisitJobs(CLI::App& app, const std::string& words,
               const std::function<void(CLI::App&, const std::string&)>& visit) {
  visit(app, words);
  for (CLI::App* job : app.get_subcommands([](CLI::App*) { return true; }))
    VisitJobs(*job, words + (words.empty() ? "" : " ") + job->get_name(), visit);
}

// Both programs, parsing alone: no job runs and nothing is required.
class Program {
 public:
  Program() : app_("", "arthroscene") {
    AddEveryJob(app_);
    AddBenches(*app_.get_subcommand("bench"));
    VisitJobs(app_, "", [](CLI::App& job, const std::string&) {
      job.callback([] {});
      job.require_subcommand(0);
      for (CLI::Option* option : job.get_options()) option->required(false);
    });
  }
  CLI::App& app() { return app_; }

  // Returns what the program says; empty where the line is taken.
  std::string Parse(std::vector<std::string> words) {
    std::reverse(words.begin(), words.end());
    try {
      app_.parse(words);
    } catch (const CLI::ParseError& error) {
      return error.what();
    }
    return "";
  }

 private:
  CLI::App app_;
};

struct Flag {
  std::vector<std::string> job;
  std::string name;
  bool is_positional = false, is_list = false;
};

std::vector<Flag> NumericFlags() {
  Program program;
  std::vector<Flag> flags;
  VisitJobs(program.app(), "", [&](CLI::App& job, const std::string& words) {
    for (const CLI::Option* option : job.get_options()) {
      if (!IsNumeric(*option)) continue;
      Flag flag;
      std::istringstream stream(words);
      for (std::string word; stream >> word;) flag.job.push_back(word);
      flag.is_positional = option->get_lnames().empty() && option->get_snames().empty();
      flag.is_list = option->get_type_name().starts_with(kListType);
      flag.name = flag.is_positional ? option->get_name(true) : "--" + option->get_lnames().front();
      flags.push_back(flag);
    }
  });
  return flags;
}

TEST(NumberFlags, AreAllThatTakeANumberInAnyJob) {
  Program program;
  VisitJobs(program.app(), "", [&](CLI::App& job, const std::string& words) {
    for (const CLI::Option* option : job.get_options())
      for (const char* raw : {"INT", "UINT", "FLOAT"})
        EXPECT_NE(option->get_type_name(), raw)
            << words << " " << option->get_name() << ": add it by AddNumber";
  });
}

TEST(NumberFlags, RefuseWhatIsNoFiniteNumberInEveryJob) {
  const std::vector<Flag> flags = NumericFlags();
  EXPECT_GT(flags.size(), 100u);
  for (const Flag& flag : flags) {
    if (flag.is_positional) continue;  // belongs to hidden workers, which the program itself starts
    Program program;
    for (const std::string value : kNoNumbers) {
      std::vector<std::string> words = flag.job;
      words.push_back(flag.name + "=" + value);
      if (value.empty()) {
        words.back() = flag.name;
        words.push_back("");
      }
      const std::string said = program.Parse(words);
      EXPECT_NE(said.find(flag.name), std::string::npos)
          << flag.job.front() << " " << flag.name << " \"" << value << "\": " << said;
      EXPECT_EQ(said.find('\n'), std::string::npos) << said;
    }
    if (flag.is_list) continue;
    std::vector<std::string> words = flag.job;
    words.push_back(flag.name + "=1,5");
    EXPECT_NE(program.Parse(words).find("with a point"), std::string::npos) << flag.name;
  }
}

std::string Refusal(const std::string& word, const NumberRule& rule) {
  try {
    NumberFromWord("--rate", word, rule);
  } catch (const CLI::ValidationError& error) {
    return error.what();
  }
  return "";
}

TEST(NumberFlags, SayTheValueAndTheRangeWithItsUnit) {
  const NumberRule rate{{0.1, 1000}, "Hz"};
  EXPECT_EQ(Refusal("nan", rate), "--rate: \"nan\" is not a number from 0.1 to 1000 Hz");
  EXPECT_EQ(Refusal("1,5", rate),
            "--rate: \"1,5\" is not a number from 0.1 to 1000 Hz; decimals are written with a "
            "point, as in 1.5");
  EXPECT_EQ(Refusal("2.0", {{1, 99}, "", true}),
            "--rate: \"2.0\" is not a whole number from 1 to 99");
  EXPECT_EQ(Refusal("a\nb\x1b[1m", rate),
            "--rate: \"a?b?[1m\" is not a number from 0.1 to 1000 Hz");
  EXPECT_LT(Refusal(std::string(100000, '1'), rate).size(), 200u);
  EXPECT_EQ(Refusal("+2.5", rate), "");
  EXPECT_EQ(Refusal("1e2", rate), "");
  EXPECT_EQ(Refusal(".5", rate), "");
}

TEST(NumberFlags, ListsHaveCommasBetweenAndNoEmptyPlace) {
  const NumberRule rule{{-1000, 1000}, "mm"};
  EXPECT_EQ(NumbersFromWord("--at", "1,5", rule), (std::vector<double>{1, 5}));
  EXPECT_EQ(NumbersFromWord("--at", "1.5", rule), (std::vector<double>{1.5}));
  for (const char* wrong : {"1,,5", ",1", "1,", "1;5", "1, 5", "1 5", "1,nan", ""}) {
    try {
      NumbersFromWord("--at", wrong, rule);
      ADD_FAILURE() << wrong << " was taken";
    } catch (const CLI::ValidationError& error) {
      EXPECT_NE(std::string(error.what()).find("separated by commas"), std::string::npos)
          << error.what();
    }
  }
}

TEST(NumberFlags, SizesAreTwoWholeNumbersInRange) {
  EXPECT_EQ(SizeFromWord("--size", "1280x800", {1, 16384}), (std::pair{1280, 800}));
  for (const char* wrong : {"1280", "1280x", "x800", "0x800", "1280x800x1", "99999999999x1", "-1x1",
                            "1280x800 ", "nanx1"})
    EXPECT_THROW(SizeFromWord("--size", wrong, {1, 16384}), CLI::ValidationError) << wrong;
}

}  // namespace
}  // namespace arthro::app
