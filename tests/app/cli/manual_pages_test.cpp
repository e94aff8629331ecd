// Manual pages and completion name every job and every flag, and nothing else.
#include "app/cli/manual/manual_pages.h"

#include <algorithm>
#include <regex>

#include <CLI/CLI.hpp>
#include <gtest/gtest.h>

#include "app/cli/command_line.h"

namespace arthro::app {
namespace {

class ManualPagesTest : public ::testing::Test {
 protected:
  ManualPagesTest() { DescribeProgram(program_); }
  CLI::App program_;
};

TEST_F(ManualPagesTest, EveryJobHasAPageWithEachFlagOfItsHelp) {
  const auto pages = ManualPages(program_, "1.2");
  const auto jobs =
      program_.get_subcommands([](const CLI::App* job) { return !job->get_group().empty(); });
  EXPECT_LT(jobs.size(), program_.get_subcommands({}).size());  // some are hidden
  EXPECT_EQ(pages.size(), jobs.size() + 1);
  for (const CLI::App* job : jobs) {
    const auto page = pages.find("arthroscene-" + job->get_name() + ".1");
    ASSERT_NE(page, pages.end()) << job->get_name();
    const auto is_shown = [](const CLI::Option* option) { return !option->get_group().empty(); };
    for (const CLI::Option* option : job->get_options(is_shown))
      for (std::string name : option->get_lnames()) {
        name = std::regex_replace(name, std::regex("-"), "\\-");
        EXPECT_NE(page->second.find("\\-\\-" + name), std::string::npos)
            << job->get_name() << " " << name;
      }
  }
}

// roff reads a line that begins with a point or an apostrophe as a request.
TEST_F(ManualPagesTest, NoTextIsReadAsARequest) {
  static const std::regex request(R"(^\.(TH|SH|TP|B|BR|I|RI)( .*)?$)");
  for (const auto& [name, text] : ManualPages(program_, "1.2")) {
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);)
      if (line.starts_with('.') || line.starts_with('\'')) {
        EXPECT_TRUE(std::regex_match(line, request)) << name << ": " << line;
      }
  }
}

TEST_F(ManualPagesTest, TheShellCompletesJobsAndFlags) {
  const std::string script = BashCompletion(program_);
  EXPECT_NE(script.find("panorama) flags='--help"), std::string::npos);
  EXPECT_NE(script.find("--insertion-mm"), std::string::npos);
  EXPECT_EQ(script.find("tetgen-worker"), std::string::npos);
}

}  // namespace
}  // namespace arthro::app
