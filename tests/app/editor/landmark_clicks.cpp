#include "tests/app/editor/landmark_clicks.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>

namespace arthro::test {
namespace {

constexpr double kViewAngle = 32.0 / 180.0 * std::numbers::pi;  // rad, of the shorter side
constexpr int kEdge = 90;            // px; labels and buttons lie over the overview's border
constexpr int kModelStep = 9;        // px between the clicks that are tried
constexpr int kReliefStep = 7;       // px
constexpr double kSideError = 1e-4;  // m; sides of two triangles that are taken as equal

constexpr int kMargin = 3;               // px
constexpr double kSameSurface = 1.5e-3;  // m

struct Hit {
  glm::ivec2 click{0};
  glm::dvec3 x{0.0};  // model: tissue's frame; relief: portal frame
};

// Distance along a ray to a triangle [Möller & Trumbore 1997].
std::optional<double> Along(const authoring::Sight& ray, const glm::dvec3& a, const glm::dvec3& b,
                            const glm::dvec3& c) {
  const glm::dvec3 ab = b - a, ac = c - a, p = glm::cross(ray.direction, ac);
  const double det = glm::dot(ab, p);
  if (std::abs(det) < 1e-15) return std::nullopt;
  const glm::dvec3 from = ray.eye - a, q = glm::cross(from, ab);
  const double u = glm::dot(from, p) / det, v = glm::dot(ray.direction, q) / det;
  if (u < 0 || v < 0 || u + v > 1) return std::nullopt;
  return glm::dot(ac, q) / det;
}

// The first point of any tissue; nothing where that is another one than `wanted`.
std::optional<glm::dvec3> FirstOn(const LoadedScene& scene, int wanted,
                                  const authoring::Sight& ray) {
  double nearest = 1e9;
  int owner = -1;
  for (int i = 0; i < static_cast<int>(scene.surfaces.size()); ++i) {
    const SurfaceMesh& surface = *scene.surfaces[std::size_t(i)];
    const Pose& pose = scene.scene.tissues[std::size_t(i)].pose;
    for (const auto& t : surface.triangles) {
      const auto way = Along(ray, pose * surface.vertices[std::size_t(t[0])],
                             pose * surface.vertices[std::size_t(t[1])],
                             pose * surface.vertices[std::size_t(t[2])]);
      if (way && *way > 0 && *way < nearest) {
        nearest = *way;
        owner = i;
      }
    }
  }
  if (owner != wanted) return std::nullopt;
  const Pose& pose = scene.scene.tissues[std::size_t(wanted)].pose;
  const glm::dvec3 x = ray.eye + nearest * ray.direction;
  return glm::inverse(pose.quaternion) * (x - pose.position) / pose.scale;
}

template <class PointAt>
std::vector<Hit> Grid(const OverviewEye& eye, int step, const PointAt& point_at) {
  std::vector<Hit> hits;
  for (int y = -eye.height() / 2 + kEdge; y <= eye.height() / 2 - kEdge; y += step)
    for (int x = -eye.width() / 2 + kEdge; x <= eye.width() / 2 - kEdge; x += step)
      if (const auto point = point_at(eye.Through({x, y}))) hits.push_back({{x, y}, *point});
  // A person clicks no outline and no spike: the pixels around must show the same surface.
  const auto is_on_edge = [&](const Hit& hit) {
    for (const glm::ivec2 way : {glm::ivec2(kMargin, 0), glm::ivec2(-kMargin, 0),
                                 glm::ivec2(0, kMargin), glm::ivec2(0, -kMargin)}) {
      const auto beside = point_at(eye.Through(hit.click + way));
      if (!beside || glm::distance(*beside, hit.x) > kSameSurface) return true;
    }
    return false;
  };
  std::erase_if(hits, is_on_edge);
  return hits;
}

// The two points of a model that are farthest from one another, and the one farthest from their
// line.
std::array<Hit, 3> WidestTriangle(const std::vector<Hit>& hits) {
  std::array<Hit, 3> best;
  double longest = 0, highest = 0;
  for (const Hit& a : hits)
    for (const Hit& b : hits)
      if (const double length = glm::distance(a.x, b.x); length > longest) {
        longest = length;
        best[0] = a;
        best[1] = b;
      }
  for (const Hit& c : hits) {
    const glm::dvec3 side = best[1].x - best[0].x;
    const double height = glm::length(glm::cross(side, c.x - best[0].x));
    if (height > highest) {
      highest = height;
      best[2] = c;
    }
  }
  return best;
}

glm::dmat3 AxesOf(const std::array<Hit, 3>& corners) {
  const glm::dvec3 along = glm::normalize(corners[1].x - corners[0].x);
  const glm::dvec3 normal = glm::normalize(glm::cross(along, corners[2].x - corners[0].x));
  return {along, glm::cross(normal, along), normal};
}

Pose PoseOf(const std::array<Hit, 3>& model, const std::array<Hit, 3>& places, double scale) {
  Pose pose;
  pose.scale = scale;
  pose.quaternion = glm::normalize(glm::quat_cast(AxesOf(places) * glm::transpose(AxesOf(model))));
  for (std::size_t i = 0; i < 3; ++i)
    pose.position += (places[i].x - pose.quaternion * (scale * model[i].x)) / 3.0;
  return pose;
}

double AngleBetween(const glm::dquat& a, const glm::dquat& b) {
  return 2 * std::acos(std::min(1.0, std::abs(glm::dot(a, b))));
}

}  // namespace

OverviewEye::OverviewEye(double backdrop_radius, int width, int height)
    : position_(backdrop_radius * glm::dvec3(1.3, -1.55, -2.15)),
      focal_px_(0.5 * std::min(width, height) / std::tan(0.5 * kViewAngle)),
      width_(width),
      height_(height) {
  forward_ = glm::normalize(backdrop_radius * glm::dvec3(0, 0.06, 0.45) - position_);
  right_ = glm::normalize(glm::cross(forward_, glm::dvec3(0, -1, 0)));
  down_ = glm::cross(forward_, right_);
}

// Rows of VTK's display count from 0 at the bottom, so the last row is one below the height.
authoring::Sight OverviewEye::Through(const glm::ivec2& from_middle) const {
  const glm::dvec3 way =
      focal_px_ * forward_ + double(from_middle.x) * right_ + double(from_middle.y + 1) * down_;
  return {position_, glm::normalize(way), focal_px_};
}

std::string LandmarkClicks::Script() const {
  std::string script;
  for (const Pair& pair : pairs)
    script += fmt::format("click Overview {} {}\nclick Overview {} {}\n", pair.model.x,
                          pair.model.y, pair.scene.x, pair.scene.y);
  return script;
}

LandmarkClicks ClicksToPlace(const LoadedScene& scene, int tissue, double scale,
                             const OverviewEye& eye) {
  const Pose& present = scene.scene.tissues.at(std::size_t(tissue)).pose;
  const auto on_model = Grid(eye, kModelStep, [&](const authoring::Sight& sight) {
    auto point = FirstOn(scene, tissue, sight);
    // Only what is in front of the relief is seen.
    const auto relief = point ? authoring::PointOnRelief(scene, sight) : std::nullopt;
    if (relief &&
        glm::distance(relief->x_in_portal, sight.eye) < glm::distance(present * *point, sight.eye))
      point.reset();
    return point;
  });
  const auto on_relief = Grid(eye, kReliefStep, [&](const authoring::Sight& sight) {
    const auto point = authoring::PointOnRelief(scene, sight);
    return point ? std::optional(point->x_in_portal) : std::nullopt;
  });
  LandmarkClicks best;
  if (on_model.size() < 3) return best;
  const std::array<Hit, 3> model = WidestTriangle(on_model);
  const double size = scale * present.scale;
  const double first = size * glm::distance(model[0].x, model[1].x),
               second = size * glm::distance(model[0].x, model[2].x),
               third = size * glm::distance(model[1].x, model[2].x);
  // Sides that differ by a tenth of a millimetre turn a small body by more than the pose may be
  // off.
  for (const double side_error : {kSideError / 4, kSideError}) {
    double least_turn = 1e9;
    for (const Hit& a : on_relief) {
      std::vector<Hit> at_first, at_second;
      for (const Hit& b : on_relief) {
        const double way = glm::distance(a.x, b.x);
        if (std::abs(way - first) < side_error) at_first.push_back(b);
        if (std::abs(way - second) < side_error) at_second.push_back(b);
      }
      for (const Hit& b : at_first)
        for (const Hit& c : at_second) {
          if (std::abs(glm::distance(b.x, c.x) - third) > side_error) continue;
          const Pose pose = PoseOf(model, {a, b, c}, size);
          const double turn = AngleBetween(pose.quaternion, present.quaternion);
          if (turn >= least_turn) continue;
          least_turn = turn;
          best = {
              pose,
              std::max({std::abs(glm::distance(a.x, b.x) - first),
                        std::abs(glm::distance(a.x, c.x) - second),
                        std::abs(glm::distance(b.x, c.x) - third)}),
              {{model[0].click, a.click}, {model[1].click, b.click}, {model[2].click, c.click}}};
        }
    }
    if (!best.pairs.empty()) break;
  }
  return best;
}

}  // namespace arthro::test
