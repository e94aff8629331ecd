// View of a flat calibration target in one raw picture: points of a square lattice, each with its
// integer place (column i, row j) and its pixel (origin at the centre of the top-left pixel). The
// lattice is right-handed like the picture: turning from +i to +j is clockwise on the screen. Its
// origin is arbitrary, since the target's pose absorbs it.
#pragma once

#include <string>
#include <vector>

#include <opencv2/core.hpp>

namespace arthro::authoring {

enum class TargetKind { kNone, kLines, kChessboard, kDots };

struct LatticePoint {
  cv::Point2d pixel;
  int i = 0, j = 0;
};

struct TargetView {
  TargetKind kind = TargetKind::kNone;
  std::vector<LatticePoint> points;
  double dot_radius = 0;  // dots only: in lattice steps
  std::string reason;     // why there is no target, as a sentence without its first capital
};

// "line grid", "chessboard", "dot grid" or "none".
const char* ToString(TargetKind kind);

}  // namespace arthro::authoring
