// The file browser without its looks (app/platform/file_browser_model.h).
#include "app/platform/file_browser_model.h"

#include <fstream>

#include <gtest/gtest.h>

#include "tests/support/temp_folder.h"

namespace arthro::app {
namespace {

namespace fs = std::filesystem;

const std::vector<FileFilter> kPictures = {{"Pictures", {".png", ".jpg"}}, {"All files", {}}};

class FileBrowser : public testing::Test {
 protected:
  FileBrowser() {
    for (const char* name : {"b.png", "A.PNG", "notes.txt", ".hidden.png"})
      std::ofstream(temp / name) << "x";
    fs::create_directory(temp / "zebra");
  }
  std::vector<std::string> Names(const FileBrowserModel& model) {
    std::vector<std::string> names;
    for (const auto& entry : model.entries()) names.push_back(entry.name());
    return names;
  }
  const FileEntry& Entry(const FileBrowserModel& model, const std::string& name) {
    for (const auto& entry : model.entries())
      if (entry.name() == name) return entry;
    throw std::runtime_error("no entry " + name);
  }
  test::TempFolder temp;
};

TEST_F(FileBrowser, ListsFoldersFirstThenMatchingFilesByNameWhateverTheirCase) {
  const FileBrowserModel model(BrowseFor::kOpenFile, kPictures, temp.path());
  EXPECT_EQ(Names(model), (std::vector<std::string>{"zebra", "A.PNG", "b.png"}));
}

TEST_F(FileBrowser, OtherFilterAndHiddenFilesShowTheRest) {
  FileBrowserModel model(BrowseFor::kOpenFile, kPictures, temp.path());
  model.SetFilter(1);
  model.ShowHidden(true);
  EXPECT_EQ(Names(model),
            (std::vector<std::string>{"zebra", ".hidden.png", "A.PNG", "b.png", "notes.txt"}));
}

TEST_F(FileBrowser, StartsInTheNearestFolderThatExists) {
  const FileBrowserModel of_file(BrowseFor::kOpenFile, kPictures, temp / "b.png");
  EXPECT_TRUE(fs::equivalent(of_file.folder(), temp.path()));
  const FileBrowserModel of_lost(BrowseFor::kOpenFile, kPictures, temp / "gone/deeper/x.png");
  EXPECT_TRUE(fs::equivalent(of_lost.folder(), temp.path()));
}

TEST_F(FileBrowser, AcceptingAChosenFileGivesItsPath) {
  FileBrowserModel model(BrowseFor::kOpenFile, kPictures, temp.path());
  model.Select(Entry(model, "b.png"));
  EXPECT_EQ(model.Accept(), Acceptance::kDone);
  EXPECT_EQ(model.accepted().filename(), "b.png");
}

TEST_F(FileBrowser, AcceptingAFolderEntersItAndUpLeavesIt) {
  FileBrowserModel model(BrowseFor::kOpenFile, kPictures, temp.path());
  model.Select(Entry(model, "zebra"));
  EXPECT_EQ(model.Accept(), Acceptance::kEntered);
  EXPECT_EQ(model.folder().filename(), "zebra");
  EXPECT_TRUE(model.file_name.empty());
  model.GoUp();
  EXPECT_TRUE(fs::equivalent(model.folder(), temp.path()));
}

TEST_F(FileBrowser, AFolderOfFilesIsTakenWholeWhereItMayBe) {
  FileBrowserModel model(BrowseFor::kOpenFileOrFolder, kPictures, temp.path());
  EXPECT_EQ(model.AcceptFolder(), Acceptance::kDone);
  EXPECT_EQ(model.accepted(), fs::canonical(temp.path()));
  model.GoTo(temp / "zebra");
  EXPECT_EQ(model.AcceptFolder(), Acceptance::kNothing) << "there is nothing in it";
  EXPECT_EQ(model.problem(),
            "This folder has no file of the kind that is asked for; choose another folder.");
}

TEST_F(FileBrowser, AMissingFileIsRefusedWithASentenceThatNamesIt) {
  FileBrowserModel model(BrowseFor::kOpenFile, kPictures, temp.path(), "c.png");
  EXPECT_EQ(model.Accept(), Acceptance::kNothing);
  EXPECT_NE(model.problem().find("c.png"), std::string::npos);
}

TEST_F(FileBrowser, SavingAddsTheExtensionAndAsksBeforeItOverwrites) {
  FileBrowserModel model(BrowseFor::kSaveFile, kPictures, temp.path(), "new");
  EXPECT_EQ(model.Accept(), Acceptance::kDone);
  EXPECT_EQ(model.accepted().filename(), "new.png");

  model.file_name = "b.png";
  EXPECT_EQ(model.Accept(), Acceptance::kOverwrite);
  EXPECT_EQ(model.AcceptOverwrite(), Acceptance::kDone);
  EXPECT_EQ(model.accepted().filename(), "b.png");
}

TEST_F(FileBrowser, SavingIntoAMissingFolderIsRefused) {
  FileBrowserModel model(BrowseFor::kSaveFile, kPictures, temp.path(), "gone/new.png");
  EXPECT_EQ(model.Accept(), Acceptance::kNothing);
  EXPECT_NE(model.problem().find("gone"), std::string::npos);
}

TEST_F(FileBrowser, ASceneIsSavedIntoANewOrEmptyFolderAndAsksBeforeItReplacesAScene) {
  FileBrowserModel model(BrowseFor::kSaveFolder, {}, temp.path(), "new scene");
  EXPECT_EQ(model.Accept(), Acceptance::kDone);
  EXPECT_EQ(model.accepted().filename(), "new scene");
  EXPECT_FALSE(fs::exists(temp / "new scene")) << "it is the saving that makes it";

  model.file_name = "zebra";
  EXPECT_EQ(model.Accept(), Acceptance::kDone) << "an empty folder will do";

  std::ofstream(temp / "zebra/scene.json") << "{}";
  EXPECT_EQ(model.Accept(), Acceptance::kOverwrite);
  EXPECT_EQ(model.AcceptOverwrite(), Acceptance::kDone);

  fs::create_directory(temp / "full");
  std::ofstream(temp / "full/holiday.jpg") << "x";
  model.file_name = "full";
  EXPECT_EQ(model.Accept(), Acceptance::kEntered) << "a folder with other things is only opened";
}

TEST_F(FileBrowser, TypedAbsolutePathIsUnderstood) {
  FileBrowserModel model(BrowseFor::kOpenFile, kPictures, "/", (temp / "b.png").string());
  EXPECT_EQ(model.Accept(), Acceptance::kDone);
  EXPECT_TRUE(fs::equivalent(model.accepted(), temp / "b.png"));
}

TEST_F(FileBrowser, NewFolderIsMadeAndOpened) {
  FileBrowserModel model(BrowseFor::kSaveFile, kPictures, temp.path());
  EXPECT_TRUE(model.CreateFolder("mine"));
  EXPECT_TRUE(fs::is_directory(temp / "mine"));
  EXPECT_EQ(model.folder().filename(), "mine");
}

TEST_F(FileBrowser, BadFolderNamesAreRefusedWithASentence) {
  FileBrowserModel model(BrowseFor::kSaveFile, kPictures, temp.path());
  for (const char* name : {"", ".", "..", "a/b", "zebra"}) {
    EXPECT_FALSE(model.CreateFolder(name)) << name;
    EXPECT_FALSE(model.problem().empty()) << name;
  }
}

TEST_F(FileBrowser, AFolderThatCannotBeOpenedLeavesTheUserWhereTheyWere) {
  FileBrowserModel model(BrowseFor::kOpenFile, kPictures, temp.path());
  model.GoTo(temp / "nowhere");
  EXPECT_TRUE(fs::equivalent(model.folder(), temp.path()));
  EXPECT_NE(model.problem().find("nowhere"), std::string::npos);
  EXPECT_EQ(model.entries().size(), 3u);
}

TEST_F(FileBrowser, LettersChooseTheEntryThatBeginsWithThemUntilAPause) {
  FileBrowserModel model(BrowseFor::kOpenFile, kPictures, temp.path());
  const auto& entries = model.entries();
  ASSERT_GE(entries.size(), 2u);
  const std::string last = entries.back().name();
  double time = 10;
  for (const char letter : last) EXPECT_TRUE(model.Type(letter, time += 0.1));
  EXPECT_EQ(model.file_name, last);
  EXPECT_FALSE(model.Type('\x7e', time + 0.1)) << "no name goes on so";
  EXPECT_TRUE(model.Type(entries.front().name()[0], time + 5)) << "a pause begins anew";
  EXPECT_GT(entries.front().changed, 0);
}

TEST(WordsForBytes, AreShortAndRounded) {
  EXPECT_EQ(WordsForBytes(812), "812 B");
  EXPECT_EQ(WordsForBytes(3'400'000), "3.4 MB");
  EXPECT_EQ(WordsForBytes(999'960), "1.0 MB");
}

TEST_F(FileBrowser, OffersHomeRecentFoldersAndDrivesOnceEach) {
  for (const char* folder :
       {"home/Videos", "scenes/knee", "root/media/user/STICK", "root/mnt/disk"})
    fs::create_directories(temp / folder);
  std::vector<std::string> words;
  for (const BrowsePlace& place :
       BrowsePlaces(temp / "home", {temp / "scenes/knee", temp / "scenes/other"}, temp / "root"))
    words.push_back(place.words);
  EXPECT_EQ(words,
            (std::vector<std::string>{"Home", "Videos", "scenes", "STICK", "disk", "Computer"}));
}

}  // namespace
}  // namespace arthro::app
