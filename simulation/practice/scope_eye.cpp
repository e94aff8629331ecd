#include "simulation/practice/scope_eye.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <glm/geometric.hpp>

#include "simulation/practice/cut_skin.h"
#include "simulation/scene/backdrop/relief_surface.h"

namespace arthro::simulation {
namespace {

// Way of the eye in one picture beyond the motion of the tip, after it slipped off an edge: 60 mm/s
// at 60 pictures per second.
constexpr double kGlide = 1e-3;  // m
// An eye this far from its tip is caught where a scope that enters anew would not be.
constexpr double kCaught = 5e-3;  // m
// A move that ends early is continued; along a relief it takes one pixel at a time.
constexpr int kMostMoves = 64;
constexpr double kAtRest = 1e-7;  // m
// Cells of the relief along its longer side: 0.5° of a picture of 90°, a tenth of the lens at 25
// mm.
constexpr int kReliefCells = 192;
// A rod this short has no direction; the hand's is kept.
constexpr double kShortest = 1e-3;  // m

}  // namespace

RodPose PoseThrough(const RodPose& pose, const glm::dvec3& eye) noexcept {
  RodPose through = pose;
  const double length = glm::length(eye);
  if (TipInOwnPortal(pose) == eye) return through;
  if (length < kShortest || pose.depth < kShortest) {
    through.depth = pose.depth < 0.0 ? pose.depth : length;
    return through;
  }
  through.depth = length;
  through.latitude = std::asin(std::clamp(-eye.y / length, -1.0, 1.0));
  through.longitude = std::atan2(eye.x, eye.z);
  return through;
}

ScopeEye::ScopeEye(const LoadedScene& loaded) {
  const ColourImage& panorama = OrEmpty(loaded.panorama);
  const DepthMap& depth = OrEmpty(loaded.depth);
  const int width = depth.empty() ? panorama.width : depth.width;
  const int height = depth.empty() ? panorama.height : depth.height;
  meshes_.emplace_back(MakeReliefSurface(width, height, depth, loaded.scene.backdrop, kReliefCells,
                                         ReliefSample::kHighest)
                           .mesh,
                       Pose{});
  const auto& tissues = loaded.scene.tissues;
  const std::size_t count = std::min(tissues.size(), loaded.surfaces.size());
  bodies_.resize(count);
  portal_from_body_.resize(count);
  meshes_.resize(1 + count);
  instead_.assign(1 + count, nullptr);
  for (std::size_t i = 0; i < count; ++i) {
    const Pose& pose = tissues[i].pose;
    portal_from_body_[i] = {pose.quaternion, pose.position};
    SurfaceMesh surface = OrEmpty(loaded.surfaces[i]);
    if (surface.triangles.empty()) continue;
    if (HasCutsMade(tissues[i])) surface = CutSkin(tissues[i], surface).surface;
    for (glm::dvec3& x : surface.vertices) x = pose * x;
    bodies_[i].skin = std::make_unique<MovingSkin>(surface);
    instead_[1 + i] = bodies_[i].skin.get();
  }
}

void ScopeEye::Follow(const WorldPicture& world) {
  for (const BodyPicture& picture : world.bodies) {
    const auto i = static_cast<std::size_t>(picture.tissue);
    if (picture.tissue < 0 || i >= bodies_.size() || picture.skin == nullptr) continue;
    Body& body = bodies_[i];
    if (body.shown == picture.skin && body.shape == picture.shape) continue;
    positions_.resize(picture.positions.size());
    std::ranges::transform(picture.positions, positions_.begin(),
                           [&](const glm::dvec3& x) { return portal_from_body_[i] * x; });
    if (body.shown != picture.skin)
      body.skin = std::make_unique<MovingSkin>(
          SurfaceMesh{{positions_.begin(), positions_.end()}, picture.skin->surface.triangles});
    else
      body.skin->Move(positions_);
    instead_[1 + i] = body.skin.get();
    body.shown = picture.skin;
    body.shape = picture.shape;
    if (last_goal_) proxy_.position += body.skin->WayOut(proxy_.position, kLensRadius);
  }
}

RodPose ScopeEye::MoveTo(const RodPose& pose, const glm::dvec3& tip) {
  const Surroundings around{no_field_, meshes_, instead_};
  constexpr double kAnywhere = std::numeric_limits<double>::infinity();
  double reach = last_goal_ ? glm::distance(*last_goal_, tip) + kGlide : kAnywhere;
  bool is_free = !last_goal_ || glm::distance(proxy_.position, *last_goal_) < kAtRest;
  if (last_goal_ && glm::distance(proxy_.position, tip) > kCaught &&
      IsWayFree(around, kLensRadius, glm::dvec3(0.0), tip))
    last_goal_.reset(), reach = kAnywhere, is_free = true;
  if (!last_goal_) proxy_ = Proxy{};
  for (int move = 0; move < kMostMoves && reach > kAtRest; ++move) {
    const glm::dvec3 before = proxy_.position;
    MoveProxy(around, kLensRadius, tip, reach, is_free, proxy_);
    const double moved = glm::distance(before, proxy_.position);
    if (moved < kAtRest) break;
    reach -= moved;
  }
  last_goal_ = tip;
  return PoseThrough(pose, proxy_.position);
}

bool ScopeEye::IsHiddenByTissue(const Segment3& between) const noexcept {
  return std::ranges::any_of(bodies_, [&](const Body& body) {
    return body.skin != nullptr && !body.skin->empty() && body.skin->IsCrossed(between);
  });
}

}  // namespace arthro::simulation
