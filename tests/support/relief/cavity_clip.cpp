#include "tests/support/relief/cavity_clip.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include <Eigen/Dense>
#include <fmt/format.h>
#include <opencv2/imgcodecs.hpp>

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

// Distance along a ray from inside to the surface.
double Range(const Vector3d& from, const Vector3d& ray) {
  double near = 0, far = 2 * kSphere;
  constexpr int kSteps = 60;
  for (int i = 1; i <= kSteps; ++i) {
    const double t = 2 * kSphere * i / kSteps;
    const Vector3d p = from + t * ray;
    if (p.norm() < CavityRadius(p.normalized())) continue;
    far = t, near = 2 * kSphere * (i - 1) / kSteps;
    break;
  }
  for (int i = 0; i < 25; ++i) {
    const double t = 0.5 * (near + far);
    const Vector3d p = from + t * ray;
    (p.norm() < CavityRadius(p.normalized()) ? near : far) = t;
  }
  return 0.5 * (near + far);
}

}  // namespace

double CavityRadius(const Vector3d& direction) {
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

std::vector<authoring::CameraPose> CavityPoses(const CavityOptions& options) {
  std::vector<authoring::CameraPose> poses;
  for (int i = 0; i < options.frames; ++i) {
    const double t = static_cast<double>(i) / std::max(1, options.frames - 1);
    double latitude = 0.22 * std::sin(5 * t + 0.4), longitude = 0.22 * std::cos(4 * t),
           depth = 0.016 + 0.003 * std::sin(3 * t), roll = 0.35 * std::sin(4 * t + 1);
    if (options.motion != ScopeMotion::kSweep) latitude = 0.1, longitude = -0.05, depth = 0.016;
    if (options.motion == ScopeMotion::kStill) roll = 0.2;
    const Vector3d u(std::cos(latitude) * std::sin(longitude), -std::sin(latitude),
                     std::cos(latitude) * std::cos(longitude));
    const Vector3d north(-std::sin(latitude) * std::sin(longitude), -std::cos(latitude),
                         -std::sin(latitude) * std::cos(longitude)),
        east(std::cos(longitude), 0, -std::sin(longitude));
    const Vector3d aside = std::cos(roll) * north + std::sin(roll) * east;
    const Vector3d view = std::cos(kViewAngle) * u + std::sin(kViewAngle) * aside;
    const Vector3d up = std::cos(kViewAngle) * aside - std::sin(kViewAngle) * u;
    const Vector3d right = view.cross(up);
    const double c = std::cos(options.head_turn), s = std::sin(options.head_turn);
    authoring::CameraPose pose;
    pose.world_from_camera.col(0) = c * right - s * up;
    pose.world_from_camera.col(1) = -(c * up + s * right);
    pose.world_from_camera.col(2) = view;
    pose.centre = depth * u;
    poses.push_back(pose);
  }
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
  const Lens lens = CavityLens();
  std::mt19937 random(options.seed);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::vector<authoring::Track> tracks;
  for (int i = 0; i < options.points; ++i) {
    const Vector3d direction = Vector3d(uniform(random), uniform(random), 0.8).normalized();
    const Vector3d point = direction * CavityRadius(direction);
    authoring::Track track;
    for (int f = 0; f < options.frames; ++f) {
      const Vector3d local = poses[static_cast<std::size_t>(f)].InCamera(point);
      if (local.z() < 0.76 * local.norm()) continue;  // outside the round window
      const auto pixel = PixelFromRay(lens, {local.x(), local.y(), local.z()});
      if (!pixel) continue;
      Eigen::Vector2d seen(pixel->x + options.noise_px * normal(random),
                           pixel->y + options.noise_px * normal(random));
      if (0.5 * (1 + uniform(random)) < options.outliers)
        seen += Eigen::Vector2d(20 * uniform(random), 20 * uniform(random));
      const auto ray = RayFromPixel(lens, {seen.x(), seen.y()});
      if (ray) track.seen.push_back({f, seen, {ray->x, ray->y, ray->z}});
    }
    if (track.seen.size() >= 2) tracks.push_back(track);
  }
  return tracks;
}

void WriteCavityClip(const std::filesystem::path& folder, const CavityOptions& options) {
  const Lens lens = CavityLens();
  const auto poses = CavityPoses(options);
  std::mt19937 random(options.seed);
  std::normal_distribution<double> normal;
  for (std::size_t f = 0; f < poses.size(); ++f) {
    cv::Mat picture(lens.height, lens.width, CV_8UC3, cv::Scalar::all(0));
    for (int y = 0; y < picture.rows; ++y)
      for (int x = 0; x < picture.cols; ++x) {
        if (std::hypot(x - lens.cx, y - lens.cy) > lens.circle.r) continue;
        const auto ray = RayFromPixel(lens, {x, y});
        if (!ray) continue;
        const Vector3d d = poses[f].world_from_camera * Vector3d(ray->x, ray->y, ray->z);
        const double range = Range(poses[f].centre, d);
        const double light = std::min(1.6, std::pow(0.022 / range, 1.2));
        const double albedo = Albedo(poses[f].centre + range * d);
        const auto level = [&](double colour) {
          const double grey =
              255 * colour * light * (1 - options.contrast + options.contrast * albedo) +
              options.picture_noise * normal(random);
          return cv::saturate_cast<std::uint8_t>(grey);
        };
        picture.at<cv::Vec3b>(y, x) = {level(0.45), level(0.5), level(0.75)};
      }
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
