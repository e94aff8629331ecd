#include "authoring/panorama/compose/light_model.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/authoring/panorama/compose/small_clip.h"

namespace arthro::authoring {
namespace {

// Cells of frames with a view of a plane of known brightness under a known light.
struct KnownLight {
  Layout layout;
  std::vector<CellRays> rays;
  std::vector<FrameCells> cells;

  explicit KnownLight(const LightModel& light) {
    test::SmallClip clip;
    for (std::size_t i = 0; i < light.frames.size(); ++i)
      clip.corners.emplace_back(40 * (i % 4), 35 * (i / 4));
    const Rectifier& rectifier = test::PinholeRectifier();
    layout = LayOut(rectifier.mask(), rectifier.view(), clip.Places(), {});
    for (std::size_t f = 0; f < light.frames.size(); ++f) {
      rays.emplace_back(layout.frames[f], layout.cell, rectifier.view());
      const cv::Rect& box = layout.frames[f].cells;
      cells.push_back({cv::Mat(box.size(), CV_16UC3), cv::Mat(box.size(), CV_8U, cv::Scalar(255))});
      for (int y = 0; y < box.height; ++y)
        for (int x = 0; x < box.width; ++x) {
          const double excess = light.Excess(static_cast<int>(f), rays[f].At(box.x + x, box.y + y));
          const double albedo[3] = {0.6, 0.35 + 0.1 * std::sin(0.3 * (box.x + x)),
                                    0.25 + 0.05 * std::cos(0.4 * (box.y + y))};
          for (int c = 0; c < 3; ++c)
            cells[f].colour.at<cv::Vec3w>(y, x)[c] =
                cv::saturate_cast<ushort>(kGreySteps * 255 * albedo[c] * std::exp(excess));
        }
    }
  }
};

LightModel SomeLight() {
  LightModel light;
  light.falloff = {-6, -2, 0};  // the lens sees 18 degrees off its axis at most: u up to 0.1
  light.frames.resize(12);
  for (std::size_t f = 0; f < 12; ++f) light.frames[f].gain = 0.15 * std::sin(2.0 * f);
  return light;
}

TEST(LightModel, FalloffAndGainsComeBackFromOverlaps) {
  const LightModel truth = SomeLight();
  const KnownLight known(truth);
  const LightModel found =
      EstimateLight(known.cells, known.rays, known.layout, ComposeOptions{}, {});
  // Compares differences from the middle of frame 0, since a common level is free.
  const CellRays::Ray middle{0, 0, 1, 1};
  for (const double tangent : {0.1, 0.2, 0.3}) {
    const CellRays::Ray ray{tangent, 0, 1, 1};
    EXPECT_NEAR(found.Excess(0, ray) - found.Excess(0, middle),
                truth.Excess(0, ray) - truth.Excess(0, middle), 0.02)
        << tangent;
  }
  for (int f = 1; f < 12; ++f)
    EXPECT_NEAR(found.Excess(f, middle) - found.Excess(0, middle),
                truth.Excess(f, middle) - truth.Excess(0, middle), 0.02)
        << f;
}

TEST(LightModel, OutliersDoNotBendIt) {
  const LightModel truth = SomeLight();
  KnownLight known(truth);
  for (std::size_t f = 0; f < 12; f += 3)  // a dark tool in every third frame
    known.cells[f].colour(cv::Rect(0, 0, 16, 12)).setTo(cv::Scalar(4000, 4000, 4000));
  const LightModel found =
      EstimateLight(known.cells, known.rays, known.layout, ComposeOptions{}, {});
  const CellRays::Ray middle{0, 0, 1, 1}, ray{0.25, 0, 1, 1};
  EXPECT_NEAR(found.Excess(1, ray) - found.Excess(1, middle),
              truth.Excess(1, ray) - truth.Excess(1, middle), 0.04);
}

TEST(LightModel, SwitchedOffItChangesNothing) {
  const KnownLight known(SomeLight());
  ComposeOptions options;
  options.even_light = false;
  const LightModel found = EstimateLight(known.cells, known.rays, known.layout, options, {});
  EXPECT_EQ(found.Excess(3, {0.2, 0.1, 1, 1}), 0.0);
}

TEST(ToneCurve, GreyLevelsComeBack) {
  LightModel light;
  light.response = {0.1, 0.2};
  const ToneCurve tone(light);
  for (int grey = 4; grey < 256; ++grey)  // below 4, the table's first steps
    EXPECT_NEAR(tone.Grey(tone.Linear(grey)), grey, 0.1);
}

}  // namespace
}  // namespace arthro::authoring
