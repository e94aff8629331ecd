// A stroke that is drawn piece by piece against the whole stroke at once.
#include "authoring/depth/strokes/growing_stroke.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>

#include <gtest/gtest.h>

namespace arthro::authoring {
namespace {

constexpr int kWidth = 900, kHeight = 500;
constexpr double kRadius = 0.05;  // m, of the backdrop
constexpr StrokeKind kAll[] = {StrokeKind::kRaise,      StrokeKind::kLower,   StrokeKind::kSmooth,
                               StrokeKind::kFlatten,    StrokeKind::kUnknown, StrokeKind::kEdge,
                               StrokeKind::kBrightness, StrokeKind::kMask,    StrokeKind::kKeep};

template <class Value>
bool SameBytes(const std::vector<Value>& a, const std::vector<Value>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Value)) == 0;
}

class GrowingStrokeTest : public testing::Test {
 protected:
  GrowingStrokeTest() {
    projection.centre_px = {449.5, 249.5};
    projection.focal_px = 700;
    std::mt19937 random(5);
    std::normal_distribution<double> noise(0, 1e-4);
    std::uniform_int_distribution<int> byte(0, 255);
    before.relief = DepthMap(kWidth, kHeight);
    before.sigma = DepthMap(kWidth, kHeight, 1e-4f);
    before.origin = OriginMap(kWidth, kHeight, ReliefOrigin::kMeasured);
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        before.relief.at(x, y) =
            static_cast<float>(0.01 + 4e-3 * std::sin(0.02 * x) + noise(random));
        if (x > 300 && x < 330 && y > 200) before.relief.at(x, y) = std::nanf("");
      }
    for (std::uint8_t& value : panorama->rgb) value = static_cast<std::uint8_t>(byte(random));
  }
  DepthStroke Stroke(StrokeKind kind, double radius) const {
    DepthStroke stroke;
    stroke.kind = kind;
    stroke.radius = radius / kWidth;
    stroke.strength = 0.7;
    return stroke;
  }
  GrowingStroke Begun(const DepthStroke& stroke) const {
    return {stroke, panorama, projection, kRadius, before};
  }
  // A line that turns, crosses itself and leaves the map.
  static std::vector<glm::dvec2> Line() {
    std::vector<glm::dvec2> points;
    for (int i = 0; i < 60; ++i)
      points.emplace_back((200 + 7.0 * i + 60 * std::cos(0.3 * i)) / kWidth,
                          (150 + 5.0 * i + 90 * std::sin(0.3 * i)) / kWidth);
    points.emplace_back(1.05, 0.2);
    return points;
  }

  MendedDepth before;
  std::shared_ptr<ColourImage> panorama = std::make_shared<ColourImage>(kWidth, kHeight);
  Projection projection;
};

TEST_F(GrowingStrokeTest, HasTheBytesOfTheWholeStrokeAfterEachPoint) {
  for (const StrokeKind kind : kAll) {
    DepthStroke stroke = Stroke(kind, 23);
    GrowingStroke growing = Begun(stroke);
    std::vector<glm::dvec2> line = Line();
    if (kind == StrokeKind::kMask) line.resize(8);  // it is closed as a whole each time
    for (const glm::dvec2& point : line) {
      growing.Add({&point, 1});
      stroke.points.push_back(point);
      if (stroke.points.size() > 3 && stroke.points.size() % 20 != 1) continue;
      MendedDepth whole = before;
      ApplyStroke(stroke, {*panorama, projection, kRadius}, whole);
      ASSERT_TRUE(SameBytes(growing.depth().relief.relief, whole.relief.relief))
          << ToString(kind) << ", " << stroke.points.size() << " points";
      ASSERT_TRUE(SameBytes(growing.depth().sigma.relief, whole.sigma.relief)) << ToString(kind);
      ASSERT_TRUE(SameBytes(growing.depth().origin.origin, whole.origin.origin)) << ToString(kind);
    }
  }
}

TEST_F(GrowingStrokeTest, APieceComputesTheTilesThatItReaches) {
  // A piece of 10 px with a radius of 20 px spans 50 px: two tiles along each axis at most.
  constexpr int kMost = 4 * StrokeTile::kSide * StrokeTile::kSide;
  for (const StrokeKind kind : {StrokeKind::kRaise, StrokeKind::kLower, StrokeKind::kSmooth,
                                StrokeKind::kUnknown, StrokeKind::kEdge}) {
    GrowingStroke growing = Begun(Stroke(kind, 20));
    for (int i = 0; i < 80; ++i) {
      const glm::dvec2 point((50 + 10.0 * i) / kWidth, 250.0 / kWidth);
      EXPECT_LE(growing.Add({&point, 1}).read, kMost) << ToString(kind) << ", piece " << i;
    }
  }
}

TEST_F(GrowingStrokeTest, PointsMayBeAddedTogether) {
  GrowingStroke at_once = Begun(Stroke(StrokeKind::kFlatten, 15)), by_one = at_once;
  const std::vector<glm::dvec2> line = Line();
  at_once.Add(line);
  for (const glm::dvec2& point : line) by_one.Add({&point, 1});
  EXPECT_TRUE(SameBytes(at_once.depth().relief.relief, by_one.depth().relief.relief));
}

}  // namespace
}  // namespace arthro::authoring
