#include "simulation/core/folders/leftovers.h"

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <string>
#include <sys/wait.h>
#include <unistd.h>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/support/temp_folder.h"

namespace arthro {
namespace {

namespace fs = std::filesystem;
using std::chrono::seconds;

// The number of a process that has ended.
pid_t DeadProcess() {
  const pid_t child = ::fork();
  if (child == 0) ::_exit(0);
  ::waitpid(child, nullptr, 0);
  return child;
}

void Age(const fs::path& path) {
  fs::last_write_time(path, fs::file_time_type::clock::now() - std::chrono::minutes(5));
}

fs::path OldFile(const fs::path& path) {
  std::ofstream(path) << "text";
  Age(path);
  return path;
}

TEST(Leftovers, UnfinishedFilesAndFoldersOfADeadProcessAreRemoved) {
  const test::TempFolder folder;
  const pid_t dead = DeadProcess();
  const fs::path file = OldFile(folder / fmt::format(".a.b.{}.partial.json", dead));
  const fs::path plain = OldFile(folder / fmt::format(".a.{}.partial", dead));
  const fs::path of_library = OldFile(folder / fmt::format(".a.{}.partial.arthro.x3Gb1k", dead));
  const fs::path filled = folder / fmt::format(".frames.{}.partial", dead);
  fs::create_directory(filled);
  OldFile(filled / "0.png");
  Age(filled);
  RemoveLeftovers(folder.path());
  EXPECT_FALSE(fs::exists(file));
  EXPECT_FALSE(fs::exists(plain));
  EXPECT_FALSE(fs::exists(of_library));
  EXPECT_FALSE(fs::exists(filled));
}

TEST(Leftovers, TheParentOfAPlainFileNameIsTheCurrentFolder) {
  const test::TempFolder folder;
  const fs::path file = OldFile(folder / fmt::format(".a.{}.partial.arthro", DeadProcess()));
  const fs::path before = fs::current_path();
  fs::current_path(folder.path());
  RemoveLeftovers(fs::path("a.arthro").parent_path());
  fs::current_path(before);
  EXPECT_FALSE(fs::exists(file));
}

TEST(Leftovers, NothingElseIsRemoved) {
  const test::TempFolder folder, elsewhere;
  const pid_t dead = DeadProcess();
  OldFile(elsewhere / "kept.txt");
  const fs::path kept[] = {
      OldFile(folder / fmt::format(".a.{}.partial.json", ::getpid())),  // a live process
      OldFile(folder / ".a.1.partial.json"),                            // the first process
      OldFile(folder / ".a.0.partial.json"),                            // no process
      OldFile(folder / ".a.99999999999999999999.partial.json"),         // no number
      OldFile(folder / ".a.12x.partial.json"),
      OldFile(folder / fmt::format("a.{}.partial.json", dead)),  // not hidden
      OldFile(folder / fmt::format(".{}.partial.json", dead)),   // no stem
      OldFile(folder / fmt::format(".a.{}.partially.json", dead)),
      OldFile(folder / fmt::format(".film.{}.recording.mp4", dead)),  // is finished, not removed
      OldFile(folder / "scene.json"),
  };
  // A link is no file of ours, and what it names is not looked at.
  const fs::path link = folder / fmt::format(".link.{}.partial", dead);
  fs::create_directory_symlink(elsewhere.path(), link);
  // A file that was changed lately may belong to another machine.
  const fs::path young = folder / fmt::format(".young.{}.partial.json", dead);
  std::ofstream(young) << "text";
  RemoveLeftovers(folder.path());
  for (const fs::path& file : kept) EXPECT_TRUE(fs::exists(file)) << file;
  EXPECT_TRUE(fs::is_symlink(link));
  EXPECT_TRUE(fs::exists(elsewhere / "kept.txt"));
  EXPECT_TRUE(fs::exists(young));
  RemoveLeftovers(folder.path(), seconds(0));
  EXPECT_FALSE(fs::exists(young));
  RemoveLeftovers(folder / "none");
}

TEST(Leftovers, ATemporaryFolderTellsItsProcessAndThoseOfDeadOnesAreRemoved) {
  const test::TempFolder folder;
  const pid_t dead = DeadProcess();
  const fs::path old = folder / fmt::format("arthroscene-{}-abcdef", dead),
                 live = folder / fmt::format("arthroscene-{}-abcdef", ::getppid()),
                 foreign = folder / "arthroscene-notes-abcdef",
                 longer = folder / fmt::format("arthroscene-{}-abcdefg", dead);
  for (const fs::path& path : {old, live, foreign, longer}) {
    fs::create_directory(path);
    OldFile(path / "job.bin");
    Age(path);
  }
  const fs::path file = OldFile(folder / fmt::format("arthroscene-{}-fedcba", dead));
  ::setenv("TMPDIR", folder.path().c_str(), 1);
  const fs::path own = MakeTemporaryFolder();
  ::unsetenv("TMPDIR");
  EXPECT_EQ(own.parent_path(), folder.path());
  EXPECT_TRUE(own.filename().string().starts_with(fmt::format("arthroscene-{}-", ::getpid())));
  EXPECT_FALSE(fs::exists(old));
  for (const fs::path& path : {live, foreign, longer, file}) EXPECT_TRUE(fs::exists(path)) << path;
}

}  // namespace
}  // namespace arthro
