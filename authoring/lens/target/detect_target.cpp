#include "authoring/lens/target/detect_target.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include "authoring/lens/target/lattice.h"
#include "authoring/lens/target/target_points.h"
#include "simulation/core/error.h"

namespace arthro::authoring {
namespace {

constexpr std::array<TargetKind, 3> kKinds = {TargetKind::kChessboard, TargetKind::kLines,
                                              TargetKind::kDots};
constexpr int kFewestCells = 4;

double MedianOf(std::vector<double> values) {
  const auto middle = values.begin() + values.size() / 2;
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// Brightness at the places that distinguish the kinds of target, from 0 (darkest nearby) to 1
// (brightest nearby): at a lattice point, half way between two, in the directions i and j, and in
// the cells of either colour of a chessboard.
struct CellLook {
  double point, between_i, between_j, cell_even, cell_odd;
};

// Takes medians over the cells, so that highlights and shadows on some of them have no effect.
std::optional<CellLook> LookOf(const cv::Mat& picture, const Lattice& lattice) {
  std::vector<double> point, between_i, between_j, cells[2];
  const auto At = [&](const cv::Point2d& p) {
    const int x = std::clamp(static_cast<int>(std::lround(p.x)), 0, picture.cols - 1);
    const int y = std::clamp(static_cast<int>(std::lround(p.y)), 0, picture.rows - 1);
    return static_cast<double>(picture.at<float>(y, x));
  };
  for (const auto& [place, p] : lattice) {
    const auto& [i, j] = place;
    const auto right = lattice.find({i + 1, j}), down = lattice.find({i, j + 1}),
               far = lattice.find({i + 1, j + 1}), left = lattice.find({i - 1, j}),
               low = lattice.find({i - 1, j + 1});
    if (right == lattice.end() || down == lattice.end() || far == lattice.end() ||
        left == lattice.end() || low == lattice.end())
      continue;
    // Two neighbouring cells: one of either colour, under nearly the same light.
    const double here = 0.25 * (At(p) + At(right->second) + At(down->second) + At(far->second));
    const double middle_i = At(0.5 * (p + right->second)), middle_j = At(0.5 * (p + down->second));
    const double cell = At(0.25 * (p + right->second + down->second + far->second));
    const double other = At(0.25 * (p + left->second + down->second + low->second));
    const double dark = std::min({here, middle_i, middle_j, cell, other});
    const double bright = std::max({here, middle_i, middle_j, cell, other});
    if (!(bright - dark > 0.03)) continue;  // too little contrast to judge
    const auto Share = [&](double value) { return (value - dark) / (bright - dark); };
    const int colour = (i + j) & 1;
    point.push_back(Share(here));
    between_i.push_back(Share(middle_i));
    between_j.push_back(Share(middle_j));
    cells[colour].push_back(Share(cell));
    cells[1 - colour].push_back(Share(other));
  }
  if (point.size() < kFewestCells) return std::nullopt;
  return CellLook{MedianOf(point), MedianOf(between_i), MedianOf(between_j), MedianOf(cells[0]),
                  MedianOf(cells[1])};
}

bool Agrees(TargetKind kind, const CellLook& look) {
  const double low = std::min(look.cell_even, look.cell_odd),
               high = std::max(look.cell_even, look.cell_odd);
  const double darker = std::min(look.between_i, look.between_j),
               brighter = std::max(look.between_i, look.between_j);
  switch (kind) {
    case TargetKind::kChessboard:  // the points and edges lie between black and white
      return high - low > 0.7 && darker > 0.15 && brighter < 0.85 && look.point > 0.1 &&
             look.point < 0.9;
    case TargetKind::kLines:  // dark along the edges of both directions
      return low > 0.75 && brighter < 0.6 && look.point < 0.35;
    case TargetKind::kDots:  // dark at the points only
      return low > 0.75 && darker > 0.75 && look.point < 0.35;
    case TargetKind::kNone:
      break;
  }
  return false;
}

bool Wanted(TargetKind kind, TargetChoice choice) {
  return choice == TargetChoice::kAny ||
         (choice == TargetChoice::kLines && kind == TargetKind::kLines) ||
         (choice == TargetChoice::kChessboard && kind == TargetKind::kChessboard) ||
         (choice == TargetChoice::kDots && kind == TargetKind::kDots);
}

// Dot radius in lattice steps, from the dark share of a cell.
double DotRadius(const cv::Mat& picture, const Lattice& lattice) {
  std::vector<double> radii;
  for (const auto& [place, p] : lattice) {
    const auto right = lattice.find({place.first + 1, place.second}),
               down = lattice.find({place.first, place.second + 1});
    if (right == lattice.end() || down == lattice.end()) continue;
    const double cell = std::abs((right->second - p).cross(down->second - p));
    const double reach = 0.45 * StepAt(lattice, place);
    if (reach < 5 || p.x < reach + 1 || p.y < reach + 1 || p.x > picture.cols - 2 - reach ||
        p.y > picture.rows - 2 - reach)
      continue;
    const cv::Rect window(cvFloor(p.x - reach), cvFloor(p.y - reach), cvCeil(2 * reach),
                          cvCeil(2 * reach));
    double dark = 0, bright = 0;
    cv::minMaxLoc(picture(window), &dark, &bright);
    const double area = cv::countNonZero(picture(window) < 0.5 * (dark + bright));
    radii.push_back(std::sqrt(area / (CV_PI * cell)));
  }
  return radii.empty() ? 0 : MedianOf(radii);
}

// Lattice with exact points. Points too near to the rim or to one another are left out.
Lattice Refined(const cv::Mat& picture, TargetKind kind, const Lattice& rough,
                const LensCircle& circle, double smallest_step) {
  const PointRefiner refiner(picture, kind);
  Lattice refined;
  for (const auto& [place, p] : rough) {
    const double step = StepAt(rough, place);
    if (!(step >= smallest_step)) continue;
    const double share = kind == TargetKind::kDots ? 0.48 : 0.45;
    const double reach = std::clamp(share * step, 2.5, kind == TargetKind::kDots ? 40.0 : 16.0);
    if (circle.r > 0 && std::hypot(p.x - circle.cx, p.y - circle.cy) > circle.r - reach - 2)
      continue;
    const cv::Point2d exact = refiner.Refine(p, reach);
    if (cv::norm(exact - p) < 0.25 * step) refined[place] = exact;
  }
  PruneLattice(refined, 0.2);
  return refined;
}

cv::Mat GreyOf(const cv::Mat& raw) {
  if (raw.empty() || raw.depth() != CV_8U || (raw.channels() != 1 && raw.channels() != 3))
    throw Error(Code::kBadImage,
                "a calibration picture must be 8-bit, with one or three channels; convert it");
  cv::Mat grey = raw, picture;
  if (raw.channels() == 3) cv::cvtColor(raw, grey, cv::COLOR_RGB2GRAY);
  grey.convertTo(picture, CV_32F, 1.0 / 255);
  return picture;
}

}  // namespace

TargetView DetectTarget(const cv::Mat& raw, const LensCircle& circle,
                        const DetectOptions& options) {
  TargetView view;
  constexpr int kSmallest = 64;
  if (raw.cols < kSmallest || raw.rows < kSmallest) {
    view.reason = fmt::format("it is only {} x {} px", raw.cols, raw.rows);
    return view;
  }
  const cv::Mat picture = GreyOf(raw);
  cv::Mat calm;
  cv::GaussianBlur(picture, calm, {}, 0.7);
  // Small lattices need a fine scale, blurred or noisy ones a coarse one.
  const double size = std::clamp(std::min(raw.cols, raw.rows) / 640.0, 0.6, 4.0);
  Lattice best;
  std::size_t rough_most = 0;
  for (const TargetKind kind : kKinds) {
    if (!Wanted(kind, options.target)) continue;
    for (const double sigma : {1.2, 2.2, 4.0}) {
      const auto looks_like_it = [&](const Lattice& lattice) {
        const auto look = LookOf(calm, lattice);
        return look && Agrees(kind, *look);
      };
      const Lattice rough = GrowLattice(CandidatePoints(picture, kind, std::max(1.0, size * sigma)),
                                        picture.size(), options.smallest_step, looks_like_it);
      if (rough.empty()) continue;
      rough_most = std::max(rough_most, rough.size());
      Lattice refined = Refined(picture, kind, rough, circle, options.smallest_step);
      if (refined.size() <= best.size()) continue;
      best = std::move(refined);
      view.kind = kind;
    }
  }
  if (static_cast<int>(best.size()) < options.fewest_points) {
    view.kind = TargetKind::kNone;
    const std::size_t most = std::max(rough_most, best.size());
    view.reason =
        most == 0 ? "no line grid, chessboard or dot grid was found in it"
                  : fmt::format("only {} points of a target could be made out in it, of {} needed",
                                best.size(), options.fewest_points);
    return view;
  }
  for (const auto& [place, p] : best) view.points.push_back({p, place.first, place.second});
  if (view.kind == TargetKind::kDots) view.dot_radius = DotRadius(calm, best);
  return view;
}

}  // namespace arthro::authoring
