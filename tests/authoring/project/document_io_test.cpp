#include "authoring/project/document_io.h"

#include <csignal>
#include <cstring>
#include <map>
#include <sys/resource.h>

#include <gtest/gtest.h>

#include "authoring/project/history.h"
#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"
#include "simulation/core/options_json.h"
#include "simulation/scene/files/scene_io.h"
#include "simulation/scene/image_io.h"
#include "simulation/scene/json/scene_json.h"
#include "simulation/scene/mesh/mesh_io.h"
#include "tests/support/knee_picture.h"
#include "tests/support/temp_folder.h"

namespace arthro::authoring {
namespace {

namespace fs = std::filesystem;

SurfaceMesh Tetrahedron(double size) {
  return {{{0, 0, 0.02}, {size, 0, 0.02}, {0, size, 0.02}, {0, 0, 0.02 + size}},
          {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
}

// Files that an author would bring along.
struct Sources {
  explicit Sources(const fs::path& folder) : folder_(folder) {
    WriteColourImage(folder / "clip panorama.JPG", test::KneePicture(96, 64));
    TetMesh mesh;
    mesh.rest_positions = Tetrahedron(0.01).vertices;
    mesh.elements = {0, 1, 2, 3};
    WriteTetMesh(folder / "made.vtu", mesh);
    WriteAtomically(folder / "lens.json",
                    R"({"model": "equisolid", "width": 720, "height": 576, "focal_px": 330,
                      "cx": 360, "cy": 288, "circle": {"cx": 360, "cy": 288, "r": 250}})");
  }

  // A document as authoring makes it: imported picture, filtered depth, a tissue with tetrahedra.
  Document Author() const {
    Document document = OpenDocument(folder_ / "clip panorama.JPG");
    document.depth_options.near_relief = 0.015;
    document.depth = std::make_shared<const DepthMap>(
        DepthMap(document.panorama->width, document.panorama->height, 0.01f));
    document.scene.tissues.emplace_back().name = "Medial meniscus";
    document.scene.tissues[0].mesh = "meniscus.vtu";
    document.files["meniscus.vtu"].file = folder_ / "made.vtu";
    document.surfaces.push_back(std::make_shared<const SurfaceMesh>(Tetrahedron(0.01)));
    document.scene.scope.lens = "lens.json";
    document.files["lens.json"].file = folder_ / "lens.json";
    return document;
  }

  fs::path folder_;
};

std::map<std::string, std::string> FilesOf(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file())
      files[fs::relative(entry.path(), folder).string()] = ReadWholeFile(entry.path());
  return files;
}

void ExpectSame(const Document& a, const Document& b) {
  EXPECT_EQ(PrettyJson(JsonFromScene(a.scene)), PrettyJson(JsonFromScene(b.scene)));
  EXPECT_EQ(JsonFromOptions(a.depth_options), JsonFromOptions(b.depth_options));
  EXPECT_EQ(a.panorama->rgb, b.panorama->rgb);
  EXPECT_EQ(a.depth->relief, b.depth->relief);
  ASSERT_EQ(a.surfaces.size(), b.surfaces.size());
  for (std::size_t i = 0; i < a.surfaces.size(); ++i) {
    EXPECT_EQ(a.surfaces[i]->vertices, b.surfaces[i]->vertices);
    EXPECT_EQ(a.surfaces[i]->triangles, b.surfaces[i]->triangles);
  }
}

TEST(DocumentIo, ABarePictureBecomesAGnomonicDocument) {
  test::TempFolder folder;
  Sources sources(folder.path());
  const Document document = OpenDocument(folder / "clip panorama.JPG");
  EXPECT_EQ(document.scene.title, "clip panorama");
  EXPECT_TRUE(document.folder.empty());
  EXPECT_EQ(document.panorama->width, 96);
  EXPECT_EQ(document.depth, nullptr);
  const Projection& projection = document.scene.backdrop.projection;
  EXPECT_EQ(projection.type, ProjectionType::kGnomonic);
  EXPECT_EQ(projection.centre_px, glm::dvec2(47.5, 31.5));
  EXPECT_NEAR(2 * std::atan(48 / projection.focal_px) * 180 / std::numbers::pi, 105, 1e-9);
}

TEST(DocumentIo, SavingAndOpeningGivesTheSameDocument) {
  test::TempFolder folder;
  const Sources sources(folder.path());
  const Document document = sources.Author();
  const Document saved = SaveDocument(document, folder / "scene");
  const auto files = FilesOf(folder / "scene");
  EXPECT_EQ(files.size(), 6u);
  EXPECT_EQ(files.at("panorama.jpg"), ReadWholeFile(folder / "clip panorama.JPG"))
      << "the imported file is kept byte for byte";
  EXPECT_TRUE(files.contains("depth.tiff"));
  EXPECT_TRUE(files.contains("medial-meniscus.ply"));
  EXPECT_TRUE(files.contains("meniscus.vtu"));
  const Document back = OpenDocument(folder / "scene");
  ExpectSame(saved, back);
  EXPECT_EQ(back.depth_options.near_relief, 0.015);
  EXPECT_EQ(back.panorama->rgb, document.panorama->rgb);
}

TEST(DocumentIo, SavingWhatIsSavedChangesNoByteAndNoFile) {
  test::TempFolder folder;
  const Sources sources(folder.path());
  const Document saved = SaveDocument(sources.Author(), folder / "scene");
  const auto before = FilesOf(folder / "scene");
  ExpectSame(SaveDocument(saved, folder / "scene"), saved);
  EXPECT_EQ(FilesOf(folder / "scene"), before);
  // Also a document that does not know where its files are.
  Document forgetful = OpenDocument(folder / "scene");
  forgetful.files.clear();
  SaveDocument(forgetful, folder / "scene");
  EXPECT_EQ(FilesOf(folder / "scene"), before);
}

TEST(DocumentIo, SaveAsIntoAnotherFolderCopiesEverything) {
  test::TempFolder folder;
  const Sources sources(folder.path());
  const Document saved = SaveDocument(sources.Author(), folder / "one");
  SaveDocument(OpenDocument(folder / "one"), folder / "two");
  EXPECT_EQ(FilesOf(folder / "two"), FilesOf(folder / "one"));
  fs::remove_all(folder / "one");
  ExpectSame(OpenDocument(folder / "two"), saved);
}

TEST(DocumentIo, ACopyHoldsThePicturesAndRecordingsOfItsExercises) {
  test::TempFolder folder;
  Document document = Sources(folder.path()).Author();
  Exercise exercise;
  exercise.id = "look";
  exercise.ghost = "expert.attempt";
  exercise.picture = "look.png";
  document.scene.exercises = {exercise};
  WriteAtomically(folder / "expert.attempt", "frames");
  WriteColourImage(folder / "look.png", ColourImage(8, 8));
  for (const char* name : {"expert.attempt", "look.png"})
    document.files[name] = {folder / name, {}, {}};
  const Document saved = SaveDocument(document, folder / "scene");
  const Document copy = SaveDocument(saved, folder / "copy");
  fs::remove_all(folder / "scene");
  const Document opened = OpenDocument(folder / "copy");
  EXPECT_EQ(ReadWholeFile(FileOf(opened, opened.scene.exercises.at(0).ghost)), "frames");
  EXPECT_EQ(ReadColourImage(FileOf(opened, opened.scene.exercises.at(0).picture)).width, 8);
  ExpectSame(SaveDocument(opened, folder / "copy"), opened);
}

TEST(DocumentIo, AnArchiveIsOpenedChangedAndSavedLikeAFolder) {
  test::TempFolder folder;
  const Sources sources(folder.path());
  const Document saved = SaveDocument(sources.Author(), folder / "scene.arthro");
  EXPECT_EQ(saved.folder, folder / "scene.arthro");
  Document opened = OpenDocument(folder / "scene.arthro");
  ExpectSame(opened, saved);
  opened.scene.title = "changed";
  const Document again = SaveDocument(opened, folder / "scene.arthro");
  ExpectSame(OpenDocument(folder / "scene.arthro"), again);
  ExpectSame(SaveDocument(again, folder / "as folder"), again);
  const std::string before = ReadWholeFile(folder / "scene.arthro");
  opened.scene.backdrop.radius = -1;
  EXPECT_THROW(SaveDocument(opened, folder / "scene.arthro"), Error);
  EXPECT_EQ(ReadWholeFile(folder / "scene.arthro"), before);
}

TEST(DocumentIo, ANewDepthGetsANewFileAndUndoFindsTheOldOne) {
  test::TempFolder folder;
  const Sources sources(folder.path());
  History history(SaveDocument(sources.Author(), folder / "scene"));
  Document next = history.current();
  next.depth = std::make_shared<const DepthMap>(DepthMap(96, 64, 0.005f));
  history.Push(next, "Filter depth");
  history.MarkSaved(SaveDocument(history.current(), folder / "scene"));
  EXPECT_TRUE(history.IsSaved());
  EXPECT_EQ(ReadScene(folder / "scene").backdrop.depth, "depth-2.tiff");
  EXPECT_EQ(OpenDocument(folder / "scene").depth->at(5, 5), 0.005f);
  history.Undo();
  SaveDocument(history.current(), folder / "scene");
  EXPECT_EQ(ReadScene(folder / "scene").backdrop.depth, "depth.tiff");
  EXPECT_EQ(OpenDocument(folder / "scene").depth->at(5, 5), 0.01f);
}

TEST(DocumentIo, AForeignFileOfTheSameNameIsLeftAlone) {
  test::TempFolder folder;
  const Sources sources(folder.path());
  fs::create_directory(folder / "scene");
  WriteAtomically(folder / "scene/depth.tiff", "a letter");
  const Document saved = SaveDocument(sources.Author(), folder / "scene");
  EXPECT_EQ(ReadWholeFile(folder / "scene/depth.tiff"), "a letter");
  EXPECT_EQ(saved.scene.backdrop.depth, "depth-2.tiff");
  ExpectSame(OpenDocument(folder / "scene"), saved);
}

// The same document with a measured relief: a depth map, its standard error and its origins.
Document Measured(Document document) {
  const int width = document.panorama->width, height = document.panorama->height;
  SetDepth(document, Share(DepthMap(width, height, 0.012f)));
  document.is_depth_imported = true;
  document.depth_sigma = Share(DepthMap(width, height, 0.0003f));
  OriginMap origins(width, height, ReliefOrigin::kMeasured);
  origins.at(7, 3) = ReliefOrigin::kInterpolated;
  document.depth_origin = Share(std::move(origins));
  return document;
}

TEST(DocumentIo, KeepsTheErrorAndTheOriginsOfTheDepthMap) {
  test::TempFolder folder;
  const Sources sources(folder.path());
  const Document saved = SaveDocument(Measured(sources.Author()), folder / "scene");
  EXPECT_EQ(saved.scene.backdrop.depth_sigma, "depth-sigma.tiff");
  EXPECT_EQ(saved.scene.backdrop.depth_origin, "depth-origin.png");
  const auto files = FilesOf(folder / "scene");
  Document opened = OpenDocument(folder / "scene");
  ExpectSame(opened, saved);
  EXPECT_TRUE(opened.is_depth_imported);
  EXPECT_EQ(opened.depth_sigma->relief, saved.depth_sigma->relief);
  EXPECT_EQ(opened.depth_origin->origin, saved.depth_origin->origin);
  SaveDocument(opened, folder / "scene");
  EXPECT_EQ(FilesOf(folder / "scene"), files) << "saved again, nothing changes";
  SaveDocument(opened, folder / "copy.arthro");
  EXPECT_EQ(OpenDocument(folder / "copy.arthro").depth_origin->at(7, 3),
            ReliefOrigin::kInterpolated);
}

TEST(DocumentIo, AnotherDepthMapHasNeitherErrorNorOriginsOfTheFirst) {
  test::TempFolder folder;
  const Sources sources(folder.path());
  const Document saved = SaveDocument(Measured(sources.Author()), folder / "scene");
  for (const auto& depth : {Share(DepthMap(96, 64, 0.004f)), std::shared_ptr<const DepthMap>()}) {
    Document changed = saved;
    SetDepth(changed, saved.depth);
    EXPECT_TRUE(changed.depth_sigma) << "the same map keeps them";
    SetDepth(changed, depth);
    EXPECT_FALSE(changed.depth_sigma);
    EXPECT_FALSE(changed.depth_origin);
    SaveDocument(changed, folder / "scene");
    const Document opened = OpenDocument(folder / "scene");
    EXPECT_FALSE(opened.depth_sigma);
    EXPECT_FALSE(opened.depth_origin);
    EXPECT_FALSE(fs::exists(folder / "scene/depth-sigma.tiff")) << "nothing names it any more";
  }
}

TEST(DocumentIo, WithoutDepthTheSceneIsABareSphere) {
  test::TempFolder folder;
  const Sources sources(folder.path());
  Document document = sources.Author();
  document.depth = nullptr;
  document.scene.backdrop.depth = "depth.tiff";
  SaveDocument(document, folder / "scene");
  EXPECT_EQ(OpenDocument(folder / "scene").depth, nullptr);
}

// The disk "fills up" after every possible number of bytes a file: whatever is cut short, the scene
// that was there is there unchanged, with nothing beside it.
TEST(DocumentIo, AFullDiskLeavesTheOldSceneWhole) {
  test::TempFolder folder;
  const Sources sources(folder.path());
  const Document saved = SaveDocument(sources.Author(), folder / "scene");
  const auto before = FilesOf(folder / "scene");
  Document changed = saved;
  changed.scene.title = "changed";
  changed.depth = std::make_shared<const DepthMap>(DepthMap(96, 64, 0.004f));
  changed.panorama = std::make_shared<const ColourImage>(test::KneePicture(96, 64, 20.0));
  changed.surfaces[0] = std::make_shared<const SurfaceMesh>(Tetrahedron(0.02));

  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit usual{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &usual), 0);
  int refused = 0;
  for (rlim_t bytes = 1; bytes < 100000; bytes = bytes * 3 / 2 + 1) {
    rlimit small = usual;
    small.rlim_cur = bytes;
    std::string fault;
    setrlimit(RLIMIT_FSIZE, &small);
    try {
      SaveDocument(changed, folder / "scene");
      SaveDocument(changed, folder / "new");
    } catch (const Error& error) {
      fault = error.what();
    }
    setrlimit(RLIMIT_FSIZE, &usual);
    if (fault.empty()) break;
    ++refused;
    EXPECT_NE(fault.find("no more may be written here"), std::string::npos) << fault;
    EXPECT_EQ(FilesOf(folder / "scene"), before) << bytes << " bytes a file";
    EXPECT_FALSE(fs::exists(folder / "new"));
  }
  std::signal(SIGXFSZ, handler);
  EXPECT_GT(refused, 10);
  EXPECT_EQ(ReadScene(folder / "scene").title, "changed") << "with room enough it is saved";
}

// A new folder is filled under another name: what is said, and what the document holds, is of the
// one that was asked for.
TEST(DocumentIo, ANewFolderMayBeNamedInAnyWay) {
  test::TempFolder folder;
  const Sources sources(folder.path());
  const fs::path here = fs::current_path();
  fs::current_path(folder.path());
  fs::create_directories("elsewhere/scenes");
  fs::create_symlink("elsewhere/scenes", "link");
  for (const char* const name : {"made", "./dotted", "slashed/", "link/../roundabout"}) {
    const Document saved = SaveDocument(sources.Author(), name);
    EXPECT_EQ(saved.folder, name);
    for (const auto& [asset, held] : saved.files) {
      EXPECT_TRUE(fs::is_regular_file(held.file)) << held.file;
      EXPECT_TRUE(fs::equivalent(held.file, saved.folder / asset)) << held.file;
    }
    const auto before = FilesOf(name);
    SaveDocument(saved, name);
    EXPECT_EQ(FilesOf(name), before) << "saved again, no file changes";
    fs::remove_all(name);
  }
  Document bad = sources.Author();
  bad.depth = std::make_shared<const DepthMap>(DepthMap(3, 3));
  bad.scene.backdrop.depth = "depth.tiff";
  try {
    SaveDocument(bad, "made/");
    ADD_FAILURE() << "it was saved";
  } catch (const Error& error) {
    EXPECT_EQ(error.file(), fs::path("made/depth.tiff"));
  }
  fs::create_symlink(folder / "nowhere", "dangling");
  EXPECT_THROW(SaveDocument(sources.Author(), "dangling"), Error);
  EXPECT_TRUE(fs::is_symlink("dangling"));
  EXPECT_FALSE(fs::exists("nowhere"));
  EXPECT_THROW(SaveDocument(sources.Author(), "no/../made"), Error);
  EXPECT_THROW(SaveDocument(sources.Author(), ""), Error);
  fs::current_path(here);
  for (const fs::directory_entry& entry : fs::directory_iterator(folder.path()))
    EXPECT_EQ(entry.path().filename().string().find(".partial"), std::string::npos) << entry.path();
}

TEST(DocumentIo, SaysInOneSentenceWhyItCannotSave) {
  test::TempFolder folder;
  const Sources sources(folder.path());
  const auto fault = [&](const Document& document, const fs::path& place) -> std::string {
    try {
      SaveDocument(document, place);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  const Document good = sources.Author();
  Document no_panorama = good, no_surface = good, no_mesh = good, bad_size = good, nan = good;
  no_panorama.panorama = nullptr;
  no_surface.surfaces.clear();
  no_mesh.files.clear();
  bad_size.depth = std::make_shared<const DepthMap>(DepthMap(3, 3));
  nan.scene.backdrop.radius = std::nan("");
  EXPECT_NE(fault(no_panorama, folder / "s").find("import one first"), std::string::npos);
  EXPECT_NE(fault(no_surface, folder / "s").find("has no surface"), std::string::npos);
  EXPECT_NE(fault(no_mesh, folder / "s").find("can no longer be found"), std::string::npos);
  EXPECT_NE(fault(bad_size, folder / "s").find("3 x 3"), std::string::npos);
  Document bad_sigma = Measured(good), bad_origins = Measured(good);
  bad_sigma.depth_sigma = Share(DepthMap(3, 3));
  bad_origins.depth_origin = Share(OriginMap(4, 3));
  EXPECT_NE(fault(bad_sigma, folder / "s").find("error is 3 x 3"), std::string::npos);
  EXPECT_NE(fault(bad_origins, folder / "s").find("origins is 4 x 3"), std::string::npos);
  EXPECT_NE(fault(nan, folder / "s").find("backdrop.radius"), std::string::npos);
  EXPECT_NE(fault(good, folder / "no/such/place").find("could not be made"), std::string::npos);
  EXPECT_NE(fault(good, folder / "lens.json").find("could not be made"), std::string::npos);
  EXPECT_NE(fault(good, "/proc/scene").find("could not be made"), std::string::npos);
  EXPECT_FALSE(fs::exists(folder / "s")) << "a save that fails leaves nothing behind";
}

}  // namespace
}  // namespace arthro::authoring
