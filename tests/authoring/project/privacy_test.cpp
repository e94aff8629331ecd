// A copy of a scene carries pixels, shapes and values, and no name of a patient.
#include <memory>

#include <gtest/gtest.h>

#include "authoring/project/document_io.h"
#include "authoring/project/files/written_files.h"
#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"
#include "simulation/scene/files/archive_io.h"
#include "simulation/scene/files/scene_io.h"
#include "simulation/scene/image_io.h"
#include "simulation/scene/mesh/mesh_io.h"
#include "tests/support/knee_picture.h"
#include "tests/support/marked_picture.h"
#include "tests/support/temp_folder.h"

namespace arthro::authoring {
namespace {

namespace fs = std::filesystem;

// The files below `folder` that name the patient.
std::string NamingFiles(const fs::path& folder) {
  std::string names;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file() &&
        ReadWholeFile(entry.path()).find(test::kPatient) != std::string::npos)
      names += entry.path().filename().string() + " ";
  return names;
}

std::string NamingFilesOfArchive(const fs::path& archive) {
  test::TempFolder folder;
  UnpackScene(archive, folder.path());
  return NamingFiles(folder.path());
}

// An upright picture with the marks of its format, under the given name.
fs::path WritePhoto(const test::TempFolder& folder, const std::string& name, int orientation = 1) {
  const fs::path file = folder / name;
  WriteColourImage(file, test::KneePicture(96, 64));
  const std::string bytes = ReadWholeFile(file);
  WriteAtomically(file, file.extension() == ".png" ? test::MarkedPng(bytes, orientation)
                                                   : test::MarkedJpeg(bytes, orientation));
  return file;
}

TEST(Privacy, APhotoSavedAsASceneIsNothingButItsPixels) {
  for (const char* name : {"photo.jpg", "photo.png"}) {
    test::TempFolder folder;
    const Document photo = OpenDocument(WritePhoto(folder, name));
    const Document saved = SaveDocument(photo, folder / "scene");
    EXPECT_EQ(NamingFiles(folder / "scene"), "") << name;
    EXPECT_EQ(saved.scene.backdrop.panorama.extension(), fs::path(name).extension())
        << "its compressed pixels are kept";
    EXPECT_EQ(OpenDocument(folder / "scene").panorama->rgb, photo.panorama->rgb);
    SaveDocument(photo, folder / "scene.arthro");
    EXPECT_EQ(NamingFilesOfArchive(folder / "scene.arthro"), "") << name;
  }
}

// Whatever the decoder makes of the note, the picture that was shown is the one that is saved.
TEST(Privacy, ATurnedPhotoStaysAsItWasShown) {
  for (const char* name : {"photo.jpg", "photo.png"})
    for (int orientation = 1; orientation <= 8; ++orientation) {
      test::TempFolder folder;
      const Document photo = OpenDocument(WritePhoto(folder, name, orientation));
      if (fs::path(name).extension() == ".jpg") {
        EXPECT_EQ(photo.panorama->width, orientation >= 5 ? 64 : 96);
      }
      SaveDocument(photo, folder / "scene");
      const Document back = OpenDocument(folder / "scene");
      EXPECT_EQ(back.panorama->width, photo.panorama->width);
      EXPECT_EQ(back.panorama->rgb, photo.panorama->rgb) << name << " " << orientation;
      EXPECT_EQ(NamingFiles(folder / "scene"), "") << name << " " << orientation;
    }
}

TEST(Privacy, ATiffIsWrittenAnewFromItsPixels) {
  test::TempFolder folder;
  WriteColourImage(folder / "photo.tiff", test::KneePicture(96, 64));
  WriteAtomically(folder / "photo.tiff", ReadWholeFile(folder / "photo.tiff") + test::kPatient);
  const Document photo = OpenDocument(folder / "photo.tiff");
  SaveDocument(photo, folder / "scene");
  EXPECT_EQ(NamingFiles(folder / "scene"), "");
  EXPECT_EQ(OpenDocument(folder / "scene").panorama->rgb, photo.panorama->rgb);
}

// A scene that somebody put together by hand, with the patient's name in every file of it.
fs::path WriteMarkedScene(const test::TempFolder& folder) {
  const fs::path scene = folder / "marked";
  fs::create_directory(scene);
  const std::string patient = test::kPatient;
  fs::rename(WritePhoto(folder, "photo.jpg"), scene / "panorama.jpg");
  WriteDepthMap(scene / "depth.tiff", DepthMap(96, 64, 0.01f));
  WriteAtomically(scene / "depth.tiff", ReadWholeFile(scene / "depth.tiff") + patient);
  const std::string triangles = "v 0 0 0\nv 0.01 0 0\nv 0 0.01 0\nf 1 2 3\n";
  WriteAtomically(scene / "a.obj", "# " + patient + "\no " + patient + "\n" + triangles);
  WriteSurface(scene / "b.ply", {{{0, 0, 0}, {0.01, 0, 0}, {0, 0.01, 0}}, {{0, 1, 2}}});
  std::string ply = ReadWholeFile(scene / "b.ply");
  WriteAtomically(scene / "b.ply", ply.insert(ply.find("element"), "comment " + patient + "\n"));
  WriteSurface(scene / "c.stl", {{{0, 0, 0}, {0.01, 0, 0}, {0, 0.01, 0}}, {{0, 1, 2}}});
  std::string stl = ReadWholeFile(scene / "c.stl");
  WriteAtomically(scene / "c.stl", stl.replace(0, patient.size(), patient));
  TetMesh mesh;
  mesh.rest_positions = {{0, 0, 0}, {0.01, 0, 0}, {0, 0.01, 0}, {0, 0, 0.01}};
  mesh.elements = {0, 1, 2, 3};
  mesh.sets["held"] = {1, 0, 0, 0};
  WriteTetMesh(scene / "d.vtu", mesh);
  std::string vtu = ReadWholeFile(scene / "d.vtu");
  WriteAtomically(scene / "d.vtu",
                  vtu.insert(vtu.find("<UnstructuredGrid>"), "<!-- " + patient + " -->\n"));
  WriteAtomically(scene / "lens.json",
                  R"({"model": "equisolid", "width": 720, "height": 576, "focal_px": 330,
                      "cx": 360, "cy": 288, "circle": {"cx": 360, "cy": 288, "r": 250},
                      "x-patient": "Jane Doe"})");
  Scene values;
  values.title = "Knee";
  values.backdrop.panorama = "panorama.jpg";
  values.backdrop.depth = "depth.tiff";
  values.backdrop.projection = GuessProjection(96, 64);
  values.scope.lens = "lens.json";
  for (const char* surface : {"a.obj", "b.ply", "c.stl"}) {
    Tissue& tissue = values.tissues.emplace_back();
    tissue.name = tissue.surface = surface;
  }
  values.tissues[0].mesh = "d.vtu";
  values.extensions["x-patient"] = "\"Jane Doe\"";
  WriteScene(scene / "scene.json", values);
  return scene;
}

TEST(Privacy, NoFileOfACopyNamesThePatient) {
  test::TempFolder folder;
  const fs::path scene = WriteMarkedScene(folder);
  ASSERT_NE(NamingFiles(scene), "");
  const Document document = OpenDocument(scene);
  SaveDocument(document, folder / "copy");
  EXPECT_EQ(NamingFiles(folder / "copy"), "");
  SaveDocument(document, folder / "copy.arthro");
  EXPECT_EQ(NamingFilesOfArchive(folder / "copy.arthro"), "");
  // And it is the same scene.
  const Document copy = OpenDocument(folder / "copy");
  EXPECT_EQ(copy.panorama->rgb, document.panorama->rgb);
  EXPECT_EQ(copy.depth->relief, document.depth->relief);
  EXPECT_EQ(copy.lens, document.lens);
  ASSERT_EQ(copy.surfaces.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_EQ(copy.surfaces[i]->vertices, document.surfaces[i]->vertices);
  EXPECT_EQ(ReadTetMesh(folder / "copy" / copy.scene.tissues[0].mesh).sets.count("held"), 1u);
}

TEST(Privacy, SavingInPlaceLeavesAPersonsOwnFilesAndKeysAlone) {
  test::TempFolder folder;
  const fs::path scene = WriteMarkedScene(folder);
  const std::string photo = ReadWholeFile(scene / "panorama.jpg");
  Document document = OpenDocument(scene);
  document.scene.title = "Other";
  SaveDocument(document, scene);
  EXPECT_EQ(ReadWholeFile(scene / "panorama.jpg"), photo);
  EXPECT_EQ(ReadScene(scene).extensions.at("x-patient"), "\"Jane Doe\"");
}

TEST(Privacy, ACopyDoesNotFollowALinkOutOfTheScenesFolder) {
  test::TempFolder folder;
  const fs::path scene = WriteMarkedScene(folder);
  const auto fault = [&]() -> std::string {
    try {
      SaveDocument(OpenDocument(scene), folder / "copy.arthro");
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  for (const char* name : {"d.vtu", "b.ply", "panorama.jpg", "depth.tiff", "lens.json"}) {
    fs::rename(scene / name, folder / name);
    fs::create_symlink(folder / name, scene / name);
    EXPECT_NE(fault().find("link to a file outside"), std::string::npos) << name;
    EXPECT_FALSE(fs::exists(folder / "copy.arthro")) << name;
    fs::remove(scene / name);
    fs::rename(folder / name, scene / name);
  }
  EXPECT_EQ(fault(), "");
}

TEST(Privacy, ASaveWritesAndRemovesNothingBehindALink) {
  test::TempFolder folder;
  const fs::path scene = WriteMarkedScene(folder), diary = folder / "diary.txt";
  fs::create_directory(folder / "home");
  WriteAtomically(diary, "mine");
  WriteAtomically(folder / "home/known.txt", "of a known content");
  Document document = OpenDocument(scene);
  // A stranger could have put these there: the hidden list of a save, and a folder of assets.
  fs::create_symlink(diary, scene / ".unfinished-save.json");
  fs::create_symlink(folder / "home", scene / "sub");
  document.scene.backdrop.depth = "sub/depth.tiff";
  document.depth = std::make_shared<const DepthMap>(96, 64, 0.02f);
  EXPECT_THROW(SaveDocument(document, scene), Error);
  EXPECT_FALSE(fs::exists(folder / "home/depth.tiff"));
  document.scene.backdrop.depth = "depth.tiff";
  const Document saved = SaveDocument(document, scene);
  EXPECT_EQ(saved.scene.backdrop.depth, "depth-2.tiff");
  EXPECT_EQ(ReadWholeFile(diary), "mine");
  // A list of files to remove that names one behind the link, with its true fingerprint.
  Scene values = ReadScene(scene);
  values.extensions["x-files-written"] =
      JsonFromWrittenFiles({{"sub/known.txt", FingerprintOfFile(folder / "home/known.txt")}});
  WriteScene(scene / "scene.json", values);
  SaveDocument(OpenDocument(scene), scene);
  EXPECT_TRUE(fs::exists(folder / "home/known.txt"));
}

TEST(Privacy, ASecretUnderAMeshesNameIsNotCarriedAlong) {
  test::TempFolder folder;
  const fs::path scene = WriteMarkedScene(folder);
  WriteAtomically(scene / "d.vtu", "-----BEGIN OPENSSH PRIVATE KEY-----");
  const Document document = OpenDocument(scene);
  EXPECT_THROW(SaveDocument(document, folder / "copy"), Error);
  EXPECT_THROW(SaveDocument(document, folder / "copy.arthro"), Error);
  EXPECT_FALSE(fs::exists(folder / "copy"));
}

}  // namespace
}  // namespace arthro::authoring
