#include "simulation/core/folders/partial_folder.h"

#include <fstream>

#include <gtest/gtest.h>

#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"
#include "tests/support/temp_folder.h"

namespace arthro {
namespace {

namespace fs = std::filesystem;

int EntriesOf(const fs::path& folder) {
  return static_cast<int>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

TEST(PartialFolder, AppearsWholeInANewPlace) {
  const test::TempFolder folder;
  PartialFolder partial(folder / "a/b/frames/");
  WriteAtomically(partial.beside() / "0.png", "picture");
  EXPECT_FALSE(fs::exists(folder / "a/b/frames"));
  partial.PutInPlace();
  EXPECT_EQ(ReadWholeFile(folder / "a/b/frames/0.png"), "picture");
  EXPECT_EQ(EntriesOf(folder / "a/b"), 1);
  EXPECT_EQ(EntriesOf(folder / "a/b/frames"), 1);
}

TEST(PartialFolder, ReplacesFilesOfTheSameNameAndKeepsTheOthers) {
  const test::TempFolder folder;
  fs::create_directory(folder / "frames");
  WriteAtomically(folder / "frames/0.png", "old");
  WriteAtomically(folder / "frames/notes.txt", "kept");
  PartialFolder partial(folder / "frames");
  WriteAtomically(partial.beside() / "0.png", "new");
  EXPECT_EQ(ReadWholeFile(folder / "frames/0.png"), "old");
  partial.PutInPlace();
  EXPECT_EQ(ReadWholeFile(folder / "frames/0.png"), "new");
  EXPECT_EQ(ReadWholeFile(folder / "frames/notes.txt"), "kept");
  EXPECT_EQ(EntriesOf(folder / "frames"), 2);
  EXPECT_EQ(EntriesOf(folder.path()), 1);
}

TEST(PartialFolder, LeavesNothingWhereItIsDropped) {
  const test::TempFolder folder;
  { const PartialFolder partial(folder / "a/b/frames"); }
  EXPECT_EQ(EntriesOf(folder.path()), 0);
  fs::create_directory(folder / "frames");
  WriteAtomically(folder / "frames/0.png", "old");
  {
    const PartialFolder partial(folder / "frames");
    WriteAtomically(partial.beside() / "0.png", "new");
  }
  EXPECT_EQ(ReadWholeFile(folder / "frames/0.png"), "old");
  EXPECT_EQ(EntriesOf(folder / "frames"), 1);
}

TEST(PartialFolder, AsNewTouchesNothingThatOthersMadeMeanwhile) {
  const test::TempFolder folder;
  PartialFolder late(folder / "frames/");
  WriteAtomically(late.beside() / "0.png", "late");
  fs::create_directory(folder / "frames");
  WriteAtomically(folder / "frames/0.png", "first");
  try {
    late.PutInPlaceAsNew();
    ADD_FAILURE() << "it was put in place";
  } catch (const Error& error) {
    EXPECT_NE(error.sentence().find("another program has just made this"), std::string::npos);
  }
  EXPECT_EQ(ReadWholeFile(folder / "frames/0.png"), "first");
  fs::remove_all(folder / "frames");
  std::ofstream(folder / "frames") << "a file";
  EXPECT_THROW(late.PutInPlaceAsNew(), Error);
  EXPECT_EQ(ReadWholeFile(folder / "frames"), "a file");
  fs::remove(folder / "frames");
  late.PutInPlaceAsNew();
  EXPECT_EQ(ReadWholeFile(folder / "frames/0.png"), "late");
  EXPECT_EQ(EntriesOf(folder.path()), 1);
}

TEST(PartialFolder, AFileInItsPlaceIsRefused) {
  const test::TempFolder folder;
  WriteAtomically(folder / "frames", "text");
  EXPECT_THROW(PartialFolder(folder / "frames"), Error);
  EXPECT_THROW(PartialFolder(folder / "frames/below"), Error);
  EXPECT_EQ(EntriesOf(folder.path()), 1);
}

}  // namespace
}  // namespace arthro
