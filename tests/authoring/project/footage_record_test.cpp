// The record of how a panorama was made stays with its scene, and not with copies of it.
#include "authoring/project/footage_record.h"

#include <fstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "authoring/project/document_io.h"
#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"
#include "simulation/scene/files/archive_io.h"
#include "tests/support/build_paths.h"
#include "tests/support/small_scene.h"
#include "tests/support/temp_folder.h"

namespace arthro::authoring {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPatient = "Mustermann_Erika";

FootageRecord RecordOf(const fs::path& clip) {
  FootageRecord record;
  ClipFile& file = record.clips.emplace_back();
  file.name = clip.filename().string();
  file.file = fs::absolute(clip).string();
  file.fingerprint = ClipFingerprint(clip);
  file.frames = 2;
  file.rights.licence = "CC BY 4.0";
  record.left_out = {1};
  record.masked = {{4, 5, 60, 20}};
  FrameTie& tie = record.ties.emplace_back();
  tie.frame = 1;
  tie.pixel = {10.25, 20};
  tie.other = TieInFrame{0, {30, 40.5}};
  record.report =
      nlohmann::ordered_json{
          {"schema", "arthroscene.panorama/1"},
          {"footage", clip.string()},
          {"warnings", nlohmann::ordered_json::array(
                           {clip.filename().string() + ": none of its frames is in the panorama"})},
          {"clips", nlohmann::ordered_json::array({{{"file", clip.string()}}})},
          {"frames", nlohmann::ordered_json::array(
                         {{{"index", 0}, {"source", clip.filename().string() + "#0"}}})}}
          .dump(1) +
      "\n";
  return record;
}

// A new document with a record of a clip beside its folder.
Document NewDocument(const test::TempFolder& folder) {
  const fs::path clip = folder / (std::string(kPatient) + ".mp4");
  WriteAtomically(clip, "not decoded here");
  WriteColourImage(folder / "panorama.png", test::KneePicture(96, 64));
  Document document = OpenDocument(folder / "panorama.png");
  document.footage = Share(RecordOf(clip));
  document.scene.backdrop.footage = "footage.json";
  return document;
}

TEST(FootageRecord, IsPartOfTheSceneAsItWas) {
  const test::TempFolder folder;
  const Document document = NewDocument(folder);
  SaveDocument(document, folder / "scene");
  const Document back = OpenDocument(folder / "scene");
  ASSERT_TRUE(back.footage);
  FootageRecord expected = *document.footage;
  expected.clips[0].beside = back.footage->clips[0].beside;
  EXPECT_EQ(*back.footage, expected);
  EXPECT_EQ(back.footage->clips[0].beside, "../" + std::string(kPatient) + ".mp4");
  // Saved again without a change, the file is the same one.
  const std::string bytes = ReadWholeFile(folder / "scene/footage.json");
  const Document again = SaveDocument(back, folder / "scene");
  EXPECT_EQ(again.scene.backdrop.footage, "footage.json");
  EXPECT_EQ(ReadWholeFile(folder / "scene/footage.json"), bytes);
}

TEST(FootageRecord, AClipThatMovedWithItsSceneIsFound) {
  const test::TempFolder folder;
  fs::create_directory(folder / "old");
  const test::TempFolder inside;
  const Document document = NewDocument(inside);
  SaveDocument(document, inside / "scene");
  fs::copy(inside.path(), folder / "moved", fs::copy_options::recursive);
  const std::string clip = document.footage->clips[0].file;
  fs::remove(clip);
  const Document back = OpenDocument(folder / "moved/scene");
  EXPECT_EQ(FindClip(back.footage->clips[0], back.folder),
            (folder / "moved" / fs::path(clip).filename()).lexically_normal());
  fs::remove(folder / "moved" / fs::path(clip).filename());
  EXPECT_EQ(FindClip(back.footage->clips[0], back.folder), fs::path());
  EXPECT_NE(WordsOfMissingClip(back.footage->clips[0]).find("is no longer at"), std::string::npos);
}

TEST(FootageRecord, ACopyThatIsHandedOnNamesNoClip) {
  const test::TempFolder folder;
  const Document document = NewDocument(folder);
  const Document saved = SaveDocument(document, folder / "scene");
  SaveDocument(saved, folder / "copy");
  SaveDocument(document, folder / "scene.arthro");
  const test::TempFolder unpacked;
  UnpackScene(folder / "scene.arthro", unpacked.path());
  for (const fs::path& place : {folder / "copy", unpacked.path()}) {
    for (const auto& entry : fs::recursive_directory_iterator(place))
      if (entry.is_regular_file()) {
        EXPECT_EQ(ReadWholeFile(entry.path()).find(kPatient), std::string::npos) << entry.path();
      }
    const Document back = OpenDocument(place);
    ASSERT_TRUE(back.footage);
    EXPECT_EQ(back.footage->clips[0].fingerprint, document.footage->clips[0].fingerprint);
    EXPECT_EQ(back.footage->clips[0].rights.licence, "CC BY 4.0");
    EXPECT_EQ(back.footage->ties, document.footage->ties);
    EXPECT_NE(WordsOfMissingClip(back.footage->clips[0]).find("handed on"), std::string::npos);
  }
}

// A report that another program wrote, or that was edited by hand, threw at the hand-over.
TEST(FootageRecord, ANameWhereAReportHasNoneIsNotHandedOnEither) {
  const std::string name = std::string(kPatient) + ".mp4";
  FootageRecord record;
  record.clips.emplace_back().name = name;
  record.clips[0].fingerprint = "1";
  for (const auto& report : {
           nlohmann::ordered_json{{"warnings", {7, {{"of", name}}}}, {"clips", {name}}},
           nlohmann::ordered_json{{"warnings", name}, {"clips", name}, {"frames", name}},
           nlohmann::ordered_json{{"frames", {name, {{"source", name}}}}},
       }) {
    record.report = report.dump();
    const std::string text = JsonFromFootage(WithoutNames(record));
    EXPECT_EQ(text.find(kPatient), std::string::npos) << text;
    EXPECT_NO_THROW(FootageFromJson(text));
  }
}

TEST(FootageRecord, ABrokenRecordIsOneSentence) {
  const test::TempFolder folder;
  SaveDocument(NewDocument(folder), folder / "scene");
  for (const char* text : {"{", "[]", R"({"schema": "arthroscene.footage/2", "clips": []})",
                           R"({"schema": "arthroscene.footage/1"})",
                           R"({"schema": "arthroscene.footage/1", "clips": [], "report": 3})"}) {
    WriteAtomically(folder / "scene/footage.json", text);
    try {
      OpenDocument(folder / "scene");
      ADD_FAILURE() << text;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), Code::kBadData) << text;
      EXPECT_NE(std::string(error.what()).find("footage.json"), std::string::npos);
    }
  }
}

// A sparse file of 3 GB takes no room; its fingerprint takes neither its memory nor its time.
TEST(FootageRecord, LargeVideoIsToldByItsSizeItsBeginningAndItsEnd) {
  const test::TempFolder folder;
  const fs::path file = folder / "long.mp4";
  constexpr std::uintmax_t kSize = std::uintmax_t{3} << 30;
  const auto put = [&](std::uintmax_t at, char byte) {
    std::fstream stream(file, std::ios::binary | std::ios::in | std::ios::out);
    stream.seekp(static_cast<std::streamoff>(at));
    stream.put(byte);
  };
  WriteAtomically(file, "video");
  fs::resize_file(file, kSize);
  const std::string first = ClipFingerprint(file);
  EXPECT_EQ(ClipFingerprint(file), first);
  put(kSize - 1, 'x');
  const std::string other_end = ClipFingerprint(file);
  EXPECT_NE(other_end, first);
  put(0, 'x');
  EXPECT_NE(ClipFingerprint(file), other_end);
  put(0, 'v');
  put(kSize - 1, '\0');
  EXPECT_EQ(ClipFingerprint(file), first);
  fs::resize_file(file, kSize + 1);
  EXPECT_NE(ClipFingerprint(file), first);
}

TEST(FootageRecord, SchemaThatIsShippedIsTheOneThatTheProgramPrints) {
  const fs::path copy = fs::path(ARTHRO_SOURCE_DIR) / "resources/schemas/footage-1.schema.json";
  EXPECT_EQ(ReadWholeFile(copy), FootageSchemaText())
      << "run: build/release/bin/arthroscene check --footage-schema > "
         "resources/schemas/footage-1.schema.json";
}

}  // namespace
}  // namespace arthro::authoring
