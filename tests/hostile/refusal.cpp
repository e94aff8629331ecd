#include "tests/hostile/refusal.h"

#include <filesystem>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/hostile/child_run.h"
#include "tests/hostile/complaints.h"
#include "tests/support/build_paths.h"
#include "tests/support/temp_folder.h"

namespace arthro::test {

namespace fs = std::filesystem;

constexpr RunLimits kLimits{2, 1000};

std::string RefusalOf(const std::vector<std::string>& arguments, const Refusal& refusal) {
  const bool has_temporary_folder = refusal.has_temporary_folder;
  const TempFolder folder;
  if (has_temporary_folder) fs::create_directories(folder / "tmp");
  ChildCommand command;
  command.arguments = {ARTHRO_PROGRAM};
  command.arguments.insert(command.arguments.end(), arguments.begin(), arguments.end());
  for (std::string& argument : command.arguments)
    if (argument.starts_with("OUT/")) argument = folder / argument.substr(4);
  command.folder = command.scratch = folder.path();
  command.environment = {"TMPDIR=" + (folder / "tmp").string(), "LANG=C.UTF-8"};
  const ChildRun run = RunChild(command);
  const std::string line = fmt::format("{}", fmt::join(arguments, " "));
  EXPECT_EQ(run.exit_code, 1) << line << "\n" << Printable(run.err);
  for (const std::string& complaint : RunComplaints(run, kLimits))
    ADD_FAILURE() << line << ": " << complaint << "\n" << Printable(run.err);
  EXPECT_TRUE(!has_temporary_folder || fs::is_empty(folder / "tmp"))
      << line << " leaves a temporary file";
  EXPECT_EQ(run.err.find((folder / "tmp").string()), std::string::npos)
      << "names a file that nobody knows: " << Printable(run.err);
  for (const char* output : {"r.json", "t.vtu", "c.csv"}) {
    EXPECT_TRUE(refusal.writes_result || !fs::exists(folder / output)) << line;
  }
  return run.err;
}

}  // namespace arthro::test
