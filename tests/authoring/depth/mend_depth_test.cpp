#include "authoring/depth/strokes/mend_depth.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "authoring/depth/depth_preview.h"
#include "authoring/depth/strokes/depth_strokes_io.h"
#include "simulation/core/error.h"

namespace arthro::authoring {
namespace {

constexpr int kMapWidth = 400, kMapHeight = 240;
constexpr double kMapRadius = 0.05;      // m, of the backdrop
constexpr double kFloat = 2e-9;          // m, rounding of a float near 0.02
constexpr glm::dvec2 kMiddle(200, 120);  // px

class MendDepth : public testing::Test {
 protected:
  MendDepth() {
    projection.centre_px = {199.5, 119.5};
    projection.focal_px = 300;
  }
  MendedScene scene() const { return {panorama, projection, kMapRadius}; }
  // A stroke through these pixels with a radius in px.
  static DepthStroke Stroke(StrokeKind kind, double radius, std::vector<glm::dvec2> pixels) {
    DepthStroke stroke;
    stroke.kind = kind;
    stroke.radius = radius / kMapWidth;
    for (const glm::dvec2& pixel : pixels)
      stroke.points.push_back((pixel + 0.5) / double(kMapWidth));
    return stroke;
  }
  MendedDepth Flat(float height) const { return {DepthMap(kMapWidth, kMapHeight, height), {}, {}}; }

  ColourImage panorama{kMapWidth, kMapHeight};
  Projection projection;
};

bool SameBytes(const DepthMap& a, const DepthMap& b) {
  return a.relief.size() == b.relief.size() &&
         std::memcmp(a.relief.data(), b.relief.data(), a.relief.size() * sizeof(float)) == 0;
}

TEST_F(MendDepth, RaisesByItsAmountAtTheCentreAndByTheFalloffBesideIt) {
  struct Case {
    StrokeFalloff falloff;
    double weight;  // at three quarters of the radius, half way down from a hardness of one half
  };
  for (const Case& c : {Case{StrokeFalloff::kSmooth, 0.5}, Case{StrokeFalloff::kLinear, 0.5},
                        Case{StrokeFalloff::kRound, std::sqrt(0.75)}}) {
    MendedDepth depth = Flat(0.005f);
    DepthStroke stroke = Stroke(StrokeKind::kRaise, 20, {kMiddle});
    stroke.falloff = c.falloff;
    const StrokeReport report = ApplyStroke(stroke, scene(), depth);
    EXPECT_NEAR(depth.relief.at(200, 120), 0.006, kFloat);
    EXPECT_NEAR(depth.relief.at(210, 120), 0.006, kFloat);  // the end of the hard core
    EXPECT_NEAR(depth.relief.at(215, 120), 0.005 + c.weight * 1e-3, kFloat);
    EXPECT_EQ(depth.relief.at(220, 120), 0.005f);
    EXPECT_EQ(report.box.width(), 39);  // the rim at 20 px has no weight
  }
}

TEST_F(MendDepth, LowersByItsAmountAlongTheWholeLineOnce) {
  MendedDepth depth = Flat(0.01f);
  // The line crosses itself; a stroke counts once.
  DepthStroke stroke =
      Stroke(StrokeKind::kLower, 10, {{100, 100}, {200, 100}, {150, 140}, {150, 60}});
  stroke.amount = 2e-3;
  ApplyStroke(stroke, scene(), depth);
  for (int x = 100; x <= 200; ++x) EXPECT_NEAR(depth.relief.at(x, 100), 0.008, kFloat);
}

TEST_F(MendDepth, SmoothKeepsARampAndSpreadsAPeakEvenly) {
  MendedDepth depth = Flat(0);
  for (int y = 0; y < kMapHeight; ++y)
    for (int x = 0; x < kMapWidth; ++x) depth.relief.at(x, y) = static_cast<float>(2e-5 * x);
  const DepthMap ramp = depth.relief;
  DepthStroke stroke = Stroke(StrokeKind::kSmooth, 8, {kMiddle});  // means over 9 x 9 pixels
  ApplyStroke(stroke, scene(), depth);
  for (std::size_t i = 0; i < ramp.relief.size(); ++i)
    ASSERT_NEAR(depth.relief.relief[i], ramp.relief[i], kFloat);

  depth = Flat(0);
  depth.relief.at(200, 120) = 0.0081f;
  ApplyStroke(stroke, scene(), depth);
  for (const int x : {196, 198, 200, 202, 204})
    EXPECT_NEAR(depth.relief.at(x, 120), 0.0081 / 81, kFloat) << x;
}

TEST_F(MendDepth, FlattensANoisyPlaneToThePlane) {
  // A plane tilted by 20 degrees, 40 mm in front of the portal, with noise of 0.2 mm.
  const glm::dvec3 normal(std::sin(0.35), 0, std::cos(0.35));
  const auto height_of = [&](int x, int y) {
    return kMapRadius - 0.04 / glm::dot(normal, DirectionFromPixel(projection, glm::dvec2(x, y)));
  };
  std::mt19937 random(3);
  std::normal_distribution<double> noise(0, 2e-4);
  MendedDepth depth = Flat(0);
  for (int y = 0; y < kMapHeight; ++y)
    for (int x = 0; x < kMapWidth; ++x)
      depth.relief.at(x, y) = static_cast<float>(height_of(x, y) + noise(random));
  DepthStroke stroke = Stroke(StrokeKind::kFlatten, 40, {kMiddle});
  stroke.hardness = 1;
  const StrokeReport report = ApplyStroke(stroke, scene(), depth);
  // Three numbers are fitted to `touched` values: the rms error of the fit is the noise times
  // sqrt(3 / touched). The largest is at most three times that of the mean on a disc, and chance
  // adds a factor of at most four.
  const double bound = 12 * 2e-4 * std::sqrt(3.0 / report.touched);
  double worst = 0;
  for (int y = 85; y < 155; ++y)
    for (int x = 165; x < 235; ++x)
      if (glm::distance(glm::dvec2(x, y), kMiddle) < 40)
        worst = std::max(worst, std::abs(depth.relief.at(x, y) - height_of(x, y)));
  EXPECT_LT(worst, bound);
  EXPECT_LT(bound, 2e-4);  // the claim is about less than the noise
}

TEST_F(MendDepth, CopiesTheShapeOfTheBrightnessAtTheMeanHeight) {
  // White on the right half: luminances 0 and 1, as many pixels of each.
  for (int y = 0; y < kMapHeight; ++y)
    for (int x = kMapWidth / 2; x < kMapWidth; ++x)
      std::fill(panorama.at(x, y), panorama.at(x, y) + 3, std::uint8_t{255});
  MendedDepth depth = Flat(0.01f);
  DepthStroke stroke = Stroke(StrokeKind::kBrightness, 20, {{199.5, 120}});
  stroke.hardness = 1;
  stroke.amount = 4e-3;
  ApplyStroke(stroke, scene(), depth);
  EXPECT_NEAR(depth.relief.at(190, 120), 0.008, kFloat);
  EXPECT_NEAR(depth.relief.at(209, 120), 0.012, kFloat);
}

TEST_F(MendDepth, UnknownRemovesTheDepthUpToHalfItsWeight) {
  MendedDepth depth = Flat(0.01f);
  depth.sigma = DepthMap(kMapWidth, kMapHeight, 1e-4f);
  depth.origin = OriginMap(kMapWidth, kMapHeight, ReliefOrigin::kMeasured);
  ApplyStroke(Stroke(StrokeKind::kUnknown, 20, {kMiddle}), scene(), depth);
  EXPECT_TRUE(std::isnan(depth.relief.at(200, 120)));
  EXPECT_TRUE(std::isnan(depth.sigma.at(200, 120)));
  EXPECT_EQ(depth.origin.at(200, 120), ReliefOrigin::kNone);
  EXPECT_TRUE(std::isnan(depth.relief.at(215, 120)));
  EXPECT_EQ(depth.relief.at(216, 120), 0.01f);
  EXPECT_EQ(depth.origin.at(216, 120), ReliefOrigin::kMeasured);
}

TEST_F(MendDepth, EdgeTurnsARampIntoAStepOnItsLine) {
  // Heights rise from 5 to 15 mm over 20 px, as behind a median; the edge lies in the middle.
  MendedDepth depth = Flat(0);
  for (int y = 0; y < kMapHeight; ++y)
    for (int x = 0; x < kMapWidth; ++x)
      depth.relief.at(x, y) =
          static_cast<float>(0.005 + 0.01 * std::clamp((x - 190) / 20.0, 0.0, 1.0));
  DepthStroke stroke = Stroke(StrokeKind::kEdge, 15, {{199.5, 40}, {199.5, 200}});
  stroke.hardness = 0.8;  // 12 px: the whole ramp
  ApplyStroke(stroke, scene(), depth);
  for (int x = 180; x < 220; ++x)
    EXPECT_NEAR(depth.relief.at(x, 120), x < 200 ? 0.005 : 0.015, 2 * kFloat) << x;
  EXPECT_NEAR(depth.relief.at(200, 20), 0.01, kFloat);  // beyond the end of the line
}

TEST_F(MendDepth, MaskSpansTheSurroundAndSaysThatItIsInterpolated) {
  MendedDepth depth = Flat(0.01f);
  depth.origin = OriginMap(kMapWidth, kMapHeight, ReliefOrigin::kMeasured);
  for (int y = 115; y < 125; ++y)
    for (int x = 195; x < 205; ++x) depth.relief.at(x, y) = 0.03f;  // a glint
  ApplyStroke(Stroke(StrokeKind::kMask, 12, {kMiddle}), scene(), depth);
  for (const float height : depth.relief.relief) ASSERT_NEAR(height, 0.01f, 1e-6);
  EXPECT_EQ(depth.origin.at(200, 120), ReliefOrigin::kInterpolated);
  EXPECT_EQ(depth.origin.at(240, 120), ReliefOrigin::kMeasured);
}

TEST_F(MendDepth, TouchesOnlyTheTilesOfTheStroke) {
  MendedDepth depth = Flat(0.01f);
  const DepthMap before = depth.relief;
  const StrokeReport report =
      ApplyStroke(Stroke(StrokeKind::kRaise, 10, {{30, 30}, {50, 30}}), scene(), depth);
  int changed = 0;
  for (std::size_t i = 0; i < before.relief.size(); ++i)
    changed += before.relief[i] != depth.relief.relief[i];
  // Pixels within less than 10 px of the line: its two half discs and the rectangle between them.
  EXPECT_NEAR(report.touched, 3.1416 * 100 + 20 * 20, 40);
  EXPECT_LE(changed, report.touched);
  EXPECT_EQ(report.read, StrokeTile::kSide * StrokeTile::kSide);  // one tile of 24
}

TEST_F(MendDepth, LeavesUnknownPixelsUnknownAndOutOfMeans) {
  for (const StrokeKind kind : {StrokeKind::kRaise, StrokeKind::kSmooth, StrokeKind::kFlatten,
                                StrokeKind::kBrightness, StrokeKind::kEdge, StrokeKind::kMask}) {
    MendedDepth depth = Flat(0.01f);
    for (int y = 100; y < 140; ++y)
      for (int x = 200; x < 230; ++x) depth.relief.at(x, y) = std::nanf("");
    ApplyStroke(Stroke(kind, 30, {{180, 120}, {220, 120}}), scene(), depth);
    EXPECT_TRUE(std::isnan(depth.relief.at(205, 120))) << ToString(kind);
    EXPECT_FALSE(std::isnan(depth.relief.at(195, 120))) << ToString(kind);
  }
}

TEST_F(MendDepth, StatesThatAChangedMeasurementIsNoLongerMeasured) {
  MendedDepth depth = Flat(0.01f);
  depth.sigma = DepthMap(kMapWidth, kMapHeight, 3e-4f);
  depth.origin = OriginMap(kMapWidth, kMapHeight, ReliefOrigin::kMeasured);
  DepthStroke stroke = Stroke(StrokeKind::kRaise, 20, {kMiddle});
  stroke.amount = 4e-4;
  ApplyStroke(stroke, scene(), depth);
  EXPECT_EQ(depth.origin.at(200, 120), ReliefOrigin::kInterpolated);
  EXPECT_NEAR(depth.sigma.at(200, 120), 5e-4, 1e-8);  // 3, 4, 5
  EXPECT_EQ(depth.origin.at(221, 120), ReliefOrigin::kMeasured);
}

TEST_F(MendDepth, KeepsItsPlaceAtAnotherResolution) {
  const DepthStroke stroke = Stroke(StrokeKind::kRaise, 24, {{100, 80}, {300, 160}});
  MendedDepth full = Flat(0.01f);
  MendedDepth half{DepthMap(kMapWidth / 2, kMapHeight / 2, 0.01f), {}, {}};
  const StrokeReport large = ApplyStroke(stroke, scene(), full),
                     small = ApplyStroke(stroke, scene(), half);
  EXPECT_NEAR(small.touched, large.touched / 4.0, 0.03 * large.touched / 4.0);
  // A pixel of the half size has its centre between four pixels of the full size. The slope of the
  // falloff, 1.5 / 12 px, bounds the difference of a height half a pixel away.
  for (int y = 0; y < kMapHeight / 2; ++y)
    for (int x = 0; x < kMapWidth / 2; ++x)
      ASSERT_NEAR(half.relief.at(x, y), full.relief.at(2 * x, 2 * y), 1e-3 * 0.71 * 1.5 / 12);
}

TEST_F(MendDepth, GivesTheSameBytesForAnyNumberOfThreads) {
  DepthStrokes strokes;
  for (const StrokeKind kind :
       {StrokeKind::kRaise, StrokeKind::kBrightness, StrokeKind::kSmooth, StrokeKind::kFlatten,
        StrokeKind::kEdge, StrokeKind::kMask, StrokeKind::kUnknown})
    strokes.push_back(Stroke(kind, 30 + 5 * static_cast<int>(strokes.size()),
                             {{40, 40}, {330, 90 + 15.0 * static_cast<double>(strokes.size())}}));
  std::mt19937 random(1);
  for (std::uint8_t& value : panorama.rgb) value = static_cast<std::uint8_t>(random());
  std::vector<DepthMap> maps;
  const int threads = cv::getNumThreads();
  for (const int count : {1, 2, 4}) {
    cv::setNumThreads(count);
    MendedDepth depth = Flat(0.01f);
    for (const DepthStroke& stroke : strokes) ApplyStroke(stroke, scene(), depth);
    maps.push_back(depth.relief);
  }
  cv::setNumThreads(threads);
  EXPECT_TRUE(SameBytes(maps[0], maps[1]));
  EXPECT_TRUE(SameBytes(maps[0], maps[2]));
}

TEST_F(MendDepth, MasksHoldTheEstimatorOffAGlintAndKeepsTakeThemAway) {
  // Tissue of one grey with a white square: an instrument, too large for a glint.
  std::fill(panorama.rgb.begin(), panorama.rgb.end(), std::uint8_t{100});
  for (int x = 0; x < kMapWidth; ++x)
    for (int y = 0; y < 20; ++y)
      std::fill(panorama.at(x, y), panorama.at(x, y) + 3, std::uint8_t(60));
  for (int y = 100; y < 150; ++y)
    for (int x = 100; x < 160; ++x)
      std::fill(panorama.at(x, y), panorama.at(x, y) + 3, std::uint8_t{240});
  DepthOptions options;
  options.low_percentile = 0;
  options.high_percentile = 100;
  options.fill_highlights = false;
  const DepthMap plain = DepthFromColour(panorama, options);
  EXPECT_NEAR(plain.at(130, 125), options.near_relief, 1e-6);
  EXPECT_LT(plain.at(300, 125), 0.5 * options.near_relief);
  DepthStrokes strokes = {Stroke(StrokeKind::kMask, 45, {{130, 125}})};
  const DepthMap masked =
      DepthFromColour(panorama, options, nullptr, {}, MarksOf(strokes, kMapWidth, kMapHeight));
  // Without the instrument the tissue itself spans the range.
  EXPECT_NEAR(masked.at(300, 125), options.near_relief, 1e-6);
  EXPECT_NEAR(masked.at(130, 125), options.near_relief, 1e-6);
  strokes.push_back(Stroke(StrokeKind::kKeep, 45, {{130, 125}}));
  EXPECT_TRUE(SameBytes(plain, DepthFromColour(panorama, options, nullptr, {},
                                               MarksOf(strokes, kMapWidth, kMapHeight))));
}

TEST_F(MendDepth, StrokesSurviveTheirFile) {
  DepthStrokes strokes = {Stroke(StrokeKind::kEdge, 17, {{1, 2}, {3.25, 4.125}}),
                          Stroke(StrokeKind::kKeep, 3, {{200, 120}})};
  strokes[0].falloff = StrokeFalloff::kRound;
  strokes[0].amount = 0.1 + 0.2 - 0.28;
  EXPECT_EQ(StrokesFromText(StrokesText(strokes), "strokes.json"), strokes);
}

TEST(DepthStrokesFile, RefusesWhatIsNoStrokeInOneSentence) {
  const auto refusal = [](const std::string& strokes) -> std::string {
    try {
      StrokesFromText(R"({"schema": "arthroscene.depth-strokes/1", "strokes": )" + strokes + "}",
                      "s.json");
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(refusal("[]"), "");
  EXPECT_NE(refusal(R"([{"kind": "dig", "points": [[0, 0]]}])").find("dig"), std::string::npos);
  EXPECT_NE(refusal(R"([{"kind": "raise"}])").find("points"), std::string::npos);
  EXPECT_NE(refusal(R"([{"kind": "raise", "points": []}])").find("no points"), std::string::npos);
  EXPECT_NE(refusal(R"([{"radius": -1, "points": [[0, 0]]}])").find("radius"), std::string::npos);
  EXPECT_NE(refusal("7").find("list"), std::string::npos);
}

}  // namespace
}  // namespace arthro::authoring
