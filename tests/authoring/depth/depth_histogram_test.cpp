#include "authoring/depth/depth_histogram.h"

#include <gtest/gtest.h>

#include "authoring/depth/colour_filter.h"
#include "authoring/depth/depth_filter.h"

namespace arthro::authoring {
namespace {

TEST(DepthHistogram, FindsThePercentileOfAPlaceAndThePlaceOfAPercentile) {
  DepthHistogram histogram;
  histogram.share[10] = 0.25;
  histogram.share[20] = 0.75;
  constexpr double kBin = 1.0 / DepthHistogram::kBins;
  EXPECT_DOUBLE_EQ(PercentileAt(histogram, 10.5 * kBin), 12.5);
  EXPECT_DOUBLE_EQ(PercentileAt(histogram, 15 * kBin), 25);
  EXPECT_DOUBLE_EQ(PercentileAt(histogram, 1), 100);
  for (const double percent : {5.0, 25.0, 40.0, 99.0})
    EXPECT_NEAR(PercentileAt(histogram, PlaceOfPercentile(histogram, percent)), percent, 1e-9);
}

TEST(DepthHistogram, CountsTheGreysOfTheImagedPixels) {
  ColourImage image(64, 64);
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x)
      for (int c = 0; c < 3; ++c) image.at(x, y)[c] = x < 16 ? 64 : 192;
  DepthOptions options;
  options.median_radius = 0;
  options.border_margin = 0;
  options.border_taper = options.step_width = 0;
  DepthReport report;
  for (const DepthEstimator estimator : {DepthEstimator::kPaper, DepthEstimator::kShading}) {
    options.estimator = estimator;
    DepthFromColour(image, options, &report);
    double sum = 0;
    for (const double share : report.histogram.share) sum += share;
    EXPECT_NEAR(sum, 1, 1e-9);
  }
  options.estimator = DepthEstimator::kPaper;
  DepthFromColour(image, options, &report);
  EXPECT_NEAR(report.histogram.share[64 * DepthHistogram::kBins / 255], 0.25, 1e-9);
  EXPECT_NEAR(report.histogram.share[192 * DepthHistogram::kBins / 255], 0.75, 1e-9);
}

TEST(ColourFilter, PresetsAreFoundAgainByTheirWeights) {
  DepthOptions options;
  EXPECT_EQ(ColourFilterOf(options), 0);  // the default is the paper's
  int index = 0;
  for (const ColourFilter& filter : kColourFilters) {
    SetColourFilter(options, filter);
    EXPECT_EQ(ColourFilterOf(options), index++) << filter.words;
    CheckDepthOptions(options);
  }
  options.red_weight = 0.123;
  EXPECT_EQ(ColourFilterOf(options), -1);
}

}  // namespace
}  // namespace arthro::authoring
