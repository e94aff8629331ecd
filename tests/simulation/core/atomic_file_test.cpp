#include "simulation/core/atomic_file.h"

#include <fcntl.h>
#include <fstream>
#include <sys/stat.h>
#include <unistd.h>

#include <gtest/gtest.h>

#include "simulation/core/error.h"
#include "tests/support/temp_folder.h"

namespace arthro {
namespace {

TEST(AtomicFile, ReplacesWhatWasThere) {
  test::TempFolder folder;
  WriteAtomically(folder / "a.txt", "first");
  WriteAtomically(folder / "a.txt", "second");
  EXPECT_EQ(ReadWholeFile(folder / "a.txt"), "second");
  EXPECT_EQ(test::FileCount(folder.path()), 1);
}

TEST(AtomicFile, AFaultLeavesTheOldFileAndNothingBeside) {
  test::TempFolder folder;
  WriteAtomically(folder / "a.txt", "first");
  EXPECT_THROW(WriteAtomically(folder / "a.txt",
                               [](const std::filesystem::path& beside) {
                                 std::ofstream(beside) << "half";
                                 throw Error(Code::kFile, "the writer failed");
                               }),
               Error);
  EXPECT_EQ(ReadWholeFile(folder / "a.txt"), "first");
  EXPECT_EQ(test::FileCount(folder.path()), 1);
}

// /dev/full is the kernel's own full disk.
TEST(AtomicFile, SaysThatTheDiskIsFull) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "SKIPPED: no /dev/full here";
  test::TempFolder folder;
  std::filesystem::create_symlink("/dev/full", folder / "a.txt");
  try {
    WriteAtomically(folder / "a.txt", "text");
    FAIL() << "nothing was thrown";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), Code::kFile);
    EXPECT_NE(error.sentence().find("disk is full"), std::string::npos) << error.what();
  }
  EXPECT_EQ(test::FileCount(folder.path()), 1) << "nothing was left beside the device";
  EXPECT_TRUE(std::filesystem::is_character_file(folder / "a.txt"));
}

TEST(AtomicFile, WritesIntoAPipeAndDoesNotReplaceIt) {
  const test::TempFolder folder;
  const std::filesystem::path pipe = folder / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  const int reader = ::open(pipe.c_str(), O_RDWR | O_NONBLOCK);
  ASSERT_GE(reader, 0);
  WriteAtomically(pipe, "text");
  char bytes[8] = {};
  EXPECT_EQ(::read(reader, bytes, sizeof bytes), 4);
  ::close(reader);
  EXPECT_STREQ(bytes, "text");
  EXPECT_TRUE(std::filesystem::is_fifo(pipe));
}

unsigned ModeOf(const std::filesystem::path& file) {
  struct stat found {};
  return ::stat(file.c_str(), &found) == 0 ? found.st_mode & 0777 : 0;
}

TEST(AtomicFile, APrivateFileIsItsOwnersAlone) {
  const test::TempFolder folder;
  const mode_t before = ::umask(0);
  WriteAtomically(folder / "private.bin", "text", Access::kPrivate);
  WriteAtomically(folder / "shared.bin", "text");
  ::umask(before);
  EXPECT_EQ(ModeOf(folder / "private.bin"), 0600u);
  EXPECT_EQ(ModeOf(folder / "shared.bin"), 0666u);
}

TEST(AtomicFile, AnUnfinishedPrivateFileIsPrivateToo) {
  const test::TempFolder folder;
  const mode_t before = ::umask(0);
  const PartialFile file(folder / "film.mp4", Access::kPrivate);
  ::umask(before);
  EXPECT_EQ(ModeOf(file.beside()), 0600u);
}

TEST(AtomicFile, AReplacedFileKeepsItsMode) {
  const test::TempFolder folder;
  for (const unsigned mode : {0600u, 0640u, 0755u}) {
    WriteAtomically(folder / "a.txt", "first");
    ASSERT_EQ(::chmod((folder / "a.txt").c_str(), mode), 0);
    WriteAtomically(folder / "a.txt", "second");
    EXPECT_EQ(ModeOf(folder / "a.txt"), mode);
    WriteAtomically(folder / "a.txt", "third", Access::kPrivate);
    EXPECT_EQ(ModeOf(folder / "a.txt"), mode);
  }
  // A writer that replaces the file that it was given.
  ASSERT_EQ(::chmod((folder / "a.txt").c_str(), 0600), 0);
  WriteAtomically(folder / "a.txt", [](const std::filesystem::path& beside) {
    std::filesystem::remove(beside);
    std::ofstream(beside) << "fourth";
  });
  EXPECT_EQ(ModeOf(folder / "a.txt"), 0600u);
}

TEST(AtomicFile, AReadOnlyFileIsRefused) {
  const test::TempFolder folder;
  WriteAtomically(folder / "a.txt", "first");
  ASSERT_EQ(::chmod((folder / "a.txt").c_str(), 0444), 0);
  try {
    WriteAtomically(folder / "a.txt", "second");
    FAIL() << "nothing was thrown";
  } catch (const Error& error) {
    EXPECT_NE(error.sentence().find("read-only"), std::string::npos) << error.what();
  }
  EXPECT_EQ(ReadWholeFile(folder / "a.txt"), "first");
  EXPECT_EQ(ModeOf(folder / "a.txt"), 0444u);
  EXPECT_EQ(test::FileCount(folder.path()), 1);
}

TEST(AtomicFile, ASymbolicLinkIsWrittenThrough) {
  const test::TempFolder folder;
  std::filesystem::create_directory(folder / "store");
  WriteAtomically(folder / "store/real.txt", "first");
  ASSERT_EQ(::chmod((folder / "store/real.txt").c_str(), 0600), 0);
  std::filesystem::create_symlink("store/real.txt", folder / "second");
  std::filesystem::create_symlink(folder / "second", folder / "a.txt");
  WriteAtomically(folder / "a.txt", "second");
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "a.txt"));
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "second"));
  EXPECT_EQ(ReadWholeFile(folder / "store/real.txt"), "second");
  EXPECT_EQ(ModeOf(folder / "store/real.txt"), 0600u);
  EXPECT_EQ(test::FileCount(folder / "store"), 1);
  // A link to a file that does not exist yet, and one that names itself.
  std::filesystem::create_symlink("store/new.txt", folder / "new");
  WriteAtomically(folder / "new", "text");
  EXPECT_EQ(ReadWholeFile(folder / "store/new.txt"), "text");
  std::filesystem::create_symlink("loop", folder / "loop");
  EXPECT_THROW(WriteAtomically(folder / "loop", "text"), Error);
}

TEST(AtomicFile, TakesANameAsLongAsTheFileSystemAllows) {
  const test::TempFolder folder;
  const std::string name = std::string(250, 'a') + ".json";
  WriteAtomically(folder / name, "text");
  EXPECT_EQ(ReadWholeFile(folder / name), "text");
}

TEST(AtomicFile, NamesAMissingFolder) {
  test::TempFolder folder;
  try {
    WriteAtomically(folder.path() / "no" / "a.txt", "x");
    FAIL() << "nothing was thrown";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("does not exist"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace arthro
