// RELIEF-16, RELIEF-17. Clips and lenses that cannot be used, and clips that are long: one sentence
// that says what to do, and bounded memory.
#include <algorithm>
#include <functional>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "authoring/relief/make/make_relief.h"
#include "authoring/relief/relief_clip.h"
#include "simulation/core/error.h"
#include "tests/support/relief/cavity_clip.h"
#include "tests/support/temp_folder.h"

namespace arthro::authoring {
namespace {

namespace fs = std::filesystem;

// Frames that differ, of any size; what they show does not matter here.
void WriteFrames(const fs::path& folder, int count, const cv::Size& size) {
  for (int i = 0; i < count; ++i) {
    cv::Mat picture(size, CV_8UC3, cv::Scalar(60, 70, 120));
    for (int k = 0; k < 6; ++k)
      cv::circle(picture, {(37 * k + 3 * i) % size.width, (53 * k + i) % size.height}, 5 + k,
                 cv::Scalar(90, 100 + 10 * k, 200), cv::FILLED);
    cv::imwrite((folder / fmt::format("{:05}.png", i)).string(), picture);
  }
}

std::string SentenceOf(const ReliefRequest& request) {
  try {
    MakeRelief(request, {});
  } catch (const Error& error) {
    return error.sentence();
  }
  return "";
}

ReliefRequest RequestOf(const fs::path& folder) {
  ReliefRequest request;
  request.footage = folder;
  request.lens = test::CavityLens();
  return request;
}

TEST(MakeRelief, RefusesOneFrame) {
  const test::TempFolder folder;
  WriteFrames(folder.path(), 1, {240, 200});
  const std::string sentence = SentenceOf(RequestOf(folder.path()));
  EXPECT_NE(sentence.find("1 of its 1 frames can be used, and a relief needs two"),
            std::string::npos)
      << sentence;
}

// Two frames that share no tissue fix no point, so that nothing tells the focal length.
TEST(MakeRelief, CallsAFocalLengthThatNothingTellsAGuess) {
  const test::TempFolder folder;
  WriteFrames(folder.path(), 2, {240, 200});
  ReliefRequest request = RequestOf(folder.path());
  request.lens.reset();
  const ReliefReport report = MakeRelief(request, {}).report;
  EXPECT_FALSE(report.verdict.is_measured());
  EXPECT_EQ(report.focal_sigma, 0) << "not determined";
  const auto says = [&](const char* words) {
    return std::ranges::any_of(report.warnings, [&](const std::string& warning) {
      return warning.find(words) != std::string::npos;
    });
  };
  EXPECT_TRUE(says("is a guess"));
  EXPECT_FALSE(says("was found from the clip"));
}

TEST(MakeRelief, NamesTheFrameOfAnotherSizeAndBothSizes) {
  const test::TempFolder folder;
  WriteFrames(folder.path(), 1, {240, 200});
  cv::imwrite((folder.path() / "00001.png").string(), cv::Mat(100, 120, CV_8UC3, cv::Scalar(9)));
  const std::string sentence = SentenceOf(RequestOf(folder.path()));
  EXPECT_NE(sentence.find("frame 1 is 120 x 100 px and the first frame 240 x 200"),
            std::string::npos)
      << sentence;
}

TEST(MakeRelief, RefusesALensForPicturesOfAnotherSize) {
  const test::TempFolder folder;
  WriteFrames(folder.path(), 3, {320, 240});
  const std::string sentence = SentenceOf(RequestOf(folder.path()));
  EXPECT_NE(sentence.find("240 x 200 px"), std::string::npos) << sentence;
  EXPECT_NE(sentence.find("320 x 240"), std::string::npos) << sentence;
}

TEST(ReadReliefClip, KeepsAtMostSixtyFramesOfALongClip) {
  const test::TempFolder folder;
  WriteFrames(folder.path(), 5000, {48, 40});
  Lens lens = test::CavityLens();
  lens.width = 48;
  lens.height = 40;
  lens.cx = 24;
  lens.cy = 20;
  lens.focal_px /= 5;
  lens.circle = {24, 20, 19};
  const ReliefOptions options;
  StageClock clock({}, {{"read", 1}, {"prepare", 1}});
  const ReliefClip clip = ReadReliefClip(folder.path(), lens, options, {}, clock);
  EXPECT_LE(clip.frames.size(), 60u);
  EXPECT_GE(clip.frames.size(), 30u);
  ASSERT_EQ(clip.rows.size(), 5000u);
  EXPECT_EQ(std::count_if(clip.rows.begin(), clip.rows.end(),
                          [](const ClipRow& row) { return row.reason.empty(); }),
            static_cast<std::ptrdiff_t>(clip.frames.size()))
      << "every other frame has a reason";
}

}  // namespace
}  // namespace arthro::authoring
