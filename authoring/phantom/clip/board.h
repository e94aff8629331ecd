// Calibration pictures with known poses: lines, a chessboard or dots on a flat board, seen through
// an equisolid lens. The origin of the board's plane is its middle, x right, y down, in the unit of
// `spacing`; poses are as for the plane of a clip.
#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "authoring/phantom/clip/clip_path.h"
#include "simulation/scene/lens.h"

namespace arthro::authoring {

enum class BoardKind { kLines, kChess, kDots };

struct Board {
  BoardKind kind = BoardKind::kLines;
  double spacing = 0.001;     // m, between lines, corners or dots
  int columns = 9, rows = 7;  // inner corners of a chessboard; lines and dots are unbounded
  double noise = 0.008;
  double vignette = 0.4;
};

// CV_8UC1, as the camera delivers it. The same seed gives the same noise.
cv::Mat DrawBoard(const Lens& lens, const Board& board, const ScopePose& pose, int seed = 1);

// Raw pixel of a point of the board.
cv::Point2d RawFromBoard(const Lens& lens, const ScopePose& pose, const cv::Point2d& x_in_board);

// Position of a crossing, corner or dot, counted from the board's middle. The chessboard's inner
// corners are at half steps when their number is even.
cv::Point2d BoardPoint(const Board& board, int column, int row);

// Six poses that show the board from different sides and fill the window. The first `first` poses
// are frontal; the others are tilted by up to 26 degrees.
std::vector<ScopePose> BoardPoses(const Lens& lens, const Board& board);

}  // namespace arthro::authoring
