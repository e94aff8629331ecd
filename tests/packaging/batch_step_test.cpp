// packaging/batch/step: a clip that is refused becomes a sentence, and ends no run.
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <sys/wait.h>

#include <gtest/gtest.h>

#include "tests/documents/source_text.h"
#include "tests/support/build_paths.h"
#include "tests/support/temp_folder.h"

namespace arthro::test {
namespace {

namespace fs = std::filesystem;

class BatchStep : public ::testing::Test {
 protected:
  BatchStep() { std::ofstream(folder_ / "needed") << "clip"; }

  // Exit code of a step with a file and a folder as outputs, which runs `command`.
  int Run(int attempt, const std::string& command) {
    const std::string line =
        "cd " + folder_.path().string() + " && " ARTHRO_SOURCE_DIR "/packaging/batch/step " +
        std::to_string(attempt) + " remark needed file scene/ -- sh -c '" + command + "' 2> said";
    return WEXITSTATUS(std::system(line.c_str()));
  }
  std::string Text(const std::string& file) { return TextOf(folder_ / file); }
  TempFolder folder_;
};

TEST_F(BatchStep, KeepsWhatTheCommandWrote) {
  EXPECT_EQ(Run(1, "echo whole > file; mkdir scene; echo word; echo warning >&2"), 0);
  EXPECT_EQ(Text("file"), "whole\n");
  EXPECT_EQ(Text("remark"), "");
}

TEST_F(BatchStep, ARefusalLeavesItsSentenceAndEmptyOutputs) {
  EXPECT_EQ(
      Run(1, "mkdir scene; echo part > scene/part; echo first >&2; echo no frames >&2; exit 1"), 0);
  EXPECT_EQ(Text("remark"), "no frames\n");
  EXPECT_EQ(fs::file_size(folder_ / "file"), 0u);
  EXPECT_TRUE(fs::is_empty(folder_ / "scene"));
}

TEST_F(BatchStep, AStepAfterARefusalDoesNothing) {
  std::ofstream(folder_ / "needed");
  EXPECT_EQ(Run(1, "echo more > file"), 0);
  EXPECT_EQ(fs::file_size(folder_ / "file"), 0u);
  EXPECT_EQ(Text("remark"), "");
}

TEST_F(BatchStep, AnotherFaultIsTriedAgainAndThenASentence) {
  EXPECT_EQ(Run(1, "exit 137"), 137);
  EXPECT_EQ(Run(2, "exit 137"), 0);
  EXPECT_NE(Text("remark").find("exit code 137"), std::string::npos) << Text("remark");
}

}  // namespace
}  // namespace arthro::test
