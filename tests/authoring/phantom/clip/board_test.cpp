// Calibration pictures: every mark is drawn at the position that the pose gives.
#include "authoring/phantom/clip/board.h"

#include <cmath>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "simulation/core/error.h"
#include "simulation/core/units.h"

namespace arthro::authoring {
namespace {

Lens SmallLens() {
  Lens lens;
  lens.width = 400;
  lens.height = 320;
  lens.circle = {201, 158.5, 150};
  lens.cx = lens.circle.cx;
  lens.cy = lens.circle.cy;
  lens.field_of_view = RadiansFromDegrees(90);
  lens.focal_px = 150 / (2 * std::sin(lens.field_of_view / 4));
  return lens;
}

TEST(Board, DotsHaveTheirMiddlesWhereTheirPointsAre) {
  const Lens lens = SmallLens();
  Board board;
  board.kind = BoardKind::kDots;
  board.noise = board.vignette = 0;
  for (const ScopePose& pose : BoardPoses(lens, board)) {
    const cv::Mat picture = DrawBoard(lens, board, pose);
    for (const auto& [column, row] : {std::pair{0, 0}, {2, 1}, {-2, 2}, {1, -3}}) {
      const cv::Point2d at = RawFromBoard(lens, pose, BoardPoint(board, column, row));
      // Centroid of darkness within half a spacing.
      const cv::Point2d beside = RawFromBoard(lens, pose, BoardPoint(board, column + 1, row));
      const double reach = 0.4 * cv::norm(beside - at);
      double sum = 0, x = 0, y = 0;
      for (int v = static_cast<int>(at.y - reach); v <= at.y + reach; ++v)
        for (int u = static_cast<int>(at.x - reach); u <= at.x + reach; ++u) {
          const double dark = 255 - picture.at<std::uint8_t>(v, u);
          sum += dark;
          x += dark * u;
          y += dark * v;
        }
      ASSERT_GT(sum, 0);
      // A dot of about 3 px radius in perspective: its centroid is a few hundredths of a pixel off
      // the image of its centre, and so is the drawing by 4 x 4 samples.
      EXPECT_NEAR(x / sum, at.x, 0.1);
      EXPECT_NEAR(y / sum, at.y, 0.1);
    }
  }
}

TEST(Board, ChessCornersAreSaddles) {
  const Lens lens = SmallLens();
  Board board;
  board.kind = BoardKind::kChess;
  board.noise = 0;
  const ScopePose pose = BoardPoses(lens, board)[3];
  const cv::Mat picture = DrawBoard(lens, board, pose);
  std::vector<cv::Point2f> corners;
  for (int row = 0; row < board.rows; ++row)
    for (int column = 0; column < board.columns; ++column)
      corners.emplace_back(RawFromBoard(lens, pose, BoardPoint(board, column, row)));
  auto refined = corners;
  cv::cornerSubPix(picture, refined, {4, 4}, {-1, -1},
                   {cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 40, 0.001});
  // Accuracy of corner detection for squares of 10 px that are distorted by the lens.
  double sum = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    EXPECT_LT(cv::norm(refined[i] - corners[i]), 0.35) << i;
    sum += cv::norm(refined[i] - corners[i]);
  }
  EXPECT_LT(sum / static_cast<double>(corners.size()), 0.1);
}

TEST(Board, LinesAreDarkAndTheSameEveryTime) {
  const Lens lens = SmallLens();
  const Board board;
  const ScopePose pose = BoardPoses(lens, board)[0];
  const cv::Mat picture = DrawBoard(lens, board, pose, 5);
  const auto at = [&](double column, double row) {
    return int(picture.at<std::uint8_t>(
        cv::Point(RawFromBoard(lens, pose, {column * board.spacing, row * board.spacing}))));
  };
  EXPECT_LT(at(1, 0.5), 120);
  EXPECT_GT(at(1.5, 0.5), 180);
  EXPECT_EQ(cv::norm(picture, DrawBoard(lens, board, pose, 5), cv::NORM_INF), 0);
  EXPECT_GT(cv::norm(picture, DrawBoard(lens, board, pose, 6), cv::NORM_INF), 0);
}

TEST(Board, RefusesNonsense) {
  Lens lens = SmallLens();
  EXPECT_THROW(DrawBoard(lens, Board{}, ScopePose{}), Error);
  lens.model = LensModel::kPinhole;
  EXPECT_THROW(DrawBoard(lens, Board{}, BoardPoses(SmallLens(), Board{})[0]), Error);
}

}  // namespace
}  // namespace arthro::authoring
