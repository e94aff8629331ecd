#include "authoring/alignment/surface_alignment.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "simulation/core/units.h"

namespace arthro::authoring {
namespace {

constexpr std::size_t kMostPoints = 2000;
constexpr std::size_t kFewestPoints = 12;
// Motions that end the search: far below what a relief shows.
constexpr double kLeastMove = 1e-7;  // m
constexpr double kLeastTurn = 1e-6;  // rad
// Damping of motions that the surfaces do not determine, such as a slide along a plane, as a share
// of the largest eigenvalue.
constexpr double kDamping = 1e-4;

// Vertices that take part, evenly chosen where there are many; tissue frame.
std::vector<glm::dvec3> PointsOf(const SurfaceMesh& surface, const Pose& present,
                                 const std::optional<Ball>& patch, AlignSide side) {
  const std::vector<glm::dvec3> normals = NormalsOf(surface);
  std::vector<glm::dvec3> all;
  for (std::size_t i = 0; i < surface.vertices.size(); ++i) {
    const glm::dvec3& x = surface.vertices[i];
    const bool is_front = glm::dot(present.quaternion * normals[i], present * x) < 0;
    const bool takes_part = patch ? glm::distance(x, patch->centre) <= patch->radius
                                  : is_front == (side == AlignSide::kFront);
    if (takes_part) all.push_back(x);
  }
  if (all.size() <= kMostPoints) return all;
  std::vector<glm::dvec3> some;
  for (std::size_t i = 0; i < kMostPoints; ++i) some.push_back(all[i * all.size() / kMostPoints]);
  return some;
}

// Median of the unsigned distances of points from the relief, m; nothing where most are out of
// reach.
std::optional<double> MedianDistance(const ReliefTarget& relief,
                                     const std::vector<glm::dvec3>& points, const Pose& pose,
                                     double reach) {
  std::vector<glm::dvec3> places;
  places.reserve(points.size());
  for (const glm::dvec3& x : points) places.push_back(pose * x);
  std::vector<double> distances = DistancesFrom(relief, places, reach);
  std::erase_if(distances, [](double d) { return std::isnan(d); });
  if (distances.size() < std::max(kFewestPoints, points.size() / 2)) return std::nullopt;
  for (double& d : distances) d = std::abs(d);
  const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
  std::nth_element(distances.begin(), middle, distances.end());
  return *middle;
}

// The relief shows what lies behind the tissue where the tissue's back is the side that lies on it.
// An open sheet has no back.
AlignSide SideOnRelief(const ReliefTarget& relief, const SurfaceMesh& surface, const Pose& present,
                       double reach) {
  const auto median = [&](AlignSide side) {
    return MedianDistance(relief, PointsOf(surface, present, {}, side), present, reach);
  };
  const std::optional<double> front = median(AlignSide::kFront), back = median(AlignSide::kBack);
  return back && (!front || *back < *front) ? AlignSide::kBack : AlignSide::kFront;
}

struct Match {
  glm::dvec3 x{0.0}, normal{0.0};
  double distance = 0;  // m, along the normal
};

// The nearest places of the relief, the closest share of them.
std::vector<Match> MatchesOf(const ReliefTarget& relief, const std::vector<glm::dvec3>& points,
                             const Pose& pose, const SurfaceAlignOptions& options) {
  std::vector<std::pair<double, Match>> all;
  for (const glm::dvec3& point : points) {
    const glm::dvec3 x = pose * point;
    const SurfacePoint nearest = relief.finder->Find(x, options.reach);
    if (nearest.triangle < 0) continue;
    const glm::dvec3& normal = relief.normals[static_cast<std::size_t>(nearest.triangle)];
    all.push_back(
        {glm::distance(x, nearest.place), {x, normal, glm::dot(x - nearest.place, normal)}});
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  const auto kept =
      static_cast<std::size_t>(std::ceil(options.kept_share * static_cast<double>(all.size())));
  std::vector<Match> matches;
  for (std::size_t i = 0; i < kept; ++i) matches.push_back(all[i].second);
  return matches;
}

}  // namespace

const char* ToString(AlignSide side) {
  return side == AlignSide::kAuto ? "auto" : side == AlignSide::kFront ? "front" : "back";
}

SurfaceAlignment AlignSurface(const ReliefTarget& relief, const SurfaceMesh& surface,
                              const Pose& present, const std::optional<Ball>& patch,
                              const SurfaceAlignOptions& options) {
  SurfaceAlignment alignment;
  alignment.portal_from_tissue = present;
  const auto refuse = [&](const std::string& sentence) {
    alignment.sentence = sentence;
    return alignment;
  };
  if (relief.empty()) return refuse("The scene has no relief; make one first.");
  alignment.side = options.side == AlignSide::kAuto
                       ? SideOnRelief(relief, surface, present, options.reach)
                       : options.side;
  const std::vector<glm::dvec3> points = PointsOf(surface, present, patch, alignment.side);
  alignment.points = static_cast<int>(points.size());
  if (points.size() < kFewestPoints)
    return refuse(patch
                      ? "The patch holds too few points of the surface; make it larger."
                      : "Too little of the surface lies on that side; turn it, or choose a patch.");
  alignment.before = FitOf(relief, surface, present);
  alignment.has_front = alignment.before.is_known;

  glm::dvec3 middle(0.0);
  for (const glm::dvec3& x : points) middle += x / static_cast<double>(points.size());
  double arm2 = 0;
  for (const glm::dvec3& x : points) {
    const double arm = present.scale * glm::distance(x, middle);
    arm2 += arm * arm / static_cast<double>(points.size());
  }
  const double size = std::sqrt(std::max(arm2, 1e-12));  // m; makes turns and moves comparable

  Pose pose = present;
  for (int step = 0; step < options.max_steps; ++step) {
    const std::vector<Match> matches = MatchesOf(relief, points, pose, options);
    if (matches.size() < kFewestPoints)
      return refuse(
          fmt::format("The surface is more than {:.0f} mm away from the relief; bring it "
                      "nearer, by landmarks or by hand.",
                      MmFromMetres(options.reach)));
    const glm::dvec3 centre = pose * middle;
    Eigen::Matrix<double, 6, 6> normal = Eigen::Matrix<double, 6, 6>::Zero();
    Eigen::Matrix<double, 6, 1> right = Eigen::Matrix<double, 6, 1>::Zero();
    double sum = 0;
    for (const Match& match : matches) {
      const glm::dvec3 turn = glm::cross(match.x - centre, match.normal) / size;
      Eigen::Matrix<double, 6, 1> row;
      row << turn.x, turn.y, turn.z, match.normal.x, match.normal.y, match.normal.z;
      normal += row * row.transpose();
      right -= row * match.distance;
      sum += match.distance * match.distance;
    }
    alignment.kept_rms = std::sqrt(sum / static_cast<double>(matches.size()));
    alignment.steps = step + 1;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>> eigen(normal);
    const double damping = kDamping * eigen.eigenvalues()[5];
    const Eigen::Matrix<double, 6, 1> motion =
        (normal + damping * Eigen::Matrix<double, 6, 6>::Identity()).ldlt().solve(right);
    const glm::dvec3 turn = glm::dvec3(motion[0], motion[1], motion[2]) / size,
                     move(motion[3], motion[4], motion[5]);
    const double angle = glm::length(turn);
    if (angle > 0) {
      const glm::dquat rotation = glm::angleAxis(angle, turn / angle);
      pose.quaternion = glm::normalize(rotation * pose.quaternion);
      pose.position = centre + rotation * (pose.position - centre);
    }
    pose.position += move;
    if (glm::length(move) < kLeastMove && angle < kLeastTurn) break;
  }
  alignment.portal_from_tissue = pose;
  alignment.after = FitOf(relief, surface, pose);
  alignment.is_aligned = true;
  alignment.sentence =
      alignment.side == AlignSide::kBack && !patch
          ? fmt::format("{}, so its back was laid onto it, to {:.2f} mm rms.",
                        alignment.has_front
                            ? "The relief shows what lies behind this tissue"
                            : "None of this tissue faces the portal near the relief",
                        MmFromMetres(alignment.kept_rms))
          : fmt::format(
                "Median distance {:.2f} mm before, {:.2f} mm now; {:.0f} % of the side "
                "that faces the portal is within 1 mm.",
                MmFromMetres(alignment.before.median), MmFromMetres(alignment.after.median),
                100 * alignment.after.within);
  return alignment;
}

}  // namespace arthro::authoring
