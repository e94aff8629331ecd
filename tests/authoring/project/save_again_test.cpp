// Saving one scene many times: which files are in its folder then.
#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <map>
#include <random>
#include <set>
#include <sys/wait.h>
#include <unistd.h>

#include <gtest/gtest.h>

#include "authoring/project/document_io.h"
#include "authoring/project/files/written_files.h"
#include "authoring/project/history.h"
#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"
#include "simulation/core/folders/leftovers.h"
#include "simulation/scene/files/scene_io.h"
#include "simulation/scene/image_io.h"
#include "simulation/scene/mesh/mesh_io.h"
#include "tests/support/knee_picture.h"
#include "tests/support/temp_folder.h"

namespace arthro::authoring {
namespace {

namespace fs = std::filesystem;

Document WithDepth(Document document, float relief) {
  document.depth = std::make_shared<const DepthMap>(DepthMap(96, 64, relief));
  return document;
}

Document NewScene(const fs::path& folder) {
  WriteColourImage(folder / "photo.png", test::KneePicture(96, 64));
  return WithDepth(OpenDocument(folder / "photo.png"), 0.001f);
}

std::set<std::string> NamesIn(const fs::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    names.insert(fs::relative(entry.path(), folder).string());
  return names;
}

std::size_t MapsIn(const fs::path& folder) {
  std::size_t maps = 0;
  for (const std::string& name : NamesIn(folder))
    maps += name.ends_with(".tiff") && !name.starts_with(".");  // temporaries aside
  return maps;
}

TEST(SaveAgain, ThreeHundredSavesOfAnEditedDepthKeepTwoNamesAndOneFile) {
  test::TempFolder folder;
  const fs::path scene = folder / "scene";
  Document document = SaveDocument(NewScene(folder.path()), scene);
  std::set<std::string> names;
  for (int i = 0; i < 300; ++i) {
    if (i % 50 == 25) document = OpenDocument(scene);  // also in a later session
    document = SaveDocument(WithDepth(document, 0.001f + 1e-5f * static_cast<float>(i)), scene);
    names.insert(document.scene.backdrop.depth.string());
    ASSERT_EQ(MapsIn(scene), 1u) << "save " << i;
  }
  EXPECT_EQ(names, (std::set<std::string>{"depth.tiff", "depth-2.tiff"}));
  EXPECT_EQ(NamesIn(scene).size(), 3u) << "scene.json, a panorama, a map";
  EXPECT_EQ(OpenDocument(scene).depth->at(3, 3), document.depth->at(3, 3));
}

TEST(SaveAgain, PanoramasAndSurfacesKeepTheirNamesToo) {
  test::TempFolder folder;
  const fs::path scene = folder / "scene";
  Document document = NewScene(folder.path());
  document.scene.tissues.emplace_back().name = "Meniscus";
  document.surfaces.emplace_back();
  for (int i = 0; i < 6; ++i) {
    document.panorama = std::make_shared<const ColourImage>(test::KneePicture(96, 64, 10.0 + i));
    const double size = 0.01 + 0.001 * i;
    document.surfaces[0] = std::make_shared<const SurfaceMesh>(
        SurfaceMesh{{{0, 0, 0}, {size, 0, 0}, {0, size, 0}}, {{0, 1, 2}}});
    document = SaveDocument(document, scene);
  }
  EXPECT_EQ(NamesIn(scene), (std::set<std::string>{"scene.json", "depth.tiff", "panorama-2.png",
                                                   "meniscus-2.ply"}));
}

TEST(SaveAgain, AFileThatTheSceneDidNotWriteStays) {
  test::TempFolder folder;
  const fs::path scene = folder / "scene";
  Document document = SaveDocument(NewScene(folder.path()), scene);
  // A person puts another map in the place of ours, and a file under the name that comes next.
  WriteDepthMap(scene / "depth.tiff", DepthMap(96, 64, 0.02f));
  WriteAtomically(scene / "depth-2.tiff", "a letter");
  const std::string theirs = ReadWholeFile(scene / "depth.tiff");
  for (int i = 0; i < 5; ++i)
    document = SaveDocument(WithDepth(document, 0.003f + 0.001f * static_cast<float>(i)), scene);
  EXPECT_EQ(ReadWholeFile(scene / "depth.tiff"), theirs);
  EXPECT_EQ(ReadWholeFile(scene / "depth-2.tiff"), "a letter");
  EXPECT_EQ(MapsIn(scene), 3u);
  EXPECT_EQ(OpenDocument(scene).depth->at(0, 0), document.depth->at(0, 0));
}

TEST(SaveAgain, AMapThatWasThereBeforeTheFirstSaveStays) {
  test::TempFolder folder;
  const fs::path scene = folder / "scene";
  SaveDocument(NewScene(folder.path()), scene);
  Scene values = ReadScene(scene);
  values.extensions.clear();  // a scene that a person has put together
  WriteScene(scene / "scene.json", values);
  SaveDocument(WithDepth(OpenDocument(scene), 0.004f), scene);
  EXPECT_TRUE(fs::exists(scene / "depth.tiff"));
  EXPECT_EQ(ReadScene(scene).backdrop.depth, "depth-2.tiff");
}

TEST(SaveAgain, AListOfWrittenFilesCannotNameOnesOutsideTheFolder) {
  test::TempFolder folder;
  const fs::path scene = folder / "scene";
  SaveDocument(NewScene(folder.path()), scene);
  WriteAtomically(folder / "diary.txt", "mine");
  fs::create_symlink(folder / "diary.txt", scene / "link.txt");
  const std::string mark = FingerprintOfFile(folder / "diary.txt");
  Scene values = ReadScene(scene);
  values.extensions[kWrittenFilesKey] =
      JsonFromWrittenFiles({{"../diary.txt", mark},
                            {"link.txt", mark},
                            {(folder / "diary.txt").string(), mark},
                            {"scene.json", FingerprintOfFile(scene / "scene.json")}});
  WriteScene(scene / "scene.json", values);
  SaveDocument(WithDepth(OpenDocument(scene), 0.004f), scene);
  EXPECT_EQ(ReadWholeFile(folder / "diary.txt"), "mine");
  EXPECT_TRUE(fs::is_symlink(scene / "link.txt"));
  EXPECT_TRUE(fs::exists(scene / "scene.json"));
}

TEST(SaveAgain, WhatASecondSceneInTheFolderNamesStays) {
  test::TempFolder folder;
  const fs::path scene = folder / "scene";
  const Document saved = SaveDocument(NewScene(folder.path()), scene);
  fs::copy_file(scene / "scene.json", scene / "variant.json");
  SaveDocument(WithDepth(saved, 0.004f), scene);
  EXPECT_EQ(LoadScene(scene / "variant.json").depth->at(0, 0), 0.001f);
}

TEST(SaveAgain, UndoAfterASaveSavesTheMapOfThatStep) {
  test::TempFolder folder;
  const fs::path scene = folder / "scene";
  History history(SaveDocument(NewScene(folder.path()), scene));
  for (const float relief : {0.002f, 0.003f, 0.004f}) {
    history.Push(WithDepth(history.current(), relief), "Depth");
    history.MarkSaved(SaveDocument(history.current(), scene, {history.FilesOnlyOnDisk()}));
  }
  // Names were given twice by now, so a step's name alone does not say what lies there.
  for (const float relief : {0.003f, 0.002f, 0.001f}) {
    history.Undo();
    history.MarkSaved(SaveDocument(history.current(), scene, {history.FilesOnlyOnDisk()}));
    EXPECT_EQ(LoadScene(scene).depth->at(0, 0), relief);
    EXPECT_EQ(MapsIn(scene), 1u);
  }
}

TEST(SaveAgain, TetrahedraThatUndoNeedsStayUntilTheNextSession) {
  test::TempFolder folder;
  const fs::path scene = folder / "scene";
  Document document = NewScene(folder.path());
  document.scene.tissues.emplace_back().name = "Meniscus";
  document.surfaces.push_back(std::make_shared<const SurfaceMesh>(
      SurfaceMesh{{{0, 0, 0}, {0.01, 0, 0}, {0, 0.01, 0}}, {{0, 1, 2}}}));
  const auto with_mesh = [&](Document next, double size) {
    TetMesh mesh;
    mesh.rest_positions = {{0, 0, 0}, {size, 0, 0}, {0, size, 0}, {0, 0, size}};
    mesh.elements = {0, 1, 2, 3};
    WriteTetMesh(folder / "made.vtu", mesh);
    next.scene.tissues[0].mesh = "meniscus.vtu";
    next.files["meniscus.vtu"] = {folder / "made.vtu", {}, {}};
    return next;
  };
  History history(SaveDocument(with_mesh(document, 0.01), scene));
  history.Push(with_mesh(history.current(), 0.02), "Make tetrahedra");
  history.MarkSaved(SaveDocument(history.current(), scene, {history.FilesOnlyOnDisk()}));
  EXPECT_EQ(history.current().scene.tissues[0].mesh, "meniscus-2.vtu");
  history.Undo();
  SaveDocument(history.current(), scene, {history.FilesOnlyOnDisk()});
  EXPECT_EQ(ReadTetMesh(scene / "meniscus.vtu").rest_positions[1].x, 0.01);
  SaveDocument(OpenDocument(scene), scene);
  EXPECT_FALSE(fs::exists(scene / "meniscus-2.vtu")) << "nothing needs it any more";
}

TEST(SaveAgain, ASceneThatOthersHaveChangedKeepsAllTheirFiles) {
  test::TempFolder folder;
  const fs::path scene = folder / "scene";
  const Document ours = SaveDocument(NewScene(folder.path()), scene);
  SaveDocument(WithDepth(OpenDocument(scene), 0.002f), scene);  // saved by another window
  SaveOptions options;
  options.keeps_all_files = true;
  SaveDocument(WithDepth(ours, 0.003f), scene, options);
  EXPECT_EQ(ReadDepthMap(scene / "depth-2.tiff").at(0, 0), 0.002f);
  EXPECT_EQ(LoadScene(scene).depth->at(0, 0), 0.003f);
}

// The saving process is killed at a random moment, so between any two of its steps.
TEST(SaveAgain, AKilledSaveLeavesASceneThatOpensAndNoFileForGood) {
  test::TempFolder folder;
  const fs::path scene = folder / "scene";
  SaveDocument(NewScene(folder.path()), scene);
  constexpr unsigned kSeed = 7;
  std::mt19937 random(kSeed);
  int killed = 0;
  for (int i = 0; i < 40; ++i) {
    const Document document = WithDepth(OpenDocument(scene), 1e-4f * static_cast<float>(i + 1));
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      for (;;)
        SaveDocument(WithDepth(document, 1e-6f * static_cast<float>(i + 1)), scene),
            SaveDocument(document, scene);
    }
    usleep(static_cast<useconds_t>(random() % 20000));
    kill(child, SIGKILL);
    int status = 0;
    waitpid(child, &status, 0);
    killed += WIFSIGNALED(status);
    ASSERT_TRUE(LoadScene(scene).depth) << "kill " << i << ", seed " << kSeed;
    ASSERT_LE(MapsIn(scene), 2u) << "kill " << i << ", seed " << kSeed;
  }
  EXPECT_EQ(killed, 40);
  const Document last = SaveDocument(WithDepth(OpenDocument(scene), 0.009f), scene);
  std::set<std::string> names;
  for (const std::string& name : NamesIn(scene))
    if (!name.starts_with(".")) names.insert(name);  // temporaries of dead processes aside
  EXPECT_EQ(names, (std::set<std::string>{"scene.json", "panorama.png",
                                          last.scene.backdrop.depth.string()}));
  EXPECT_FALSE(HasUnfinishedSave(scene));
}

// The saving process is killed at a random moment while it makes a new folder: there is a whole
// scene or none, and what was begun is known as a leftover.
TEST(SaveAgain, AKilledFirstSaveLeavesAWholeSceneOrNone) {
  test::TempFolder folder;
  const Document document = WithDepth(NewScene(folder.path()), 1e-4f);
  const fs::path scenes = folder / "scenes";
  fs::create_directory(scenes);
  const auto start = std::chrono::steady_clock::now();
  SaveDocument(document, scenes / "first");
  const std::chrono::duration<double, std::micro> one = std::chrono::steady_clock::now() - start;
  constexpr unsigned kSeed = 11;
  std::mt19937 random(kSeed);
  std::uniform_real_distribution<double> moment(0, 1.5 * one.count());
  int whole = 0;
  for (int i = 0; i < 40; ++i) {
    const fs::path scene = scenes / std::to_string(i);
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      SaveDocument(document, scene);
      for (;;) pause();
    }
    usleep(static_cast<useconds_t>(moment(random)));
    kill(child, SIGKILL);
    int status = 0;
    waitpid(child, &status, 0);
    ASSERT_TRUE(WIFSIGNALED(status));
    if (fs::exists(scene)) {
      ++whole;
      EXPECT_EQ(NamesIn(scene), (std::set<std::string>{"scene.json", "panorama.png", "depth.tiff"}))
          << "kill " << i << ", seed " << kSeed;
      EXPECT_TRUE(LoadScene(scene).depth);
    }
  }
  const std::set<std::string> names = NamesIn(scenes);
  const auto begun = std::ranges::count_if(names, [](const std::string& name) {
    return name.starts_with(".") && name.find('/') == name.npos;
  });
  std::printf("of 40 saves %d came to their end and %d were cut short\n", whole,
              static_cast<int>(begun));
  EXPECT_GT(begun, 0) << "no kill came in time";
  arthro::RemoveLeftovers(scenes, std::chrono::seconds(0));
  for (const std::string& name : NamesIn(scenes)) EXPECT_FALSE(name.starts_with(".")) << name;
}

}  // namespace
}  // namespace arthro::authoring
