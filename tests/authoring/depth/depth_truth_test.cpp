// Error of relief from brightness: against a picture lit by a known relief, and plausibility on
// real footage.
#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/videoio.hpp>

#include "authoring/depth/depth_filter.h"
#include "simulation/scene/image_io.h"
#include "tests/support/depth_score.h"
#include "tests/support/knee_picture.h"
#include "tests/support/run_program.h"
#include "tests/support/shared_data.h"

namespace arthro::authoring {
namespace {

using test::RankCorrelation;

TEST(DepthTruth, NoisyReliefIsOrderedAsTheTruth) {
  constexpr int kWidth = 400, kHeight = 300;
  const ColourImage knee = test::KneePicture(kWidth, kHeight, 12.0);
  const auto correlation = [&](int radius) {
    DepthOptions options;
    options.median_radius = radius;
    const DepthMap depth = DepthFromColour(knee, options);
    std::vector<double> found, truth;
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        if (std::isnan(depth.at(x, y))) continue;
        found.push_back(depth.at(x, y));
        truth.push_back(test::KneeRelief((2.0 * x + 1) / kWidth - 1, (2.0 * y + 1) / kHeight - 1));
      }
    return RankCorrelation(found, truth);
  };
  const double raw = correlation(0), median = correlation(2);
  std::printf("Spearman: grey alone %.4f, with median %.4f\n", raw, median);
  EXPECT_GT(median, raw);
  // One tissue under one light: only noise, highlights and clamped greys lower the correlation from
  // 1.
  EXPECT_GT(median, 0.98);
}

// Highlights larger than the median's window. Filling must at least halve the error there against
// the same picture without highlights.
TEST(DepthTruth, FillingAtLeastHalvesTheErrorAtGlints) {
  const ColourImage with = test::KneePicture(1600, 1200, 6.0, true),
                    without = test::KneePicture(1600, 1200, 6.0, false);
  const DepthMap truth = DepthFromColour(without, {});
  const auto error = [&](bool fill) {
    DepthOptions options;
    options.fill_highlights = fill;
    const DepthMap depth = DepthFromColour(with, options);
    double sum = 0;
    int count = 0;
    for (int y = 0; y < with.height; ++y)
      for (int x = 0; x < with.width; ++x)
        if (with.at(x, y)[2] == 255 && !std::isnan(depth.at(x, y))) {
          sum += std::abs(double(depth.at(x, y)) - truth.at(x, y));
          ++count;
        }
    EXPECT_GT(count, 100);
    return sum / count;
  };
  const double raw = error(false), filled = error(true);
  std::printf("mean error at glints: %.2f mm, filled %.2f mm\n", 1e3 * raw, 1e3 * filled);
  EXPECT_LT(filled, 0.5 * raw);
}

// Several tissues under one light: red synovium reads as far, pale cartilage as near, so this is a
// ranking and no measurement. The paper's grey must reach half of the way from chance (0) to 1; red
// alone is printed beside it.
TEST(DepthTruth, AKneeOfSeveralTissuesIsRankedBetterThanHalfWay) {
  test::TempFolder folder;
  const auto made = test::RunProgram("phantom --seed 1 --size S -o " + (folder / "knee").string());
  if (made.exit_code == 2) GTEST_SKIP() << "SKIPPED: this program makes no phantom";
  ASSERT_EQ(made.exit_code, 0) << made.err;
  const ColourImage panorama = ReadColourImage(folder / "knee/panorama.png");
  const DepthMap truth = ReadDepthMap(folder / "knee/depth.tiff");
  const auto correlation = [&](const DepthOptions& options) {
    const DepthMap depth = DepthFromColour(panorama, options);
    std::vector<double> found, known;
    for (std::size_t i = 0; i < depth.relief.size(); ++i) {
      if (std::isnan(depth.relief[i]) || std::isnan(truth.relief[i])) continue;
      found.push_back(depth.relief[i]);
      known.push_back(truth.relief[i]);
    }
    return RankCorrelation(found, known);
  };
  DepthOptions red;
  red.red_weight = 1;
  red.green_weight = red.blue_weight = 0;
  const double paper = correlation({});
  std::printf("phantom, Spearman: little red %.3f, red alone %.3f\n", paper, correlation(red));
  EXPECT_GT(paper, 0.5);
}

TEST(DepthTruth, RealFootageGivesARangeWithoutSurround) {
  ARTHRO_REQUIRE_SHARED(file, "data/laparoscopy_rvim/endo.mp4");
  cv::VideoCapture video(file.string());
  cv::Mat bgr;
  if (!video.read(bgr)) GTEST_SKIP() << "SKIPPED: this OpenCV cannot decode " << file;
  ColourImage frame(bgr.cols, bgr.rows);
  for (int y = 0; y < bgr.rows; ++y)
    for (int x = 0; x < bgr.cols; ++x)
      for (int c = 0; c < 3; ++c) frame.at(x, y)[c] = bgr.at<cv::Vec3b>(y, x)[2 - c];
  DepthReport report;
  const DepthMap depth = DepthFromColour(frame, {}, &report);
  std::printf("%d x %d: imaged %.1f %%, glints %.2f %%, greys %.1f to %.1f\n", frame.width,
              frame.height, 100 * report.imaged_share, 100 * report.highlight_share,
              report.low_grey, report.high_grey);
  EXPECT_FALSE(report.is_flat);
  EXPECT_FALSE(report.is_overexposed);
  EXPECT_GT(report.imaged_share, 0.3);
  EXPECT_GT(report.high_grey - report.low_grey, 64.0) << "the tissue spans a quarter of all greys";
  for (const float h : depth.relief) ASSERT_TRUE(std::isnan(h) || (h >= 0.0f && h <= 0.02f));
}

}  // namespace
}  // namespace arthro::authoring
