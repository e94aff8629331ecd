#include "simulation/scene/image_io.h"

#include <cmath>
#include <fstream>
#include <limits>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"
#include "tests/support/temp_folder.h"

namespace arthro {
namespace {

ColourImage Gradient(int width, int height) {
  ColourImage image(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      image.at(x, y)[0] = static_cast<std::uint8_t>(x);
      image.at(x, y)[1] = static_cast<std::uint8_t>(y);
      image.at(x, y)[2] = 200;
    }
  return image;
}

std::string FaultOfReading(const std::filesystem::path& file) {
  try {
    ReadColourImage(file);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(ImageIo, PngKeepsEveryByteAndTheOrderOfColours) {
  test::TempFolder folder;
  const ColourImage image = Gradient(40, 30);
  WriteColourImage(folder / "a.png", image);
  EXPECT_EQ(ReadColourImage(folder / "a.png").rgb, image.rgb);
}

TEST(ImageIo, DepthKeepsFloatsAndNaN) {
  test::TempFolder folder;
  DepthMap depth(7, 5, 0.0123456f);
  depth.at(3, 2) = std::numeric_limits<float>::quiet_NaN();
  WriteDepthMap(folder / "d.tiff", depth);
  const DepthMap back = ReadDepthMap(folder / "d.tiff");
  ASSERT_EQ(back.width, 7);
  ASSERT_EQ(back.height, 5);
  EXPECT_EQ(back.at(0, 0), 0.0123456f);
  EXPECT_TRUE(std::isnan(back.at(3, 2)));
}

TEST(ImageIo, OriginsKeepTheirNumbers) {
  test::TempFolder folder;
  OriginMap origins(7, 5, ReliefOrigin::kMeasured);
  origins.at(3, 2) = ReliefOrigin::kInterpolated;
  origins.at(4, 2) = ReliefOrigin::kBrightness;
  origins.at(6, 4) = ReliefOrigin::kNone;
  WriteOriginMap(folder / "o.png", origins);
  const OriginMap back = ReadOriginMap(folder / "o.png");
  EXPECT_EQ(back.width, 7);
  EXPECT_EQ(back.height, 5);
  EXPECT_EQ(back.origin, origins.origin);
  EXPECT_THROW(WriteOriginMap(folder / "o.jpg", origins), Error);
  EXPECT_THROW(WriteOriginMap(folder / "o.png", {}), Error);
}

TEST(ImageIo, RefusesMissingEmptyTruncatedAndForeignFiles) {
  test::TempFolder folder;
  EXPECT_NE(FaultOfReading(folder / "none.png").find("could not be opened"), std::string::npos);
  WriteAtomically(folder / "empty.png", "");
  EXPECT_NE(FaultOfReading(folder / "empty.png").find("empty"), std::string::npos);
  WriteAtomically(folder / "text.png", "this is a letter");
  EXPECT_NE(FaultOfReading(folder / "text.png").find("not a picture"), std::string::npos);
  for (const char* name : {"a.png", "a.jpg"}) {
    WriteColourImage(folder / name, Gradient(64, 64));
    std::string bytes = ReadWholeFile(folder / name);
    bytes.resize(bytes.size() / 2);
    WriteAtomically(folder / name, bytes);
    EXPECT_NE(FaultOfReading(folder / name).find("cut off"), std::string::npos) << name;
  }
  EXPECT_NE(FaultOfReading(folder.path()).find("folder"), std::string::npos);
}

TEST(ImageIo, RefusesAnEightBitDepthMapAndSizesThatDiffer) {
  test::TempFolder folder;
  WriteColourImage(folder / "d.tiff", Gradient(8, 8));
  EXPECT_THROW(ReadDepthMap(folder / "d.tiff"), Error);
  EXPECT_THROW(RequireSameSize(Gradient(8, 8), DepthMap(8, 9), "d.tiff"), Error);
  EXPECT_THROW(WriteColourImage(folder / "a.xyz", Gradient(4, 4)), Error);
}

// A TIFF of one pixel, little-endian: header, the pixel at 8, the directory at 16.
std::string OnePixelTiff(std::uint16_t bits, std::uint16_t format) {
  std::string bytes("II*\0\x10\0\0\0", 8);
  bytes.resize(16);
  const auto put = [&](std::uint32_t value, int size) {
    for (int i = 0; i < size; ++i) bytes += static_cast<char>(value >> 8 * i & 0xff);
  };
  const std::vector<std::pair<int, std::uint32_t>> fields = {
      {256, 1}, {257, 1}, {258, bits}, {259, 1},         {262, 1},
      {273, 8}, {277, 1}, {278, 1},    {279, bits / 8u}, {339, format}};
  put(static_cast<std::uint32_t>(fields.size()), 2);
  for (const auto& [tag, value] : fields) {
    put(static_cast<std::uint32_t>(tag), 2);
    put(4, 2);  // LONG
    put(1, 4);
    put(value, 4);
  }
  put(0, 4);
  return bytes;
}

// Depth maps as other programs write them: the library's own words do not come before ours.
TEST(ImageIo, NumbersOfATiffThatAreNotTakenAreSaid) {
  test::TempFolder folder;
  const auto told = [&](int bits, int format) {
    std::ofstream(folder / "d.tiff", std::ios::binary)
        << OnePixelTiff(static_cast<std::uint16_t>(bits), static_cast<std::uint16_t>(format));
    testing::internal::CaptureStderr();
    std::string sentence;
    try {
      ReadDepthMap(folder / "d.tiff");
    } catch (const Error& error) {
      sentence = error.sentence();
    }
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
    return sentence;
  };
  EXPECT_EQ(told(32, 3), "");  // float: read
  EXPECT_NE(told(32, 1).find("whole numbers of 32 bits"), std::string::npos) << told(32, 1);
  EXPECT_NE(told(64, 3).find("floats of 64 bits"), std::string::npos) << told(64, 3);
  EXPECT_NE(told(16, 1).find("32-bit float TIFF in metres"), std::string::npos) << told(16, 1);
}

}  // namespace
}  // namespace arthro
