#include "simulation/scene/backdrop/clean_picture.h"

#include <random>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "tests/support/marked_picture.h"

namespace arthro {
namespace {

std::string Encoded(const char* extension, const std::vector<int>& parameters = {}) {
  cv::Mat bgr(48, 64, CV_8UC3);
  cv::RNG random(1);
  random.fill(bgr, cv::RNG::UNIFORM, 0, 255);
  std::vector<unsigned char> bytes;
  cv::imencode(extension, bgr, bytes, parameters);
  return {bytes.begin(), bytes.end()};
}

bool HasSamePixels(const std::string& a, const std::string& b) {
  const auto decode = [](const std::string& bytes) {
    return cv::imdecode(std::vector<unsigned char>(bytes.begin(), bytes.end()), cv::IMREAD_COLOR);
  };
  const cv::Mat one = decode(a), other = decode(b);
  return !one.empty() && one.size() == other.size() && cv::norm(one, other, cv::NORM_INF) == 0;
}

TEST(CleanPicture, KeepsTheCompressedPixelsOfAPngAndDropsAllElse) {
  const std::string png = Encoded(".png");
  const auto clean = PictureWithoutMetadata(test::MarkedPng(png));
  ASSERT_TRUE(clean);
  EXPECT_EQ(clean->find(test::kPatient), clean->npos);
  EXPECT_TRUE(HasSamePixels(*clean, png));
  EXPECT_EQ(PictureWithoutMetadata(*clean), clean) << "cleaning twice changes nothing";
}

TEST(CleanPicture, KeepsTheCompressedPixelsOfAJpegAndDropsAllElse) {
  for (const std::vector<int>& parameters : {std::vector<int>{},
                                             {cv::IMWRITE_JPEG_PROGRESSIVE, 1},
                                             {cv::IMWRITE_JPEG_RST_INTERVAL, 3}}) {
    const std::string jpeg = Encoded(".jpg", parameters);
    const auto clean = PictureWithoutMetadata(test::MarkedJpeg(jpeg));
    ASSERT_TRUE(clean);
    EXPECT_EQ(*clean, jpeg) << "a file of nothing but pixels stays byte for byte";
  }
}

// An Adobe segment says that the three colours are red, green and blue, not luma and chroma.
TEST(CleanPicture, KeepsTheSegmentThatSaysHowColoursAreCoded) {
  const std::string jpeg = Encoded(".jpg");
  const std::string adobe =
      test::JpegSegment('\xee', std::string("Adobe\0\x64\0\0\0\0\0", 12) + test::kPatient);
  const std::size_t behind_jfif = 2 + 18;
  const std::string marked = jpeg.substr(0, 2) + adobe + jpeg.substr(behind_jfif);
  const auto clean = PictureWithoutMetadata(marked);
  ASSERT_TRUE(clean);
  EXPECT_EQ(clean->find(test::kPatient), clean->npos);
  EXPECT_TRUE(HasSamePixels(*clean, marked));
  EXPECT_FALSE(HasSamePixels(*clean, jpeg)) << "the segment matters";
}

TEST(CleanPicture, DropsTheThumbnailOfAJfifHeader) {
  const std::string jpeg = Encoded(".jpg");
  const std::string thumbnail = std::string(2 * 2 * 3, 'P');
  const std::string header = jpeg.substr(6, 12) + std::string("\2\2") + thumbnail;
  const auto clean = PictureWithoutMetadata(jpeg.substr(0, 2) + test::JpegSegment('\xe0', header) +
                                            jpeg.substr(2 + 18));
  EXPECT_EQ(clean, jpeg);
}

TEST(CleanPicture, AnswersNothingForOtherFormatsAndCutFiles) {
  EXPECT_FALSE(PictureWithoutMetadata(""));
  EXPECT_FALSE(PictureWithoutMetadata("a letter"));
  EXPECT_FALSE(PictureWithoutMetadata(Encoded(".tiff")));
  EXPECT_FALSE(PictureWithoutMetadata(Encoded(".bmp")));
  for (const std::string& whole : {Encoded(".png"), Encoded(".jpg")})
    for (std::size_t size = 0; size < whole.size(); size += 7)
      EXPECT_FALSE(PictureWithoutMetadata(std::string_view(whole).substr(0, size))) << size;
}

TEST(CleanPicture, TakesAnyBytes) {
  std::mt19937 random(17);
  for (const std::string& whole :
       {test::MarkedPng(Encoded(".png")), test::MarkedJpeg(Encoded(".jpg"))})
    for (int i = 0; i < 2000; ++i) {
      std::string bytes = whole;
      for (int k = 0; k < 4; ++k)
        bytes[8 + random() % (k < 2 ? 600 : bytes.size() - 8)] = static_cast<char>(random());
      const auto clean = PictureWithoutMetadata(bytes);
      EXPECT_LE(clean.value_or("").size(), bytes.size());
    }
}

}  // namespace
}  // namespace arthro
