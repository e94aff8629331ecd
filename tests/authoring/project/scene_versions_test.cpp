// Backups of the last saves, and snapshots.
#include "authoring/project/files/scene_versions.h"

#include <set>

#include <gtest/gtest.h>

#include "authoring/project/document_io.h"
#include "simulation/core/error.h"
#include "simulation/scene/files/scene_io.h"
#include "tests/support/small_scene.h"
#include "tests/support/temp_folder.h"

namespace arthro::authoring {
namespace {

namespace fs = std::filesystem;

class Versions : public testing::Test {
 protected:
  // Saves with a depth map and a title that name the save.
  void Save(const fs::path& place, int number) {
    document.depth = Share(DepthMap(400, 300, 0.001f * static_cast<float>(number)));
    document.scene.title = "save " + std::to_string(number);
    SaveOptions options;
    options.keeps_backup = true;
    document = SaveDocument(document, place, options);
  }
  std::vector<std::string> Titles(const fs::path& place) const {
    std::vector<std::string> titles;
    for (const SceneVersion& version : VersionsOf(place))
      titles.push_back(OpenDocument(version.file).scene.title);
    return titles;
  }
  int Maps() const {
    int maps = 0;
    for (const auto& entry : fs::directory_iterator(temp / "knee"))
      maps += entry.path().extension() == ".tiff";
    return maps;
  }
  test::TempFolder temp;
  Document document = OpenDocument(test::WriteSmallScene(temp / "knee"));
};

TEST_F(Versions, LastFiveSavesOfAFolderAreKeptWithTheirMaps) {
  for (int number = 1; number <= 9; ++number) Save(temp / "knee", number);
  EXPECT_EQ(Titles(temp / "knee"),
            (std::vector<std::string>{"save 8", "save 7", "save 6", "save 5", "save 4"}));
  for (const SceneVersion& version : VersionsOf(temp / "knee")) {
    const Document back = OpenDocument(version.file);
    const int number = back.scene.title.back() - '0';
    EXPECT_EQ(back.depth->at(3, 3), 0.001f * static_cast<float>(number));
    EXPECT_EQ(back.folder, temp / "knee");
  }
  // Six of the saves, the map that was there before the first one, and no others.
  EXPECT_EQ(Maps(), 7);
}

TEST_F(Versions, SavingTheSameAgainKeepsTheOlderBackups) {
  for (int number = 1; number <= 3; ++number) Save(temp / "knee", number);
  const auto before = Titles(temp / "knee");
  for (int i = 0; i < 20; ++i) {
    SaveOptions options;
    options.keeps_backup = true;
    document = SaveDocument(document, temp / "knee", options);
  }
  auto titles = Titles(temp / "knee");
  ASSERT_EQ(titles.size(), before.size() + 1);
  EXPECT_EQ(titles.front(), "save 3");
  titles.erase(titles.begin());
  EXPECT_EQ(titles, before);
}

TEST_F(Versions, LastFiveSavesOfAnArchiveAreKept) {
  for (int number = 1; number <= 8; ++number) Save(temp / "k.arthro", number);
  EXPECT_EQ(Titles(temp / "k.arthro"),
            (std::vector<std::string>{"save 7", "save 6", "save 5", "save 4", "save 3"}));
  EXPECT_EQ(OpenDocument(temp / "k.arthro").scene.title, "save 8");
}

TEST_F(Versions, ASnapshotStaysWhileBackupsGo) {
  Save(temp / "knee", 1);
  KeepSnapshot(temp / "knee", "Before the tear");
  for (int number = 2; number <= 9; ++number) Save(temp / "knee", number);
  const auto versions = VersionsOf(temp / "knee");
  const auto snapshot = std::find_if(versions.begin(), versions.end(),
                                     [](const SceneVersion& v) { return !v.name.empty(); });
  ASSERT_NE(snapshot, versions.end());
  EXPECT_EQ(snapshot->name, "Before the tear");
  EXPECT_EQ(OpenDocument(snapshot->file).scene.title, "save 1");
  EXPECT_EQ(OpenDocument(snapshot->file).depth->at(3, 3), 0.001f);
}

TEST_F(Versions, ASnapshotIsRefusedInOneSentence) {
  const auto sentence = [&](const fs::path& place, const std::string& name) -> std::string {
    try {
      KeepSnapshot(place, name);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(sentence(temp / "knee", "A"), "");
  EXPECT_NE(sentence(temp / "knee", "a").find("choose another name"), std::string::npos);
  EXPECT_NE(sentence(temp / "knee", "../..").find("needs a name"), std::string::npos);
  EXPECT_NE(sentence(temp / "k.arthro", "b").find("save the scene as a folder"), std::string::npos);
}

TEST_F(Versions, ACopyElsewhereCarriesNoVersions) {
  for (int number = 1; number <= 3; ++number) Save(temp / "knee", number);
  KeepSnapshot(temp / "knee", "A");
  SaveDocument(document, temp / "copy");
  EXPECT_TRUE(VersionsOf(temp / "copy").empty());
}

}  // namespace
}  // namespace arthro::authoring
