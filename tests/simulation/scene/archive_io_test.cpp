#include "simulation/scene/files/archive_io.h"

#include <map>
#include <sys/stat.h>
#include <vector>
#include <zip.h>

#include <gtest/gtest.h>

#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"
#include "simulation/scene/files/scene_io.h"
#include "simulation/scene/image_io.h"
#include "simulation/scene/mesh/mesh_io.h"
#include "tests/support/temp_folder.h"

namespace arthro {
namespace {

namespace fs = std::filesystem;

void WriteSmallScene(const fs::path& folder) {
  Scene scene;
  scene.title = "small";
  scene.backdrop.panorama = "pictures/p.png";
  scene.backdrop.depth = "d.tiff";
  scene.backdrop.projection = {ProjectionType::kGnomonic, {7.5, 3.5}, 9.0, 10.0};
  scene.tissues.resize(1);
  scene.tissues[0].name = "meniscus";
  scene.tissues[0].surface = "m.ply";
  fs::create_directories(folder / "pictures");
  WriteColourImage(folder / "pictures/p.png", ColourImage(16, 8));
  WriteDepthMap(folder / "d.tiff", DepthMap(16, 8, 0.01f));
  WriteSurface(folder / "m.ply", {{{0, 0, 0}, {0.01, 0, 0}, {0, 0.01, 0}}, {{0, 1, 2}}});
  WriteScene(folder / "scene.json", scene);
}

std::map<std::string, std::string> FilesOf(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (!entry.is_directory())
      files[fs::relative(entry.path(), folder).string()] = ReadWholeFile(entry.path());
  return files;
}

struct Entry {
  std::string name, bytes;
  mode_t kind = S_IFREG;
};

// An archive as a stranger could make it.
void WriteZip(const fs::path& file, const std::vector<Entry>& entries) {
  zip_t* zip = zip_open(file.c_str(), ZIP_CREATE | ZIP_TRUNCATE, nullptr);
  ASSERT_NE(zip, nullptr);
  for (const Entry& entry : entries) {
    zip_source_t* bytes = zip_source_buffer(zip, entry.bytes.data(), entry.bytes.size(), 0);
    const zip_int64_t index = zip_file_add(zip, entry.name.c_str(), bytes, ZIP_FL_ENC_UTF_8);
    ASSERT_GE(index, 0) << entry.name;
    zip_file_set_external_attributes(zip, static_cast<zip_uint64_t>(index), 0, ZIP_OPSYS_UNIX,
                                     static_cast<zip_uint32_t>(entry.kind | 0644) << 16);
  }
  ASSERT_EQ(zip_close(zip), 0);
}

std::string FaultOfUnpacking(const fs::path& archive, const ArchiveLimits& limits = {}) {
  test::TempFolder outer;
  fs::create_directory(outer / "inner");
  std::string fault;
  try {
    UnpackScene(archive, outer / "inner", limits);
  } catch (const Error& error) {
    fault = error.what();
  }
  EXPECT_EQ(std::distance(fs::directory_iterator(outer.path()), {}), 1) << "something got out";
  return fault;
}

TEST(ArchiveIo, PackingAndUnpackingGivesTheSameFilesAndOnlyThose) {
  test::TempFolder folder;
  fs::create_directory(folder / "scene");
  WriteSmallScene(folder / "scene");
  const auto files = FilesOf(folder / "scene");
  WriteAtomically(folder / "scene/patient.txt", "private");
  PackScene(folder / "scene", folder / "s.arthro");
  fs::create_directory(folder / "back");
  UnpackScene(folder / "s.arthro", folder / "back");
  EXPECT_EQ(FilesOf(folder / "back"), files) << "what the scene does not name stays at home";
}

TEST(ArchiveIo, CarriesTheErrorAndTheOriginsOfTheDepthMap) {
  test::TempFolder folder;
  fs::create_directory(folder / "scene");
  WriteSmallScene(folder / "scene");
  Scene scene = ReadScene(folder / "scene");
  const DepthMap depth = ReadDepthMap(folder / "scene/d.tiff");
  scene.backdrop.depth_sigma = "s.tiff";
  scene.backdrop.depth_origin = "o.png";
  WriteDepthMap(folder / "scene/s.tiff", DepthMap(depth.width, depth.height, 0.0004f));
  WriteOriginMap(folder / "scene/o.png",
                 OriginMap(depth.width, depth.height, ReliefOrigin::kBrightness));
  WriteScene(folder / "scene/scene.json", scene);
  PackScene(folder / "scene", folder / "s.arthro");
  const LoadedScene loaded = LoadScene(folder / "s.arthro");
  EXPECT_EQ(loaded.depth_sigma->at(3, 3), 0.0004f);
  EXPECT_EQ(loaded.depth_origin->at(3, 3), ReliefOrigin::kBrightness);
}

TEST(ArchiveIo, TheSameSceneGivesTheSameBytes) {
  test::TempFolder folder;
  fs::create_directory(folder / "scene");
  WriteSmallScene(folder / "scene");
  PackScene(folder / "scene", folder / "a.arthro");
  fs::last_write_time(folder / "scene/d.tiff", fs::file_time_type::clock::now());
  PackScene(folder / "scene/scene.json", folder / "b.arthro");
  EXPECT_EQ(ReadWholeFile(folder / "a.arthro"), ReadWholeFile(folder / "b.arthro"));
}

TEST(ArchiveIo, ASceneIsLoadedFromItsArchive) {
  test::TempFolder folder;
  fs::create_directory(folder / "scene");
  WriteSmallScene(folder / "scene");
  PackScene(folder / "scene", folder / "s.arthro");
  fs::remove_all(folder / "scene");
  EXPECT_EQ(ReadScene(folder / "s.arthro").title, "small");
  fs::path unpacked;
  {
    const LoadedScene loaded = LoadScene(folder / "s.arthro");
    unpacked = loaded.unpacked->path();
    EXPECT_EQ(loaded.folder, folder / "s.arthro");
    EXPECT_EQ(loaded.depth->at(3, 3), 0.01f);
    EXPECT_EQ(loaded.surfaces[0]->triangles.size(), 1u);
    EXPECT_TRUE(fs::exists(unpacked / "m.ply")) << "files stay while somebody holds the scene";
  }
  EXPECT_FALSE(fs::exists(unpacked));
}

TEST(ArchiveIo, NothingGetsOutOfItsFolder) {
  test::TempFolder folder;
  for (const char* name :
       {"../evil", "a/../../evil", "/tmp/arthro-evil", "..\\evil", "C:\\evil", "a/./b", "ev\nil"}) {
    WriteZip(folder / "e.arthro", {{"scene.json", "{}"}, {name, "evil"}});
    EXPECT_NE(FaultOfUnpacking(folder / "e.arthro").find("outside its folder"), std::string::npos)
        << name << ": " << FaultOfUnpacking(folder / "e.arthro");
  }
  EXPECT_FALSE(fs::exists("/tmp/arthro-evil"));
  WriteZip(folder / "l.arthro", {{"scene.json", "{}"}, {"link", "/etc/passwd", S_IFLNK}});
  EXPECT_NE(FaultOfUnpacking(folder / "l.arthro").find("link"), std::string::npos);
}

TEST(ArchiveIo, NamesThatNoFileSystemTakesAreRefusedInOneShortSentence) {
  test::TempFolder folder;
  for (const std::size_t letters : {256u, 60000u}) {
    WriteZip(folder / "n.arthro", {{"scene.json", "{}"}, {std::string(letters, 'n'), "x"}});
    const std::string fault = FaultOfUnpacking(folder / "n.arthro");
    EXPECT_NE(fault.find(std::to_string(letters) + " letters"), std::string::npos) << fault;
    EXPECT_LT(fault.size(), 400u);
  }
  std::string deep = "a";
  for (int i = 0; i < 1000; ++i) deep += "/a";
  WriteZip(folder / "d.arthro", {{"scene.json", "{}"}, {deep, "x"}});
  EXPECT_NE(FaultOfUnpacking(folder / "d.arthro").find("2001 letters"), std::string::npos);
}

// The folder that it was unpacked into is gone when the sentence is read.
TEST(ArchiveIo, FaultsInsideNameTheArchiveAndTheFileInIt) {
  test::TempFolder folder;
  const fs::path archive = folder / "s.arthro";
  const auto faults = [&] {
    std::vector<std::string> all;
    LoadScene(archive, all);
    try {
      ReadScene(archive);
    } catch (const Error& error) {
      all.push_back(error.what());
    }
    return all;
  };
  for (const auto& entries : std::vector<std::vector<Entry>>{
           {{"scene.json", "{\"schema\": 7}"}},
           {{"scene.json", std::string(100000, '[')}},
           {{"scene.json", R"({"schema": "arthroscene.scene/1", "backdrop": {"radius": 0.05,
                            "panorama": "p.png"}})"},
            {"p.png", "no picture"}}}) {
    WriteZip(archive, entries);
    const auto all = faults();
    ASSERT_FALSE(all.empty());
    for (const std::string& fault : all) {
      EXPECT_TRUE(fault.starts_with(archive.string() + ": ")) << fault;
      EXPECT_NE(fault.find(fault.find("picture") == fault.npos ? "scene.json: " : "p.png: "),
                std::string::npos)
          << fault;
      EXPECT_EQ(fault.find("/arthroscene-"), std::string::npos) << fault;
    }
  }
}

TEST(ArchiveIo, AnArchiveThatWouldFillTheDiskIsRefusedBeforeItDoes) {
  test::TempFolder folder;
  WriteZip(folder / "b.arthro", {{"scene.json", "{}"}, {"zeros", std::string(5 << 20, '\0')}});
  EXPECT_LT(fs::file_size(folder / "b.arthro"), 20000u);
  EXPECT_NE(FaultOfUnpacking(folder / "b.arthro", {4 << 20, 100}).find("more than 4 MB"),
            std::string::npos);
  EXPECT_EQ(FaultOfUnpacking(folder / "b.arthro", {6 << 20, 100}), "");
  EXPECT_NE(FaultOfUnpacking(folder / "b.arthro", {6 << 20, 1}).find("1 files"), std::string::npos);
  // Nor one that is large only for its own size.
  EXPECT_NE(FaultOfUnpacking(folder / "b.arthro", {6 << 20, 100, 4 << 20, 64}).find("4 MB"),
            std::string::npos);
  EXPECT_EQ(FaultOfUnpacking(folder / "b.arthro", {6 << 20, 100, 4 << 20, 2000}), "");
}

TEST(ArchiveIo, RefusesWhatIsNoArchiveOrHasNoScene) {
  test::TempFolder folder;
  WriteAtomically(folder / "text.arthro", "this is a letter");
  WriteAtomically(folder / "empty.arthro", "");
  WriteZip(folder / "folder.arthro", {{"my scene/scene.json", "{}"}});
  WriteZip(folder / "clash.arthro", {{"scene.json", "{}"}, {"a", "1"}, {"a/b", "2"}});
  EXPECT_NE(FaultOfUnpacking(folder / "text.arthro").find("not a scene archive"),
            std::string::npos);
  EXPECT_NE(FaultOfUnpacking(folder / "empty.arthro"), "");
  EXPECT_NE(FaultOfUnpacking(folder / "none.arthro").find("no such archive"), std::string::npos);
  EXPECT_NE(FaultOfUnpacking(folder / "folder.arthro").find("at the top"), std::string::npos);
  EXPECT_NE(FaultOfUnpacking(folder / "clash.arthro").find("damaged"), std::string::npos);
}

TEST(ArchiveIo, SurvivesEveryCutAndManyChangedBytes) {
  test::TempFolder folder;
  fs::create_directory(folder / "scene");
  WriteSmallScene(folder / "scene");
  PackScene(folder / "scene", folder / "s.arthro");
  const std::string whole = ReadWholeFile(folder / "s.arthro");
  for (std::size_t at = 0; at < whole.size(); at += 13) {
    WriteAtomically(folder / "cut.arthro", whole.substr(0, at));
    EXPECT_NE(FaultOfUnpacking(folder / "cut.arthro"), "") << at;
    std::string changed = whole;
    changed[at] = static_cast<char>(changed[at] ^ 0x41);
    WriteAtomically(folder / "changed.arthro", changed);
    FaultOfUnpacking(folder / "changed.arthro");  // read or refused, never a crash
  }
}

TEST(ArchiveIo, AnIncompleteSceneIsNotPackedAndTheOldArchiveStays) {
  test::TempFolder folder;
  fs::create_directory(folder / "scene");
  WriteSmallScene(folder / "scene");
  fs::remove(folder / "scene/d.tiff");
  WriteAtomically(folder / "s.arthro", "old");
  EXPECT_THROW(PackScene(folder / "scene", folder / "s.arthro"), Error);
  EXPECT_EQ(ReadWholeFile(folder / "s.arthro"), "old");
}

std::string FaultOfPacking(const fs::path& scene, const fs::path& archive) {
  try {
    PackScene(scene, archive);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(ArchiveIo, ALinkOutOfTheScenesFolderIsNotFollowed) {
  test::TempFolder folder;
  fs::create_directory(folder / "scene");
  WriteSmallScene(folder / "scene");
  fs::rename(folder / "scene/m.ply", folder / "secret.ply");
  fs::create_symlink(folder / "secret.ply", folder / "scene/m.ply");
  EXPECT_NE(FaultOfPacking(folder / "scene", folder / "s.arthro").find("link to a file outside"),
            std::string::npos);
  EXPECT_FALSE(fs::exists(folder / "s.arthro"));
  // Nor one of a folder on the way.
  fs::remove(folder / "scene/m.ply");
  fs::rename(folder / "secret.ply", folder / "scene/m.ply");
  fs::rename(folder / "scene/pictures", folder / "elsewhere");
  fs::create_directory_symlink(folder / "elsewhere", folder / "scene/pictures");
  EXPECT_NE(FaultOfPacking(folder / "scene", folder / "s.arthro").find("link to a file outside"),
            std::string::npos);
  // A link that stays inside is a file like any other.
  fs::remove(folder / "scene/pictures");
  fs::rename(folder / "elsewhere", folder / "scene/pictures");
  fs::rename(folder / "scene/m.ply", folder / "scene/real.ply");
  fs::create_symlink("real.ply", folder / "scene/m.ply");
  EXPECT_EQ(FaultOfPacking(folder / "scene", folder / "s.arthro"), "");
}

TEST(ArchiveIo, AFileThatIsNotWhatTheSceneTakesItForIsNotPacked) {
  test::TempFolder folder;
  fs::create_directory(folder / "scene");
  WriteSmallScene(folder / "scene");
  Scene scene = ReadScene(folder / "scene");
  scene.tissues[0].mesh = "m.vtu";
  WriteScene(folder / "scene/scene.json", scene);
  WriteAtomically(folder / "scene/m.vtu", "-----BEGIN OPENSSH PRIVATE KEY-----");
  EXPECT_NE(FaultOfPacking(folder / "scene", folder / "s.arthro").find("m.vtu"), std::string::npos);
  EXPECT_FALSE(fs::exists(folder / "s.arthro"));
}

}  // namespace
}  // namespace arthro
