// Pictures, videos, JSON and names of files that once crashed the program, made it hang or took all
// memory: each is refused (refusal.h). Volumes, cases and archives: fault_inputs_test.cpp.
#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "simulation/core/atomic_file.h"
#include "simulation/scene/image_io.h"
#include "tests/hostile/refusal.h"
#include "tests/support/temp_folder.h"
#include "tests/support/wavy_picture.h"

namespace arthro {
namespace {

namespace fs = std::filesystem;
using test::RefusalOf;
using test::TempFolder;
using test::WavyPicture;
using Words = std::vector<std::string>;

std::string Nested(int depth) {
  return std::string(static_cast<std::size_t>(depth), '[') +
         std::string(static_cast<std::size_t>(depth), ']');
}

constexpr int kDeep = 200'000;

TEST(FileFaults, DeeplyNestedJsonIsRefusedByEveryReader) {
  TempFolder folder;
  const auto at = [&](const char* name) { return (folder / name).string(); };
  WriteAtomically(folder / "scene.json",
                  R"({"schema": "arthroscene.scene/1", "x-a": )" + Nested(kDeep) + "}");
  WriteAtomically(folder / "deep.json", Nested(kDeep));
  WriteAtomically(folder / "keys.json",
                  R"({"schema": "arthroscene.lens/1", "x-a": )" + Nested(kDeep) + "}");
  WriteColourImage(folder / "p.png", WavyPicture(64, 48));
  const std::string deep = at("deep.json");
  for (const Words& job :
       {Words{"centres", folder.path().string(), "--view-angle-deg", "30", "--insertion-mm", "5",
              "-o", at("c.csv")},
        Words{"view", folder.path().string(), "-o", at("v.png")},
        Words{"solve", deep, "-o", at("r.json")},
        Words{"depth", at("p.png"), "--options", deep, "-o", at("d.tiff")},
        Words{"panorama", at("p.png"), "--lens", at("keys.json"), "-o", at("o.png")},
        Words{"practise", folder.path().string(), "--rig", deep}}) {
    const std::string said = RefusalOf(job);
    EXPECT_NE(said.find("nested"), said.npos) << said;
  }
}

// A head of 60000 x 60000 pixels before the data of a small one.
TEST(FileFaults, PicturesTooLargeAreRefusedBeforeTheyAreDecoded) {
  TempFolder folder;
  const auto big = [](std::uint32_t number) {
    std::string bytes;
    for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(number >> shift & 0xff);
    return bytes;
  };
  WriteColourImage(folder / "p.png", WavyPicture(64, 48));
  std::string bytes = ReadWholeFile(folder / "p.png");
  bytes.replace(16, 8, big(60000) + big(60000));  // behind the signature, IHDR's width and height
  bytes.replace(29, 4, big(0x0fb0e215));          // the checksum of that head
  WriteAtomically(folder / "p.png", bytes);
  const std::string said =
      RefusalOf({"depth", (folder / "p.png").string(), "-o", (folder / "d.tiff").string()});
  EXPECT_NE(said.find("60000 x 60000"), said.npos) << said;
}

TEST(FileFaults, DamagedPicturesAreRefusedAndNeverHalfGrey) {
  TempFolder folder;
  for (const char* const ending : {"png", "jpg", "tiff", "bmp", "webp", "ppm"}) {
    const fs::path file = folder / (std::string("a.") + ending);
    WriteColourImage(file, WavyPicture(160, 120));
    std::string bytes = ReadWholeFile(file);
    if (std::string(ending) == "bmp" || std::string(ending) == "ppm")
      bytes.resize(bytes.size() / 2);  // no more than a cut can be seen in bare pixels
    else
      for (std::size_t i = bytes.size() / 2; i < bytes.size() / 2 + 40; ++i)
        bytes[i] = i % 2 ? '\0' : '\xff';  // no code of JPEG's either
    WriteAtomically(file, bytes);
    const std::string said =
        RefusalOf({"depth", file.string(), "-o", (folder / "d.tiff").string()});
    EXPECT_TRUE(said.find("damaged inside") != said.npos || said.find("cut off") != said.npos)
        << said;
    EXPECT_FALSE(fs::exists(folder / "d.tiff"));
  }
}

TEST(FileFaults, NamesAndTextOfFilesNeverReachTheTerminalRaw) {
  TempFolder folder;
  const std::string esc = "\x1b]0;title\x07\n\x1b[2J";
  WriteAtomically(folder / ("a" + esc + ".png"), "no picture");
  RefusalOf(
      {"depth", (folder / ("a" + esc + ".png")).string(), "-o", (folder / "d.tiff").string()});
  WriteAtomically(folder / "rig.json",
                  R"({"schema": ")" + std::string(4 << 20, 'x') + R"(", "title": "\u001b[2J"})");
  RefusalOf({"practise", folder.path().string(), "--rig", (folder / "rig.json").string()});
  WriteAtomically(folder / "case.json", R"({"mode": "\u001b[2J\n\n", "mesh": "\u009b2J"})");
  RefusalOf({"solve", (folder / "case.json").string(), "-o", (folder / "r.json").string()});
}

TEST(FileFaults, VideosThatAreNoneAreRefusedInOurWords) {
  TempFolder folder;
  // Heads of AVI, which OpenCV's own reader would talk about.
  for (const std::string& bytes : {std::string("RIFF\x20\0\0\0AVI LIXT\x10\0\0\0hdrlavih", 28),
                                   std::string("RIFF\xff\xff\0\0AVI ", 12),
                                   std::string("this is a letter"), std::string(4096, '\0')}) {
    WriteAtomically(folder / "v.avi", bytes);
    RefusalOf({"panorama", (folder / "v.avi").string(), "-o", (folder / "o.png").string()});
  }
}

}  // namespace
}  // namespace arthro
