// The command line is a contract [method.md, Command line]: help, usage errors and exit codes.
#include <algorithm>
#include <array>
#include <string>

#include <gtest/gtest.h>

#include "tests/support/run_program.h"

namespace arthro {
namespace {

using test::ProgramResult;
using test::RunProgram;

constexpr std::array kJobs = {
    "demo",  "phantom",  "depth",   "tetrahedralize", "pivot", "centres", "view",    "replay",
    "check", "lens",     "rectify", "relief",         "reach", "assess",  "records", "help",
#ifdef ARTHRO_EDITOR  // jobs that open a window
    "edit",  "practise", "run"
#endif
};

TEST(CommandLine, HelpListsEveryJob) {
  const ProgramResult help = RunProgram("--help");
  EXPECT_EQ(help.exit_code, 0);
  for (const std::string job : kJobs)
    EXPECT_NE(help.out.find("\n  " + job), std::string::npos) << job;
}

TEST(CommandLine, EveryJobHasHelpOfItsOwn) {
  for (const std::string job : kJobs) {
    const ProgramResult help = RunProgram(job + " --help");
    EXPECT_EQ(help.exit_code, 0) << job;
    EXPECT_GT(help.out.size(), 100u) << job;
  }
}

#ifdef ARTHRO_EDITOR
TEST(CommandLine, BothSpellingsOfPractiseWork) {
  EXPECT_EQ(RunProgram("practice --help").exit_code, 0);
}
#endif

TEST(CommandLine, UsageErrorsExitWithTwo) {
  EXPECT_EQ(RunProgram("no-such-job").exit_code, 2);
  EXPECT_EQ(RunProgram("depth").exit_code, 2);  // a required argument is missing
  EXPECT_EQ(RunProgram("depth --no-such-flag x.png -o d.tiff").exit_code, 2);
  EXPECT_EQ(RunProgram("phantom --seed ten -o d").exit_code, 2);
}

TEST(CommandLine, HelpPrintsTheManual) {
  const std::string no_display = "DISPLAY= WAYLAND_DISPLAY=";
  const ProgramResult contents = RunProgram("help", no_display);
  EXPECT_EQ(contents.exit_code, 0) << contents.err;
  EXPECT_NE(contents.out.find("\ntroubleshooting "), std::string::npos) << contents.out;
  EXPECT_NE(contents.out.find("anual"), std::string::npos) << "where it lies";
  const ProgramResult page = RunProgram("help troubleshooting", no_display);
  EXPECT_EQ(page.exit_code, 0) << page.err;
  EXPECT_NE(page.out.find("I feel no force"), std::string::npos) << page.out;
  const ProgramResult unknown = RunProgram("help no-such-page", no_display);
  EXPECT_EQ(unknown.exit_code, 1);
  EXPECT_NE(unknown.err.find("its pages are index, educator"), std::string::npos) << unknown.err;
}

TEST(CommandLine, VersionIsPrinted) {
  const ProgramResult version = RunProgram("--version");
  EXPECT_EQ(version.exit_code, 0);
  EXPECT_EQ(version.out.rfind("arthroscene ", 0), 0u) << version.out;
}

}  // namespace
}  // namespace arthro
