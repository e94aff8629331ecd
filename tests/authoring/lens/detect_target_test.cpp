#include "authoring/lens/target/detect_target.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "simulation/core/error.h"
#include "tests/support/board_picture.h"
#include "tests/support/round_lens.h"

namespace arthro::authoring {
namespace {

using test::BoardPicture;
using test::BoardPlace;

Lens Fisheye() { return test::RoundLens(320, 256, 180, 161, 126.5, 120); }

test::RayOfPixel RaysOf(const Lens& lens) {
  return [lens](double x, double y, glm::dvec3& ray) {
    const auto found = RayFromPixel(lens, {x, y});
    if (!found || std::hypot(x - lens.circle.cx, y - lens.circle.cy) > lens.circle.r) return false;
    ray = *found;
    return true;
  };
}

BoardPlace Tilted(double distance) { return {0.3, -0.2, 0.2, {0.13, -0.21, distance}}; }

// Distance from the nearest true crossing that a share of the points keep. The lattice's origin and
// quarter turns are free. A wrong label would also break the fit, which has its own test.
double UsualDistance(const TargetView& view, const Lens& lens, const BoardPlace& place,
                     double share = 0.95) {
  const glm::dmat3 turn = test::TurnOf(place);
  std::vector<double> distances;
  for (const LatticePoint& point : view.points) {
    double nearest = 1e9;
    for (int i = -15; i <= 15; ++i)
      for (int j = -15; j <= 15; ++j) {
        const glm::dvec3 at = place.middle + turn * glm::dvec3(i, j, 0);
        if (const auto pixel = PixelFromRay(lens, at))
          nearest =
              std::min(nearest, std::hypot(pixel->x - point.pixel.x, pixel->y - point.pixel.y));
      }
    distances.push_back(nearest);
  }
  std::sort(distances.begin(), distances.end());
  return distances[static_cast<std::size_t>(share * static_cast<double>(distances.size()))];
}

// 0.3 px for 19 points of 20; the fit removes a stray point at the rim.
TEST(DetectTarget, KindAndPointsOfEveryTarget) {
  const Lens lens = Fisheye();
  struct Case {
    TargetKind kind;
    double (*look)(double, double);
    std::size_t fewest;
    double distance;
  };
  for (const Case& c : {Case{TargetKind::kChessboard, test::ChessAt, 63, 9},
                        Case{TargetKind::kLines, test::LinesAt, 30, 6},
                        Case{TargetKind::kDots, test::DotsAt, 60, 9}}) {
    const BoardPlace place = Tilted(c.distance);
    const cv::Mat picture = BoardPicture({320, 256}, RaysOf(lens), place, c.look);
    const TargetView view = DetectTarget(picture, lens.circle, {});
    EXPECT_EQ(view.kind, c.kind) << ToString(view.kind) << " for " << ToString(c.kind);
    EXPECT_GE(view.points.size(), c.fewest) << ToString(c.kind);
    EXPECT_LT(UsualDistance(view, lens, place), 0.3) << ToString(c.kind) << view.points.size();
    EXPECT_NEAR(view.dot_radius, c.kind == TargetKind::kDots ? 0.2 : 0.0, 0.02);
  }
}

TEST(DetectTarget, AGlintAndAMissingLineCostOnlyTheirPoints) {
  const Lens lens = Fisheye();
  const BoardPlace place = Tilted(9);
  const auto look = [](double u, double v) {
    // The line v = 1 is missing.
    return std::abs(v - 1) < 0.3 && std::abs(u - std::round(u)) >= 0.055 ? 1.0
                                                                         : test::LinesAt(u, v);
  };
  cv::Mat picture = BoardPicture({320, 256}, RaysOf(lens), place, look);
  cv::circle(picture, {190, 110}, 14, cv::Scalar(255), cv::FILLED);
  const TargetView view = DetectTarget(picture, lens.circle, {});
  EXPECT_EQ(view.kind, TargetKind::kLines);
  EXPECT_GE(view.points.size(), 40u);
}

// Noise makes candidates along thin lines and hides some crossings, so that a lattice may grow
// along diagonals or between crossings: it has as many points and is not the target's.
TEST(DetectTarget, ThinLinesInNoiseGiveTheLatticeOfTheTarget) {
  Lens lens = test::RoundLens(400, 320, 233, 201, 158.5, 150);
  lens.model = LensModel::kEquisolid;
  lens.aspect = 1;
  for (int seed = 1; seed <= 8; ++seed) {
    const BoardPlace place{0.39 + 0.01 * seed, -0.14, 0.14 + 0.01 * seed, {0.1 * seed, 0.4, 10.5}};
    cv::Mat picture;
    BoardPicture({400, 320}, RaysOf(lens), place, test::LinesAt).convertTo(picture, CV_32F);
    cv::RNG random(static_cast<std::uint64_t>(seed));
    for (int y = 0; y < picture.rows; ++y)
      for (int x = 0; x < picture.cols; ++x) {
        float& value = picture.at<float>(y, x);
        const double off = std::hypot(x - lens.circle.cx, y - lens.circle.cy) / lens.circle.r;
        value = static_cast<float>(value * (0.9 - 0.35 * off * off) + random.gaussian(5));
      }
    picture.convertTo(picture, CV_8U);
    const TargetView view = DetectTarget(picture, lens.circle, {});
    EXPECT_EQ(view.kind, TargetKind::kLines) << "seed " << seed << ": " << view.reason;
    EXPECT_GE(view.points.size(), 120u) << "seed " << seed;
    if (!view.points.empty()) {
      EXPECT_LT(UsualDistance(view, lens, place, 0.5), 0.3) << "seed " << seed;
    }
  }
}

TEST(DetectTarget, SaysWhyThereIsNone) {
  EXPECT_EQ(DetectTarget(cv::Mat(20, 20, CV_8UC1, cv::Scalar(0)), {}, {}).kind, TargetKind::kNone);
  for (const int grey : {0, 128, 255}) {
    const TargetView view = DetectTarget(cv::Mat(200, 200, CV_8UC3, cv::Scalar::all(grey)), {}, {});
    EXPECT_EQ(view.kind, TargetKind::kNone);
    EXPECT_NE(view.reason.find("no line grid"), std::string::npos) << view.reason;
  }
  // A single line.
  cv::Mat line(200, 200, CV_8UC1, cv::Scalar(230));
  cv::line(line, {0, 100}, {199, 120}, cv::Scalar(20), 3, cv::LINE_AA);
  EXPECT_EQ(DetectTarget(line, {}, {}).kind, TargetKind::kNone);
  EXPECT_THROW(DetectTarget(cv::Mat(200, 200, CV_16UC1, cv::Scalar(0)), {}, {}), Error);
}

}  // namespace
}  // namespace arthro::authoring
