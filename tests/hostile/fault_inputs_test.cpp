// Inputs that once crashed the program, hung it or took all memory: each is refused in one
// sentence, within 2 s of processor time and 1 GB.
#include <algorithm>
#include <fstream>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/hostile/child_run.h"
#include "tests/hostile/complaints.h"
#include "tests/support/shared_data.h"
#include "tests/support/temp_folder.h"

namespace arthro::test {
namespace {

namespace fs = std::filesystem;

constexpr RunLimits kLimits{2, 1000};

std::vector<fs::path> FilesNamed(const fs::path& folder, const std::string& ending) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.path().filename().string().ends_with(ending)) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

void ExpectRefusal(const std::vector<std::string>& arguments, bool has_temporary_folder = true) {
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
}

TEST(FaultInputs, CasesThatTurnElementsInsideOutAreRefused) {
  ARTHRO_REQUIRE_SHARED(folder, "faults/solve");
  const auto cases = FilesNamed(folder, "case.json");
  EXPECT_GE(cases.size(), 2u);
  for (const fs::path& file : cases) ExpectRefusal({"solve", file, "-o", "OUT/r.json"});
}

TEST(FaultInputs, VolumesWithFalseCountsOrDeepNestingAreRefused) {
  ARTHRO_REQUIRE_SHARED(folder, "faults/vtk");
  const auto cases = FilesNamed(folder, "case.json");
  EXPECT_GE(cases.size(), 9u);
  for (const fs::path& file : cases) ExpectRefusal({"solve", file, "-o", "OUT/r.json"});
  for (const fs::path& file : FilesNamed(folder, "scene.json")) ExpectRefusal({"check", file});
}

TEST(FaultInputs, DamagedXmlMeshesAreRefused) {
  ARTHRO_REQUIRE_SHARED(folder, "faults/ipf");
  for (const fs::path& file : FilesNamed(folder, ".vtp"))
    ExpectRefusal({"tetrahedralize", file, "--unit", "m", "-o", "OUT/t.vtu"});
  const TempFolder own;
  for (const fs::path& file : FilesNamed(folder, ".vtu")) {
    fs::copy_file(file, own / "in.vtu", fs::copy_options::overwrite_existing);
    std::ofstream(own / "case.json") << R"({"mesh": "in.vtu", "order": 1,
      "material": {"model": "corotated", "young_modulus": 1e6, "poisson_ratio": 0.3, "density": 1000},
      "mode": "static", "tolerance": 1e-8})";
    ExpectRefusal({"solve", own / "case.json", "-o", "OUT/r.json"});
  }
}

TEST(FaultInputs, ArchivesWithDeepJsonOrFalseNamesAreRefused) {
  ARTHRO_REQUIRE_SHARED(folder, "faults/archive");
  const auto archives = FilesNamed(folder, ".arthro");
  EXPECT_GE(archives.size(), 6u);
  // The archive of this name is sound: it is refused where there is nowhere to unpack it.
  for (const fs::path& file : archives)
    ExpectRefusal({"check", file}, file.stem() != "TMPDIR_missing");
}

}  // namespace
}  // namespace arthro::test
