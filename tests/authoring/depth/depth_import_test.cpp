#include "authoring/depth/depth_import.h"

#include <cmath>
#include <fstream>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"
#include "tests/support/temp_folder.h"

namespace arthro::authoring {
namespace {

constexpr double kImportRadius = 0.05;  // m

std::string RefusalOf(const GreyNumbers& numbers, const DepthImportOptions& options) {
  try {
    ReliefFromNumbers(numbers, options, kImportRadius, 4, 2, "d.png");
  } catch (const Error& error) {
    return error.sentence();
  }
  return "";
}

TEST(DepthImport, ReadsSixteenBitsWithTheirRange) {
  const test::TempFolder folder;
  for (const char* name : {"d.png", "d.tiff"}) {
    cv::Mat map(2, 4, CV_16U, cv::Scalar(65535));
    map.at<std::uint16_t>(0, 1) = 0;
    map.at<std::uint16_t>(1, 2) = 13107;  // one fifth
    cv::imwrite((folder.path() / name).string(), map);
    DepthImportOptions options;
    options.low = 0.03;
    options.high = 0.05;
    const GreyNumbers numbers = ReadGreyNumbers(folder.path() / name);
    const DepthMap relief = ReliefFromNumbers(numbers, options, kImportRadius, 4, 2, name);
    EXPECT_NEAR(relief.at(0, 0), 0.0, 1e-8);
    EXPECT_TRUE(std::isnan(relief.at(1, 0)));
    EXPECT_NEAR(relief.at(2, 1), 0.05 - 0.034, 1e-8);
    options.is_zero_unknown = false;
    EXPECT_NEAR(ReliefFromNumbers(numbers, options, kImportRadius, 4, 2, name).at(1, 0), 0.02,
                1e-8);
    options.meaning = DepthMeaning::kRelief;
    options.low = 0;
    options.high = 0.01;
    EXPECT_NEAR(ReliefFromNumbers(numbers, options, kImportRadius, 4, 2, name).at(0, 0), 0.01,
                1e-8);
  }
}

TEST(DepthImport, ReadsFloatingPointInItsUnit) {
  const test::TempFolder folder;
  for (const char* name : {"d.tiff", "d.exr"}) {
    ::setenv("OPENCV_IO_ENABLE_OPENEXR", "1", 1);
    const cv::Mat map(2, 4, CV_32F, cv::Scalar(42.5));  // mm
    ASSERT_TRUE(cv::imwrite((folder.path() / name).string(), map)) << name;
    const DepthMap relief =
        ReliefFromNumbers(ReadGreyNumbers(folder.path() / name), {}, kImportRadius, 4, 2, name);
    EXPECT_NEAR(relief.at(3, 1), 0.0075, 1e-8) << name;
  }
}

TEST(DepthImport, RefusesInOneSentenceWhatCannotBeTheDepthOfThisPanorama) {
  GreyNumbers numbers{4, 2, 0, std::vector<float>(8, 42.5f)};
  EXPECT_EQ(RefusalOf(numbers, {}), "");
  DepthImportOptions metres;
  metres.unit = 1;
  EXPECT_NE(RefusalOf(numbers, metres).find("42500.0"), std::string::npos);
  DepthImportOptions behind;
  behind.meaning = DepthMeaning::kRelief;
  behind.unit = 2e-3;  // 85 mm of relief in a backdrop at 50 mm
  EXPECT_NE(RefusalOf(numbers, behind).find("-35.0"), std::string::npos);
  numbers.values.assign(8, 0);
  EXPECT_NE(RefusalOf(numbers, {}).find("no pixel"), std::string::npos);
  numbers = {5, 2, 0, std::vector<float>(10, 42.5f)};
  EXPECT_NE(RefusalOf(numbers, {}).find("5 x 2"), std::string::npos);
}

TEST(DepthImport, RefusesALargeHeadBeforeItIsDecoded) {
  const test::TempFolder folder;
  ::setenv("OPENCV_IO_ENABLE_OPENEXR", "1", 1);
  const std::filesystem::path file = folder.path() / "d.exr";
  ASSERT_TRUE(cv::imwrite(file.string(), cv::Mat(2, 4, CV_32F, cv::Scalar(42.5))));
  std::string bytes = ReadWholeFile(file);
  const std::size_t window = bytes.find("dataWindow");
  ASSERT_NE(window, bytes.npos);
  constexpr std::size_t kCorner = 11 + 6 + 4 + 8;  // name, type, size, first corner
  bytes.replace(window + kCorner, 8, std::string("\xff\xff\0\0\xff\xff\0\0", 8));
  std::ofstream(file, std::ios::binary) << bytes;
  try {
    ReadGreyNumbers(file);
    ADD_FAILURE() << "read";
  } catch (const Error& error) {
    EXPECT_NE(error.sentence().find("65536 x 65536"), std::string::npos) << error.sentence();
  }
}

TEST(DepthImport, RefusesFilesThatAreNoGreyPicture) {
  const test::TempFolder folder;
  cv::imwrite((folder.path() / "c.png").string(), cv::Mat(2, 4, CV_8UC3, cv::Scalar(1, 2, 3)));
  std::ofstream(folder.path() / "t.png") << "not a picture";
  std::ofstream(folder.path() / "e.png");
  // Formats whose decoders are not needed, whatever the file is called.
  for (const char* name : {"g.jpg", "g.hdr"})
    cv::imwrite((folder.path() / name).string(), cv::Mat(2, 4, CV_32FC3, cv::Scalar(1, 1, 1)));
  std::filesystem::rename(folder.path() / "g.hdr", folder.path() / "g.exr");
  for (const char* name : {"c.png", "t.png", "e.png", "g.jpg", "g.exr", "missing.png"})
    EXPECT_THROW(ReadGreyNumbers(folder.path() / name), Error) << name;
}

}  // namespace
}  // namespace arthro::authoring
