#include "authoring/phantom/clip/clip_path.h"

#include <algorithm>
#include <cmath>

#include "authoring/phantom/shape/noise.h"
#include "simulation/core/units.h"

namespace arthro::authoring {
namespace {

constexpr int kRows = 3;

// Position at a share of the path along rows to and fro; rows `length` long and `gap` apart.
cv::Point2d AlongRows(double share, double length, double gap) {
  const double total = kRows * length + (kRows - 1) * gap;
  double s = std::clamp(share, 0.0, 1.0) * total;
  for (int row = 0; row < kRows; ++row) {
    const double way = row % 2 ? -1.0 : 1.0, y = (row - (kRows - 1) / 2.0) * gap;
    if (s <= length) return {way * (s - length / 2), y};
    s -= length;
    if (row + 1 < kRows) {
      if (s <= gap) return {way * length / 2, y + s};
      s -= gap;
    }
  }
  return {(kRows % 2 ? 1.0 : -1.0) * length / 2, (kRows - 1) / 2.0 * gap};
}

}  // namespace

cv::Matx33d RotationOf(double x, double y, double z) {
  const double cx = std::cos(x), sx = std::sin(x), cy = std::cos(y), sy = std::sin(y),
               cz = std::cos(z), sz = std::sin(z);
  return cv::Matx33d(cz, -sz, 0, sz, cz, 0, 0, 0, 1) * cv::Matx33d(cy, 0, sy, 0, 1, 0, -sy, 0, cy) *
         cv::Matx33d(1, 0, 0, 0, cx, -sx, 0, sx, cx);
}

cv::Matx33d PanoramaFromRay(const ScopePose& pose) {
  return cv::Matx33d(pose.distance, 0, pose.at.x, 0, pose.distance, pose.at.y, 0, 0, 1) *
         pose.plane_from_camera;
}

double ClipPathway::Wave::At(double t) const {
  return amplitude * (std::sin(t * slow + phase) + 0.5 * std::sin(t * fast + phase_fast)) / 1.3;
}

ClipPathway::ClipPathway(const ClipOptions& options, cv::Size2d world, double radius, double focal)
    : options_(options), radius_(radius), focal_(focal) {
  Random random(static_cast<std::uint64_t>(options.seed) * 977 + 22);
  const double foot = focal * std::tan(options.field_of_view / 2) * (1 + options.zoom) *
                          std::max(1.0, options.zoom_sweep) * 1.12 +
                      0.13 * radius;
  jump_ = 0.5 * options.jump * radius *
          cv::Point2d(0.8222, 0.5692);  // half of the jump; unit direction
  reach_ = {std::max(0.0, world.width / 2 - foot - jump_.x),
            std::max(0.0, world.height / 2 - foot - jump_.y)};
  const double away = std::min(0.2 * radius, 0.1 * std::min(world.width, world.height));
  centre_ = {(world.width - 1) / 2 + random.Uniform(-away, away),
             (world.height - 1) / 2 + random.Uniform(-away, away)};
  const auto wave = [&](double amplitude, double period) {
    Wave w;
    w.amplitude = options.path == ClipPath::kStill ? 0.0 : amplitude;
    w.slow = kRadianPerTurn * random.Uniform(0.6, 1.4) / period;
    w.fast = 2.1 * kRadianPerTurn * random.Uniform(0.6, 1.4) / period;
    w.phase = random.Uniform(0, kRadianPerTurn);
    w.phase_fast = random.Uniform(0, kRadianPerTurn);
    return w;
  };
  tilt_x_ = wave(options.tilt, 24);
  tilt_y_ = wave(options.tilt, 31);
  turn_ = wave(options.roll, 45);
  zoom_ = wave(options.zoom, 37);
  start_ = random.Uniform(0, kRadianPerTurn);
  for (double& phase : phase_) phase = random.Uniform(0, kRadianPerTurn);
  if (options.path == ClipPath::kWander) {
    // Slows down so that the mean step has the requested length, if the plane has room for it.
    double length = 0;
    const int pieces = 400;
    for (int i = 0; i < pieces; ++i) {
      const auto at = [&](int k) {
        return PlaceAt(static_cast<double>(k) / pieces * options.frames);
      };
      length += cv::norm(at(i + 1) - at(i));
    }
    wander_scale_ = std::min(1.0, options.step * radius * options.frames / std::max(length, 1e-9));
  }
}

cv::Point2d ClipPathway::PlaceAt(double t) const {
  const int n = options_.frames;
  const double share = t / std::max(1, n - 1), length = options_.step * radius_ * n;
  switch (options_.path) {
    case ClipPath::kStill:
      return {0, 0};
    case ClipPath::kLoop: {
      const double flat = std::min(1.0, reach_.y / std::max(1.0, reach_.x));
      const double r = std::min(length / (kRadianPerTurn * 0.85), reach_.x);
      const double a = kRadianPerTurn * share + start_;
      return {r * std::cos(a), std::min(r * flat * 1.1, reach_.y) * std::sin(a)};
    }
    case ClipPath::kStrip: {
      const double s = share - 0.5;
      return {std::min(length, 2 * reach_.x) * s,
              std::min(0.4 * radius_, reach_.y) * std::sin(4 * s)};
    }
    case ClipPath::kRaster: {
      const double room = std::max(length - (kRows - 1) * 1.27 * radius_, length / 3);
      const double row = std::min(room / kRows, 2 * reach_.x);
      const double gap = std::min((length - kRows * row) / (kRows - 1), reach_.y);
      // Rounded at the ends of the rows.
      const auto at = [&](double when) { return AlongRows(when / std::max(1, n - 1), row, gap); };
      return (at(t - 0.7) + at(t) + at(t + 0.7)) * (1.0 / 3);
    }
    case ClipPath::kWander: {
      const double a = kRadianPerTurn * t / std::max(1, n);
      return wander_scale_ *
             cv::Point2d(
                 reach_.x * (0.55 * std::sin(a + phase_[0]) + 0.3 * std::sin(3 * a + phase_[1])),
                 reach_.y * (0.55 * std::sin(2 * a + phase_[2]) + 0.3 * std::sin(a + phase_[3])));
    }
  }
  return {};
}

ScopePose ClipPathway::At(double t, int frame) const {
  if (options_.path == ClipPath::kStill) t = frame = 0;
  const double share = t / std::max(1, options_.frames - 1);
  const bool has_jumped = options_.jump > 0 && frame >= options_.frames / 2;
  const cv::Point2d place = PlaceAt(t) + (has_jumped ? jump_ : -jump_);
  double turn = turn_.At(t) + options_.roll_sweep * share;
  if (has_jumped) turn += RadiansFromDegrees(20);
  ScopePose pose;
  pose.at = centre_ + place;
  pose.distance = focal_ * (1 + zoom_.At(t)) * std::pow(options_.zoom_sweep, share);
  pose.plane_from_camera = RotationOf(tilt_x_.At(t), tilt_y_.At(t), turn);
  return pose;
}

}  // namespace arthro::authoring
