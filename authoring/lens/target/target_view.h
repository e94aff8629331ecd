// A flat calibration target as one raw picture shows it: points of a square lattice, each with its
// whole-numbered place (column i, row j) and its pixel (centre of the top-left pixel is the
// origin). The lattice is right-handed as the picture is: turning from +i to +j is clockwise on the
// screen. Its origin is arbitrary, since the target's pose takes it up.
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
  std::string reason;     // why there is none, as a sentence without its first capital
};

// "line grid", "chessboard", "dot grid" or "none".
const char* WordOf(TargetKind kind);

}  // namespace arthro::authoring
