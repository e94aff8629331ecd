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

int FilesIn(const std::filesystem::path& folder) {
  int count = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder)) ++count;
  return count;
}

TEST(AtomicFile, ReplacesWhatWasThere) {
  test::TempFolder folder;
  WriteAtomically(folder / "a.txt", "first");
  WriteAtomically(folder / "a.txt", "second");
  EXPECT_EQ(ReadWholeFile(folder / "a.txt"), "second");
  EXPECT_EQ(FilesIn(folder.path()), 1);
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
  EXPECT_EQ(FilesIn(folder.path()), 1);
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
  EXPECT_EQ(FilesIn(folder.path()), 1) << "nothing was left beside the device";
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
