#include "authoring/phantom/clip/board.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "authoring/phantom/clip/equisolid.h"
#include "authoring/phantom/clip/plane_noise.h"
#include "simulation/core/error.h"

namespace arthro::authoring {
namespace {

constexpr int kSubpixels = 4;       // per side
constexpr double kLine = 0.055;     // half the width of a line, in spacings
constexpr double kDot = 0.2;        // radius of a dot
constexpr double kPerWindow = 0.1;  // spacings are a tenth of the distance to the board

double ToNearest(double x) { return std::abs(x - std::round(x)); }

// Brightness from 0 (black) to 1 (white); (u, v) in spacings from the middle.
double PaperAt(const Board& board, double u, double v) {
  switch (board.kind) {
    case BoardKind::kLines:
      return std::min(ToNearest(u), ToNearest(v)) < kLine ? 0.1 : 1.0;
    case BoardKind::kDots:
      return std::hypot(u - std::round(u), v - std::round(v)) < kDot ? 0.1 : 1.0;
    case BoardKind::kChess: {
      const double x = u + (board.columns + 1) / 2.0, y = v + (board.rows + 1) / 2.0;
      if (x < 0 || y < 0 || x > board.columns + 1 || y > board.rows + 1) return 0.96;
      return (static_cast<int>(x) + static_cast<int>(y)) % 2 == 0 ? 0.96 : 0.06;
    }
  }
  return 0;
}

}  // namespace

cv::Point2d BoardPoint(const Board& board, int column, int row) {
  if (board.kind != BoardKind::kChess) return {column * board.spacing, row * board.spacing};
  return {(column - (board.columns - 1) / 2.0) * board.spacing,
          (row - (board.rows - 1) / 2.0) * board.spacing};
}

cv::Point2d RawFromBoard(const Lens& lens, const ScopePose& pose, const cv::Point2d& x_in_board) {
  const cv::Vec3d in_plane((x_in_board.x - pose.at.x), (x_in_board.y - pose.at.y), pose.distance);
  return EquisolidPixel(lens, pose.plane_from_camera.t() * in_plane);
}

cv::Mat DrawBoard(const Lens& lens, const Board& board, const ScopePose& pose, int seed) {
  if (lens.model != LensModel::kEquisolid || lens.width < 1 || lens.height < 1 ||
      !(lens.focal_px > 0) || !(board.spacing > 0) || !(pose.distance > 0))
    throw Error(Code::kBadArgument,
                "a board is drawn through an equisolid lens, with a spacing and at a distance that "
                "are above 0");
  const cv::Matx33d board_from_ray = PanoramaFromRay(pose);
  const double radius = lens.circle.r > 0 ? lens.circle.r : std::hypot(lens.width, lens.height);
  Random random(static_cast<std::uint64_t>(seed) * 4099 + 33);
  cv::Mat picture = cv::Mat::zeros(lens.height, lens.width, CV_8U);
  // Intersections of the rays of a row's pixel corners with the board. Linear interpolation between
  // them is exact to less than a thousandth of a pixel.
  const auto corners = [&](double y) {
    std::vector<cv::Vec3d> row;
    for (int x = 0; x <= lens.width; ++x)
      row.push_back(board_from_ray * EquisolidRay(lens, x - 0.5, y));
    return row;
  };
  std::vector<cv::Vec3d> above, below = corners(-0.5);
  for (int y = 0; y < lens.height; ++y) {
    above = std::exchange(below, corners(y + 0.5));
    for (int x = 0; x < lens.width; ++x) {
      const double away = std::hypot(x - lens.cx, y - lens.cy);
      const double cover = std::clamp(radius + 0.5 - away, 0.0, 1.0);
      if (cover <= 0) continue;
      const auto k = static_cast<std::size_t>(x);
      double sum = 0;
      for (int j = 0; j < kSubpixels; ++j)
        for (int i = 0; i < kSubpixels; ++i) {
          const double u = (i + 0.5) / kSubpixels, v = (j + 0.5) / kSubpixels;
          const cv::Vec3d hit = (1 - v) * ((1 - u) * above[k] + u * above[k + 1]) +
                                v * ((1 - u) * below[k] + u * below[k + 1]);
          if (hit[2] > 1e-6)
            sum += PaperAt(board, hit[0] / hit[2] / board.spacing, hit[1] / hit[2] / board.spacing);
        }
      const double share = away / radius;
      const double light = sum / (kSubpixels * kSubpixels) * (1 - board.vignette * share * share) +
                           board.noise * NormalOf(random.Next());
      picture.at<std::uint8_t>(y, x) =
          static_cast<std::uint8_t>(255 * std::clamp(light, 0.0, 1.0) * cover + 0.5);
    }
  }
  return picture;
}

std::vector<ScopePose> BoardPoses(const Lens& lens, const Board& board) {
  constexpr double kTiltX[] = {0, 22, -20, 12, -8, 26}, kTiltY[] = {0, -10, 16, 24, -26, 6};
  constexpr double kRoll[] = {0, 4, -6, 9, 14, -20}, kFar[] = {1, 0.9, 1.05, 0.95, 0.85, 1};
  // A chessboard must fit into the window; the other boards are unbounded.
  const double half_view = lens.circle.r > 0
                               ? 2 * std::asin(std::min(1.0, lens.circle.r / (2 * lens.focal_px)))
                               : lens.field_of_view / 2;
  double distance = board.spacing / kPerWindow;
  if (board.kind == BoardKind::kChess)
    distance = std::max(distance, 0.62 * board.spacing * std::hypot(board.columns, board.rows) /
                                      std::tan(std::min(half_view, 1.2)));
  std::vector<ScopePose> poses;
  for (int i = 0; i < 6; ++i) {
    ScopePose pose;
    pose.plane_from_camera = RotationOf(
        RadiansFromDegrees(kTiltX[i]), RadiansFromDegrees(kTiltY[i]), RadiansFromDegrees(kRoll[i]));
    pose.distance = distance * kFar[i];
    // The axis meets the board a little off its middle.
    const cv::Matx33d& r = pose.plane_from_camera;
    pose.at = cv::Point2d(0.3 * std::sin(2.0 * i), 0.3 * std::sin(3.0 * i)) * board.spacing -
              cv::Point2d(r(0, 2), r(1, 2)) * (pose.distance / r(2, 2));
    poses.push_back(pose);
  }
  return poses;
}

}  // namespace arthro::authoring
