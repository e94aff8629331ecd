#include "tests/support/relief/cavity_clip.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include <Eigen/Dense>
#include <fmt/format.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

namespace arthro::test {
namespace {

using Eigen::Vector3d;

constexpr double kSphere = 0.045;  // m

// Smooth value noise in three dimensions, 0 to 1.
double Noise(const Vector3d& at, unsigned salt) {
  const auto lattice = [salt](int x, int y, int z) {
    std::uint32_t h = static_cast<std::uint32_t>(x) * 0x8da6b343u ^
                      static_cast<std::uint32_t>(y) * 0xd8163841u ^
                      static_cast<std::uint32_t>(z) * 0xcb1ab31fu ^ salt * 0x9e3779b9u;
    h = (h ^ (h >> 15)) * 0x2c1b3c6du;
    h = (h ^ (h >> 12)) * 0x297a2d39u;
    return ((h ^ (h >> 15)) & 0xffffff) / double(0xffffff);
  };
  const Vector3d floor = at.array().floor();
  const int x = static_cast<int>(floor.x()), y = static_cast<int>(floor.y()),
            z = static_cast<int>(floor.z());
  const Vector3d t = at - floor;
  const auto smooth = [](double s) { return s * s * (3 - 2 * s); };
  double value = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const int i = corner & 1, j = (corner >> 1) & 1, k = corner >> 2;
    value += (i ? smooth(t.x()) : 1 - smooth(t.x())) * (j ? smooth(t.y()) : 1 - smooth(t.y())) *
             (k ? smooth(t.z()) : 1 - smooth(t.z())) * lattice(x + i, y + j, z + k);
  }
  return value;
}

// Tissue with detail from 1.5 mm up, 0 to 1.
double Albedo(const Vector3d& point) {
  return 0.45 * Noise(point * 250, 1) + 0.35 * Noise(point * 500, 2) + 0.2 * Noise(point * 900, 3);
}

}  // namespace

double CavityRange(const Vector3d& from, const Vector3d& ray, double fold) {
  double near = 0, far = 2 * kSphere;
  constexpr int kSteps = 60;
  for (int i = 1; i <= kSteps; ++i) {
    const double t = 2 * kSphere * i / kSteps;
    const Vector3d p = from + t * ray;
    if (p.norm() < CavityRadius(p.normalized(), fold)) continue;
    far = t, near = 2 * kSphere * (i - 1) / kSteps;
    break;
  }
  for (int i = 0; i < 25; ++i) {
    const double t = 0.5 * (near + far);
    const Vector3d p = from + t * ray;
    (p.norm() < CavityRadius(p.normalized(), fold) ? near : far) = t;
  }
  return 0.5 * (near + far);
}

double CavityRadius(const Vector3d& direction, double fold) {
  struct Bump {
    Vector3d at;
    double height, width;
  };
  static const std::array bumps = {Bump{Vector3d(0.35, 0.1, 1).normalized(), 0.010, 0.35},
                                   Bump{Vector3d(-0.4, 0.5, 1).normalized(), 0.008, 0.4},
                                   Bump{Vector3d(-0.2, -0.5, 1).normalized(), 0.006, 0.3}};
  double radius = kSphere;
  for (const Bump& bump : bumps)
    radius -=
        bump.height * std::exp(-(direction - bump.at).squaredNorm() / (bump.width * bump.width));
  if (fold > 0) {
    constexpr double kEdge = 0.008, kFades = 0.5;  // width of the edge, and of the slope behind it
    const double beyond = direction.x() / std::max(0.1, direction.z()) - kFoldEdge;
    radius -= fold / (1 + std::exp(-beyond / kEdge)) * std::exp(-std::max(0.0, beyond) / kFades);
  }
  return radius;
}

Lens CavityLens() {
  Lens lens;
  lens.model = LensModel::kEquisolid;
  lens.width = 240;
  lens.height = 200;
  lens.cx = 120.3;
  lens.cy = 99.1;
  lens.circle = {lens.cx, lens.cy, 96};
  lens.field_of_view = CV_PI / 2;
  lens.focal_px = lens.circle.r / (2 * std::sin(lens.field_of_view / 4));
  return lens;
}

Lens CavityLensFile(const CavityOptions& options) {
  Lens lens = CavityLens();
  lens.focal_px *= options.focal_factor;
  return lens;
}

namespace {

// The scope at a time of the clip, 0 to 1.
struct ScopeAt {
  double latitude, longitude, depth, roll, head_turn;
};

ScopeAt ScopeOf(const CavityOptions& options, double t) {
  // Another path for another clip.
  const double phase = options.two_clips && t > 0.5 ? 2.1 : 0;
  ScopeAt at{0.22 * std::sin(5 * t + 0.4 + phase), 0.22 * std::cos(4 * t + phase),
             0.016 + 0.003 * std::sin(3 * t + phase), options.roll * std::sin(4 * t + 1 + phase),
             0};
  if (options.motion != ScopeMotion::kSweep) at = {0.1, -0.05, 0.016, at.roll, 0};
  if (options.motion == ScopeMotion::kStill) at.roll = 0.2;
  if (options.motion == ScopeMotion::kPlunge) at.roll = 0.2, at.depth = 0.011 + 0.01 * t;
  at.head_turn = options.head_upright ? -at.roll : options.head_turn;
  return at;
}

authoring::CameraPose PoseAt(const CavityOptions& options, double t) {
  const auto [latitude, longitude, depth, roll, head_turn] = ScopeOf(options, t);
  const Vector3d u(std::cos(latitude) * std::sin(longitude), -std::sin(latitude),
                   std::cos(latitude) * std::cos(longitude));
  const Vector3d north(-std::sin(latitude) * std::sin(longitude), -std::cos(latitude),
                       -std::sin(latitude) * std::cos(longitude)),
      east(std::cos(longitude), 0, -std::sin(longitude));
  const Vector3d aside = std::cos(roll) * north + std::sin(roll) * east;
  const Vector3d view = std::cos(kViewAngle) * u + std::sin(kViewAngle) * aside;
  const Vector3d up = std::cos(kViewAngle) * aside - std::sin(kViewAngle) * u;
  const Vector3d right = view.cross(up);
  const double c = std::cos(head_turn), s = std::sin(head_turn);
  authoring::CameraPose pose;
  pose.world_from_camera.col(0) = c * right - s * up;
  pose.world_from_camera.col(1) = -(c * up + s * right);
  pose.world_from_camera.col(2) = view;
  pose.centre = depth * u;
  if (t > 0.5) pose.centre += options.slide * Vector3d(0.8, 0.6, 0);
  return pose;
}

double TimeOf(const CavityOptions& options, double frame) {
  return frame / std::max(1, options.frames - 1);
}

}  // namespace

std::vector<double> CavityHeadTurns(const CavityOptions& options) {
  std::vector<double> turns;
  for (int i = 0; i < options.frames; ++i)
    turns.push_back(ScopeOf(options, TimeOf(options, i)).head_turn);
  return turns;
}

std::vector<authoring::CameraPose> CavityPoses(const CavityOptions& options) {
  std::vector<authoring::CameraPose> poses;
  for (int i = 0; i < options.frames; ++i) poses.push_back(PoseAt(options, TimeOf(options, i)));
  return poses;
}

double MedianInsertion(const std::vector<authoring::CameraPose>& poses) {
  std::vector<double> depths;
  for (const auto& pose : poses) depths.push_back(pose.centre.norm());
  std::sort(depths.begin(), depths.end());
  return depths[depths.size() / 2];
}

std::vector<authoring::Track> CavityTracks(const CavityOptions& options) {
  const auto poses = CavityPoses(options);
  const Lens lens = CavityLens(), file = CavityLensFile(options);
  std::mt19937 random(options.seed);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::vector<authoring::Track> tracks;
  for (int i = 0; i < options.points; ++i) {
    const Vector3d direction = Vector3d(uniform(random), uniform(random), 0.8).normalized();
    const double radius = CavityRadius(direction, options.fold);
    cv::Mat look(1, 128, CV_8U);
    for (int k = 0; k < look.cols; ++k)
      look.at<std::uint8_t>(0, k) = static_cast<std::uint8_t>(random() % 256);
    // One track per clip, since flow does not pass from one clip to the next.
    const int clips = options.two_clips ? 2 : 1;
    for (int clip = 0; clip < clips; ++clip) {
      authoring::Track track;
      for (int f = clip * options.frames / clips; f < (clip + 1) * options.frames / clips; ++f) {
        const double swell =
            direction.x() > 0 ? options.breath * std::sin(2 * CV_PI * f / 11.0) : 0.0;
        Vector3d point = direction * (radius - swell);
        if (clip == 1 && options.elsewhere) point.x() *= -1, point.y() *= -0.9;
        const Vector3d local = poses[static_cast<std::size_t>(f)].InCamera(point);
        if (local.z() < 0.76 * local.norm()) continue;  // outside the round window
        const auto pixel = PixelFromRay(lens, {local.x(), local.y(), local.z()});
        if (!pixel) continue;
        Eigen::Vector2d seen(pixel->x + options.noise_px * normal(random),
                             pixel->y + options.noise_px * normal(random));
        if (0.5 * (1 + uniform(random)) < options.outliers)
          seen += Eigen::Vector2d(20 * uniform(random), 20 * uniform(random));
        const auto ray = RayFromPixel(file, {seen.x(), seen.y()});
        if (ray) track.seen.push_back({f, seen, {ray->x, ray->y, ray->z}});
      }
      if (clip == 1 && options.elsewhere)
        for (int k = 0; k < look.cols; ++k)
          look.at<std::uint8_t>(0, k) = static_cast<std::uint8_t>(random() % 256);
      track.descriptors = look.clone();
      if (track.seen.size() >= 2) tracks.push_back(track);
    }
  }
  return tracks;
}

namespace {

// Light that a pose sends back along a ray, 0 to about 1 per channel.
cv::Vec3d LightFrom(const CavityOptions& options, const authoring::CameraPose& pose,
                    const Vector3d& ray_in_camera) {
  const Vector3d d = pose.world_from_camera * ray_in_camera;
  const double range = CavityRange(pose.centre, d, options.fold);
  const double light = std::min(1.6, std::pow(0.022 / range, 1.2));
  const Vector3d point = pose.centre + range * d;
  double white = 0;
  if (options.glint > 0) {
    // Highlights that pass over the tissue when the tip moves.
    const double spot = Noise(point * 350 + pose.centre * 900, 7);
    white = options.glint * std::clamp((spot - 0.72) / 0.1, 0.0, 1.0);
  }
  const double grey = light * (0.625 + options.contrast * (Albedo(point) - 0.5));
  return {0.45 * grey + white, 0.5 * grey + white, 0.75 * grey + white};
}

// Specks that float before the lens, each on its own way.
void AddDebris(const CavityOptions& options, int frame, cv::Mat& picture) {
  for (int k = 0; k < options.debris; ++k) {
    std::mt19937 own(static_cast<unsigned>(100 + k));
    const auto share = [&] { return static_cast<double>(own() % 1000) / 1000; };
    const double x = share() * picture.cols + frame * (8 * share() - 4),
                 y = share() * picture.rows + frame * (8 * share() - 4);
    const auto wrapped = [](double at, int size) {
      return static_cast<int>(at - size * std::floor(at / size));
    };
    cv::circle(picture, {wrapped(x, picture.cols), wrapped(y, picture.rows)}, 2,
               cv::Scalar(205, 200, 215), cv::FILLED, cv::LINE_AA);
  }
}

// A steel shaft from the rim, that swings a little.
void AddTool(const CavityOptions& options, int frame, cv::Mat& picture) {
  if (!(options.tool > 0)) return;
  const cv::Point2d tip(0.45 * picture.cols + 12 * std::sin(0.4 * frame), 0.55 * picture.rows);
  const double angle = 0.6 + 0.15 * std::sin(0.3 * frame);
  const cv::Point2d end = tip + 300 * cv::Point2d(std::cos(angle), std::sin(angle));
  cv::line(picture, tip, end, cv::Scalar(120, 120, 120), static_cast<int>(options.tool),
           cv::LINE_AA);
  cv::line(picture, tip, end, cv::Scalar(190, 190, 190), static_cast<int>(0.36 * options.tool),
           cv::LINE_AA);
}

}  // namespace

void WriteCavityClip(const std::filesystem::path& folder, const CavityOptions& options) {
  const Lens lens = CavityLens();
  std::mt19937 random(options.seed);
  std::normal_distribution<double> normal;
  constexpr int kShutter = 4;  // poses of a blurred frame
  for (int f = 0; f < options.frames; ++f) {
    std::vector<authoring::CameraPose> poses;
    for (int k = 0; k < (options.blur > 0 ? kShutter : 1); ++k)
      poses.push_back(PoseAt(options, TimeOf(options, f + options.blur * k / kShutter)));
    cv::Mat picture(lens.height, lens.width, CV_8UC3, cv::Scalar::all(0));
    for (int y = 0; y < picture.rows; ++y)
      for (int x = 0; x < picture.cols; ++x) {
        const auto ray = RayFromPixel(lens, {x, y});
        if (std::hypot(x - lens.cx, y - lens.cy) > lens.circle.r || !ray) continue;
        cv::Vec3d light(0, 0, 0);
        for (const auto& pose : poses)
          light += LightFrom(options, pose, {ray->x, ray->y, ray->z}) *
                   (1.0 / static_cast<double>(poses.size()));
        const auto level = [&](double share) {
          return cv::saturate_cast<std::uint8_t>(255 * share +
                                                 options.picture_noise * normal(random));
        };
        picture.at<cv::Vec3b>(y, x) = {level(light[0]), level(light[1]), level(light[2])};
      }
    AddDebris(options, f, picture);
    AddTool(options, f, picture);
    for (int y = 0; y < picture.rows; ++y)
      for (int x = 0; x < picture.cols; ++x)
        if (std::hypot(x - lens.cx, y - lens.cy) > lens.circle.r)
          picture.at<cv::Vec3b>(y, x) = {0, 0, 0};
    cv::imwrite((folder / fmt::format("{:03}.png", f)).string(), picture);
  }
}

double PathError(const std::vector<std::optional<authoring::CameraPose>>& poses,
                 const std::vector<authoring::CameraPose>& truth) {
  std::vector<std::size_t> posed;
  for (std::size_t i = 0; i < poses.size(); ++i)
    if (poses[i]) posed.push_back(i);
  Eigen::Matrix3Xd from(3, posed.size()), to(3, posed.size());
  for (std::size_t i = 0; i < posed.size(); ++i) {
    from.col(static_cast<Eigen::Index>(i)) = poses[posed[i]]->centre;
    to.col(static_cast<Eigen::Index>(i)) = truth[posed[i]].centre;
  }
  const Eigen::Matrix4d fit = Eigen::umeyama(from, to, true);
  const Eigen::Matrix3Xd moved =
      (fit.topLeftCorner<3, 3>() * from).colwise() + fit.topRightCorner<3, 1>();
  return std::sqrt((moved - to).colwise().squaredNorm().mean());
}

}  // namespace arthro::test
