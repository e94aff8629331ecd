// Our decoders against OpenCV's, which read the same pictures before, and damaged ones.
#include "simulation/scene/formats/picture_formats.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <random>
#include <string>
#include <vector>
#include <zlib.h>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"
#include "simulation/scene/image_io.h"
#include "tests/support/temp_folder.h"

namespace arthro {
namespace {

// A picture of any OpenCV type, smooth enough for JPEG.
cv::Mat Picture(int type, int width = 61, int height = 43) {
  cv::Mat mat(height, width, type);
  const double white = CV_MAT_DEPTH(type) == CV_16U ? 65535 : 255;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < mat.channels(); ++c) {
        const double value = white * (0.5 + 0.45 * std::sin(0.11 * x + 0.07 * y + c));
        if (mat.depth() == CV_16U)
          mat.ptr<std::uint16_t>(y)[x * mat.channels() + c] = static_cast<std::uint16_t>(value);
        else
          mat.ptr<std::uint8_t>(y)[x * mat.channels() + c] = static_cast<std::uint8_t>(value);
      }
  return mat;
}

std::string Encoded(const char* extension, const cv::Mat& mat,
                    const std::vector<int>& parameters = {}) {
  std::vector<unsigned char> bytes;
  EXPECT_TRUE(cv::imencode(extension, mat, bytes, parameters)) << extension;
  return {bytes.begin(), bytes.end()};
}

std::string FaultOf(const std::string& bytes, ColourImage* image = nullptr) {
  test::TempFolder folder;
  std::ofstream(folder / "a.picture", std::ios::binary) << bytes;  // not flushed, so faster
  testing::internal::CaptureStderr();
  std::string sentence;
  try {
    const ColourImage read = ReadColourImage(folder / "a.picture");
    if (image) *image = read;
  } catch (const Error& error) {
    sentence = error.sentence();
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  return sentence;
}

// Greatest difference in any channel; 999 where the sizes differ.
int DifferenceFromOpenCv(const std::string& bytes) {
  ColourImage ours;
  EXPECT_EQ(FaultOf(bytes, &ours), "");
  const cv::Mat theirs =
      cv::imdecode(std::vector<unsigned char>(bytes.begin(), bytes.end()), cv::IMREAD_COLOR);
  if (ours.width != theirs.cols || ours.height != theirs.rows) return 999;
  int most = 0;
  for (int y = 0; y < ours.height; ++y)
    for (int x = 0; x < ours.width; ++x)
      for (int c = 0; c < 3; ++c)
        most = std::max(most, std::abs(ours.at(x, y)[c] - theirs.at<cv::Vec3b>(y, x)[2 - c]));
  return most;
}

TEST(PictureFormats, EveryKindIsReadAsOpenCvReadsIt) {
  for (const int type : {CV_8UC1, CV_8UC3, CV_8UC4, CV_16UC1, CV_16UC3, CV_16UC4})
    EXPECT_EQ(DifferenceFromOpenCv(Encoded(".png", Picture(type))), 0) << "PNG " << type;
  EXPECT_EQ(DifferenceFromOpenCv(Encoded(".png", Picture(CV_8UC1), {cv::IMWRITE_PNG_BILEVEL, 1})),
            0);
  for (const int type : {CV_8UC1, CV_8UC3})
    for (const int progressive : {0, 1})
      EXPECT_EQ(DifferenceFromOpenCv(
                    Encoded(".jpg", Picture(type), {cv::IMWRITE_JPEG_PROGRESSIVE, progressive})),
                0)
          << "JPEG " << type;
  for (const int type : {CV_8UC1, CV_8UC3})
    EXPECT_EQ(DifferenceFromOpenCv(Encoded(".tiff", Picture(type))), 0) << "TIFF " << type;
  // 16 bits to 8: libtiff rounds, OpenCV cuts.
  for (const int type : {CV_16UC1, CV_16UC3})
    EXPECT_LE(DifferenceFromOpenCv(Encoded(".tiff", Picture(type))), 1) << "TIFF " << type;
  for (const char* const extension : {".bmp", ".webp", ".ppm"})
    EXPECT_EQ(DifferenceFromOpenCv(Encoded(extension, Picture(CV_8UC3))), 0) << extension;
}

// EXIF with an orientation alone, as a camera held upright writes it.
TEST(PictureFormats, OrientationOfAJpegIsAppliedAsOpenCvDoes) {
  const std::string jpeg = Encoded(".jpg", Picture(CV_8UC3));
  for (int orientation = 0; orientation <= 9; ++orientation) {
    std::string exif("Exif\0\0MM\0*\0\0\0\x08\0\x01\x01\x12\0\x03\0\0\0\x01\0", 25);
    exif += static_cast<char>(orientation);
    exif += std::string("\0\0\0\0\0\0", 6);
    std::string marker = "\xff\xe1";
    marker += '\0';
    marker += static_cast<char>(exif.size() + 2);
    EXPECT_EQ(DifferenceFromOpenCv(jpeg.substr(0, 2) + marker + exif + jpeg.substr(2)), 0)
        << orientation;
  }
}

TEST(PictureFormats, BytesThatAreNoneOfTheFormatsAreRefusedByTheirMagic) {
  for (const std::string& bytes :
       {std::string("GIF89a"), std::string("v/1\1exr"), std::string("#?RADIANCE\n"),
        std::string("\0\0\0\fjP  \r\n\x87\n", 12), std::string("letter")})
    EXPECT_NE(FaultOf(bytes).find("not a picture"), std::string::npos) << bytes;
}

// Its checksums put right again, as a hostile hand would.
std::string WithChecksums(std::string png) {
  for (std::size_t at = 8; at + 12 <= png.size();) {
    std::size_t size = 0;
    for (std::size_t i = 0; i < 4; ++i) size = size << 8 | (png[at + i] & 0xffu);
    if (size > png.size() - at - 12) break;
    const auto sum =
        crc32(0, reinterpret_cast<const Bytef*>(&png[at + 4]), static_cast<uInt>(size + 4));
    for (std::size_t i = 0; i < 4; ++i)
      png[at + 8 + size + i] = static_cast<char>(sum >> (24 - 8 * i) & 0xff);
    at += size + 12;
  }
  return png;
}

TEST(PictureFormats, DamagedPngIsRefusedEvenWhereItsChecksumsFit) {
  const std::string whole = Encoded(".png", Picture(CV_8UC3));
  const std::size_t data = whole.find("IDAT") + 4;
  for (std::size_t at = data; at + 16 < whole.size(); at += 29) {
    std::string bytes = whole;
    bytes[at] = static_cast<char>(bytes[at] ^ 0x5a);
    EXPECT_NE(FaultOf(bytes).find("damaged inside"), std::string::npos) << at;
    EXPECT_NE(FaultOf(WithChecksums(bytes)), "") << at;  // zlib's own checksum is left
  }
}

TEST(PictureFormats, DamageInAJpegThatItsDecoderSeesIsRefused) {
  std::string bytes = Encoded(".jpg", Picture(CV_8UC3, 200, 150));
  const std::size_t middle = bytes.size() / 2;
  std::string cut = bytes.substr(0, middle) + "\xff\xd9";  // an end mark behind half of the rows
  EXPECT_NE(FaultOf(cut).find("damaged inside"), std::string::npos) << FaultOf(cut);
  for (std::size_t i = 0; i < 60; ++i) bytes[middle + i] = i % 2 ? '\0' : '\xff';  // no code
  EXPECT_NE(FaultOf(bytes).find("damaged inside"), std::string::npos) << FaultOf(bytes);
}

TEST(PictureFormats, AFewBytesBeforeTheEndMarkOfAJpegAreNoDamage) {
  std::string bytes = Encoded(".jpg", Picture(CV_8UC3));
  bytes.insert(bytes.size() - 2, "\x11\x22");
  EXPECT_EQ(FaultOf(bytes), "");
}

TEST(PictureFormats, AStripOfATiffThatCannotBeUnpackedIsADamagedPicture) {
  const std::string whole = Encoded(".tiff", Picture(CV_8UC3, 200, 150));  // packed by LZW
  std::string bytes = whole;
  for (std::size_t i = 0; i < 60; ++i) bytes[bytes.size() / 2 + i] = static_cast<char>(0xff);
  EXPECT_NE(FaultOf(bytes).find("damaged inside"), std::string::npos) << FaultOf(bytes);
  test::TempFolder folder;
  WriteDepthMap(folder / "d.tiff", DepthMap(300, 300, 0.01f));
  bytes = ReadWholeFile(folder / "d.tiff");
  for (std::size_t i = 20; i < 60; ++i) bytes[i] = static_cast<char>(0xff);
  WriteAtomically(folder / "d.tiff", bytes);
  EXPECT_THROW(ReadDepthMap(folder / "d.tiff"), Error);
}

// A little-endian TIFF's head: one strip of nothing.
std::string TiffOf(std::uint32_t width, std::uint32_t height, std::uint16_t samples) {
  std::string bytes("II*\0\x08\0\0\0", 8);
  const auto put = [&](std::uint32_t value, int size) {
    for (int i = 0; i < size; ++i) bytes += static_cast<char>(value >> 8 * i & 0xff);
  };
  const std::vector<std::pair<std::uint32_t, std::uint32_t>> fields = {
      {256, width}, {257, height},  {258, 32},     {259, 8}, {262, 1},
      {273, 8},     {277, samples}, {278, height}, {279, 4}, {339, 3}};
  put(static_cast<std::uint32_t>(fields.size()), 2);
  for (const auto& [tag, value] : fields) put(tag, 2), put(4, 2), put(1, 4), put(value, 4);
  put(0, 4);
  return bytes;
}

TEST(PictureFormats, HeadsBeyondTheLimitAreRefusedBeforeMemoryIsTaken) {
  test::TempFolder folder;
  const auto fault = [&](const std::string& bytes) -> std::string {
    WriteAtomically(folder / "d.tiff", bytes);
    try {
      ReadDepthMap(folder / "d.tiff");
    } catch (const Error& error) {
      return error.sentence();
    }
    return "";
  };
  EXPECT_NE(fault(TiffOf(30000, 30000, 1)).find("30000 x 30000"), std::string::npos);
  EXPECT_NE(fault(TiffOf(4000000000u, 4000000000u, 1)), "");
  EXPECT_NE(fault(TiffOf(100, 100, 4)).find("one-channel"), std::string::npos);
  EXPECT_NE(fault(TiffOf(0, 100, 1)), "");
  EXPECT_NE(FaultOf("P6 70000 70000 255\n").find("70000 x 70000"), std::string::npos);
  EXPECT_NE(FaultOf("P6 700 700 255\n").find("cut off"), std::string::npos);
  std::string bmp = Encoded(".bmp", Picture(CV_8UC3));
  bmp.replace(18, 8, std::string("\x60\xea\0\0\x60\xea\0\0", 8));
  EXPECT_NE(FaultOf(bmp).find("60000 x 60000"), std::string::npos);
}

// Pixels are bounded by the file: 16000 x 16000 of them take 0.8 GB, and flat ones pack into a few
// kB.
TEST(PictureFormats, ASmallFileIsNoLargePicture) {
  test::TempFolder folder;
  WriteAtomically(folder / "d.tiff", TiffOf(16000, 16000, 1));
  EXPECT_THROW(ReadDepthMap(folder / "d.tiff"), Error);
  std::string png = Encoded(".png", Picture(CV_8UC3));
  png.replace(16, 8, std::string("\0\0\x3e\x80\0\0\x3e\x80", 8));
  EXPECT_NE(FaultOf(WithChecksums(png)).find("16000 x 16000 pixels in a file of"),
            std::string::npos);
  // A comment that claims 650 MB. Only its refusal shows here; the corpus of tests/fuzz has its
  // cost.
  std::string comment = Encoded(".png", Picture(CV_8UC3));
  comment.insert(comment.size() - 12, std::string("\x27\0\0\x25tEXt", 8));
  EXPECT_EQ(FaultOf(comment), "this picture is damaged inside; copy or export it again");
  std::string webp = Encoded(".webp", Picture(CV_8UC3));
  ASSERT_EQ(webp.substr(12, 4), "VP8L") << "the losless form, as OpenCV writes it by default";
  webp.replace(21, 4, std::string("\xff\xff\xff\x0f", 4));
  EXPECT_NE(FaultOf(webp).find("16384 x 16384 pixels in a file of"), std::string::npos);
  EXPECT_EQ(FaultOf(Encoded(".png", cv::Mat(8192, 8192, CV_8UC1, 7))), "")
      << "as large as a small file may be";
}

TEST(PictureFormats, RandomDamageOfEveryFormatIsReadOrRefusedWithoutAWord) {
  std::mt19937 random(7);
  for (const char* const extension : {".png", ".jpg", ".tiff", ".bmp", ".webp", ".ppm"}) {
    const std::string whole = Encoded(extension, Picture(CV_8UC3));
    for (int i = 0; i < 60; ++i) {
      std::string bytes = whole;
      const std::size_t reach = i % 2 ? bytes.size() : std::min<std::size_t>(bytes.size(), 200);
      for (int n = 0; n < 1 + i % 4; ++n) bytes[random() % reach] = static_cast<char>(random());
      if (i % 5 == 0) bytes.resize(random() % bytes.size());
      FaultOf(bytes);
      if (extension == std::string(".png")) FaultOf(WithChecksums(bytes));
    }
  }
}

TEST(DepthMapFiles, DepthsBeyondAnyJointAreRefusedWithTheirPlace) {
  test::TempFolder folder;
  for (const float depth : {1e30f, std::numeric_limits<float>::infinity(), -30.0f}) {
    DepthMap map(8, 6, 0.01f);
    map.at(3, 2) = depth;
    map.at(4, 2) = std::numeric_limits<float>::quiet_NaN();  // nothing was imaged: no fault
    WriteDepthMap(folder / "d.tiff", map);
    std::string said;
    try {
      ReadDepthMap(folder / "d.tiff");
    } catch (const Error& error) {
      said = error.sentence();
    }
    EXPECT_NE(said.find("column 3, row 2"), std::string::npos) << depth << ": " << said;
  }
}

}  // namespace
}  // namespace arthro
