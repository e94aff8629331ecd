// Handling of a mesher that crashes, hangs or exhausts memory. Small scripts stand in for the
// mesher.
#include <chrono>
#include <filesystem>
#include <functional>
#include <string>
#include <thread>

#include <gtest/gtest.h>

#include "authoring/tissue/tetrahedra/child_process.h"
#include "authoring/tissue/tetrahedra/tetrahedralize.h"
#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"
#include "tests/support/build_paths.h"
#include "tests/support/shapes.h"
#include "tests/support/temp_folder.h"

namespace arthro::authoring {
namespace {

namespace fs = std::filesystem;

#define EXPECT_SAYS(sentence, part) \
  EXPECT_NE((sentence).find(part), std::string::npos) << "it said: " << (sentence)

const SurfaceMesh kCube = test::Box({0, 0, 0}, {0.01, 0.01, 0.01});

struct Outcome {
  std::string sentence;
  TetrahedralizeReport report;
};

Outcome FillWith(const fs::path& program, TetrahedralizeOptions options = {},
                 const Progress& progress = {}) {
  Outcome outcome;
  try {
    Tetrahedralize(kCube, {}, options, &outcome.report, progress, program);
  } catch (const Error& error) {
    outcome.sentence = error.sentence();
  }
  return outcome;
}

fs::path Script(const test::TempFolder& folder, const std::string& lines) {
  const fs::path file = folder / "mesher";
  WriteAtomically(file, "#!/bin/sh\n" + lines + "\n");
  fs::permissions(file, fs::perms::owner_all);
  return file;
}

TEST(TetgenProcess, CrashIsReportedAfterAllFallbacks) {
  test::TempFolder folder;
  const Outcome outcome = FillWith(Script(folder, "kill -SEGV $$"));
  EXPECT_SAYS(outcome.sentence, "crashed (Segmentation fault)");
  EXPECT_SAYS(outcome.sentence, "remesh");
  EXPECT_EQ(outcome.report.attempts.size(), 3u);
}

TEST(TetgenProcess, AbortAndTetgensErrorCodesAreReported) {
  test::TempFolder folder;
  EXPECT_SAYS(FillWith(Script(folder, "kill -ABRT $$")).sentence, "crashed (Aborted)");
  EXPECT_SAYS(FillWith(Script(folder, "exit 23")).sentence, "found a self-intersection");
  EXPECT_SAYS(FillWith(Script(folder, "exit 22")).sentence, "internal error");
  EXPECT_SAYS(FillWith(Script(folder, "echo the reason; exit 12")).sentence, "the reason");
  EXPECT_SAYS(FillWith(Script(folder, "exit 11")).sentence, "out of memory (2048 MB)");
}

TEST(TetgenProcess, EndlessLoopIsEndedAtTheTimeLimit) {
  test::TempFolder folder;
  TetrahedralizeOptions options;
  options.time_limit = 0.2;
  const auto start = std::chrono::steady_clock::now();
  const std::string sentence = FillWith(Script(folder, "exec sleep 3600"), options).sentence;
  EXPECT_SAYS(sentence, "did not finish in time (0.2 s)");
  EXPECT_SAYS(sentence, "--max-edge-mm");
  // Far below the hour that it would have taken.
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::minutes(10));
}

// The script fails in the first attempt, in which edges can be kept short, and passes the others.
TEST(TetgenProcess, KilledFromOutsideNeverGivesACoarserMesh) {
  test::TempFolder folder;
  const fs::path mesher =
      Script(folder, "grep -qa pq \"$2/job.bin\" && kill -KILL $$\nexec " ARTHRO_PROGRAM " \"$@\"");
  TetrahedralizeOptions options;
  options.max_edge = 4e-3;
  const std::string sentence = FillWith(mesher, options).sentence;
  EXPECT_SAYS(sentence, "more than the 4 mm asked for");
  EXPECT_SAYS(sentence, "TetGen crashed (Killed)");
  // Without a longest edge, or with the surface's own edges, the fallback is as good.
  EXPECT_EQ(FillWith(mesher).sentence, "");
  options.keep_surface = true;
  EXPECT_EQ(FillWith(mesher, options).sentence, "");
}

TEST(TetgenProcess, StopEndsItAtOnce) {
  test::TempFolder folder;
  std::atomic<bool> stop{false};
  Progress progress;
  progress.stop = &stop;
  std::thread user([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    stop = true;
  });
  EXPECT_SAYS(FillWith(Script(folder, "exec sleep 60"), {}, progress).sentence, "stopped");
  user.join();
}

TEST(TetgenProcess, MissingProgramIsReported) {
  EXPECT_SAYS(FillWith("/nowhere/arthroscene").sentence, "could not be started");
}

TEST(TetgenProcess, RealMesherHitsItsMemoryLimit) {
  TetrahedralizeOptions options;
  options.max_edge = 3e-4;  // half a million elements
  options.memory_limit = 20;
  EXPECT_SAYS(FillWith(ARTHRO_PROGRAM, options).sentence, "ran out of memory (20 MB)");
}

TEST(TetgenProcess, RealMesherHitsItsTimeLimit) {
  TetrahedralizeOptions options;
  options.max_edge = 3e-4;
  options.time_limit = 0.3;
  EXPECT_SAYS(FillWith(ARTHRO_PROGRAM, options).sentence, "did not finish in time");
}

TEST(TetgenProcess, LeavesNothingInTheTemporaryFolder) {
  test::TempFolder folder;
  ::setenv("TMPDIR", folder.path().c_str(), 1);
  test::TempFolder scripts;
  FillWith(Script(scripts, "kill -SEGV $$"));
  FillWith(ARTHRO_PROGRAM);
  ::unsetenv("TMPDIR");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()), 1)
      << "only the scripts' own folder";
}

TEST(ChildProcess, KeepsTheEndOfTheOutput) {
  test::TempFolder folder;
  const ChildResult result = RunChild(
      Script(folder, "i=0; while [ $i -lt 2000 ]; do echo line $i; i=$((i+1)); done; exit 7"), {},
      60, {});
  EXPECT_EQ(result.code, 7);
  EXPECT_TRUE(result.output.ends_with("line 1999\n"));
  EXPECT_LE(result.output.size(), 4096u);
}

}  // namespace
}  // namespace arthro::authoring
