// Resection: bites of basket forceps where they take most of the regions that is left, least of the
// rest, and where the jaws fit past the tissue at rest. Frame of the body, m, except where it says
// portal.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

#include "simulation/practice/living_tissues.h"
#include "simulation/training/robot/steps/robot_mind.h"
#include "simulation/training/steps/exercise_index.h"

namespace arthro::simulation {
namespace {

constexpr double kGrid = 4e-4;      // m, of the points that stand for the tissue
constexpr double kAround = 2.5e-3;  // m about the regions in which the rest of the tissue counts
constexpr double kAtPortal = 2e-3;  // m, insertion between two bites
constexpr double kJaws = 0.3;       // s, in which jaws close or open
// Costs of a point of the rest, per point of the regions, from a careful bite to a bold one.
constexpr std::array kRest = {2.0, 1.0, 0.5};
constexpr double kBlocked = 0.5;  // cost of a point in the way of a jaw
constexpr int kMostBites = 40;
constexpr int kRolls = 24;
constexpr double kMiddles = 7e-4;  // m, between places of a bite
constexpr double kBeyond = 1e-3;   // m, of such a place outside of the regions

struct TissuePoint {
  glm::dvec3 x;  // portal frame
  bool is_wanted;
};

// Places where a ray along x through (y, z) enters or leaves a surface.
void Crossings(const SurfaceMesh& skin, double y, double z, std::vector<double>& at) {
  at.clear();
  for (const auto& triangle : skin.triangles) {
    const glm::dvec3& a = skin.vertices[static_cast<std::size_t>(triangle[0])];
    const glm::dvec3& b = skin.vertices[static_cast<std::size_t>(triangle[1])];
    const glm::dvec3& c = skin.vertices[static_cast<std::size_t>(triangle[2])];
    if (std::max({a.y, b.y, c.y}) < y || std::min({a.y, b.y, c.y}) > y ||
        std::max({a.z, b.z, c.z}) < z || std::min({a.z, b.z, c.z}) > z)
      continue;
    const double area = (b.y - a.y) * (c.z - a.z) - (b.z - a.z) * (c.y - a.y);
    if (area == 0) continue;
    const double v = ((y - a.y) * (c.z - a.z) - (z - a.z) * (c.y - a.y)) / area;
    const double w = ((b.y - a.y) * (z - a.z) - (b.z - a.z) * (y - a.y)) / area;
    if (v < 0 || w < 0 || v + w > 1) continue;
    at.push_back(a.x + v * (b.x - a.x) + w * (c.x - a.x));
  }
  std::ranges::sort(at);
}

// Points in the tissue about the regions.
std::vector<TissuePoint> PointsOf(const SurfaceMesh& skin, std::span<const Ball> regions,
                                  const Rigid3& portal_from_body) {
  std::vector<TissuePoint> points;
  glm::dvec3 low(1e9), high(-1e9);
  for (const Ball& ball : regions) {
    low = glm::min(low, ball.centre - (ball.radius + kAround));
    high = glm::max(high, ball.centre + (ball.radius + kAround));
  }
  std::vector<double> at;
  for (double z = low.z; z < high.z; z += kGrid)
    for (double y = low.y; y < high.y; y += kGrid) {
      Crossings(skin, y + 1e-7, z + 1e-7, at);
      for (double x = low.x; x < high.x; x += kGrid) {
        const auto before = std::ranges::count_if(at, [x](double each) { return each < x; });
        if (before % 2 == 0) continue;
        const glm::dvec3 p(x, y, z);
        const bool is_wanted = std::ranges::any_of(regions, [&](const Ball& ball) {
          return glm::distance(p, ball.centre) <= ball.radius;
        });
        points.push_back({portal_from_body * p, is_wanted});
      }
    }
  return points;
}

bool IsInCapsule(const glm::dvec3& x, const Capsule& capsule) {
  const glm::dvec3 way = capsule.b - capsule.a;
  const double length2 = glm::dot(way, way);
  const double s = length2 > 0 ? std::clamp(glm::dot(x - capsule.a, way) / length2, 0.0, 1.0) : 0;
  const glm::dvec3 off = x - (capsule.a + s * way);
  return glm::dot(off, off) <= capsule.radius * capsule.radius;
}

// A ball of the same size on the skin, a diameter and a half away from the region.
Ball BesideRegion(const SurfaceMesh& skin, const Ball& ball) {
  Ball beside = ball;
  double nearest = 1e9;
  for (const glm::dvec3& x : skin.vertices) {
    const double off = std::abs(glm::distance(x, ball.centre) - 3 * ball.radius);
    if (off >= nearest) continue;
    nearest = off;
    beside.centre = x;
  }
  return beside;
}

struct Bite {
  glm::dvec3 tip{0.0};  // portal frame
  double roll = 0, gain = 0;
};

// Points of the regions in a bite, less the cost of the others.
double GainOf(std::span<const TissuePoint> points, const Capsule& bite, double rest) {
  double gain = 0;
  for (const TissuePoint& point : points)
    if (IsInCapsule(point.x, bite)) gain += point.is_wanted ? 1 : -rest;
  return gain;
}

// Best bite of the punch among places about the regions.
Bite BestBite(std::span<const TissuePoint> points, std::span<const glm::dvec3> middles,
              const glm::dvec3& portal, const ToolShape& shape, double rest) {
  Bite best;
  const double middle = -0.5 * (shape.bite.a.z + shape.bite.b.z);
  for (const glm::dvec3& p : middles) {
    // The bite lies on the axis of the tool, so its gain is that of any roll.
    const glm::dvec3 tip = p + middle * glm::normalize(p - portal);
    ToolInput input;
    input.is_present = true;
    input.opening = 1;
    input.portal_from_tool = PortalFromTool(portal, tip, 0);
    const double gain = GainOf(points,
                               {input.portal_from_tool * shape.bite.a,
                                input.portal_from_tool * shape.bite.b, shape.bite.radius},
                               rest);
    if (gain <= best.gain) continue;
    for (int i = 0; i < kRolls; ++i) {
      const double roll = 2 * std::numbers::pi * i / kRolls;
      input.portal_from_tool = PortalFromTool(portal, tip, roll);
      std::array<Capsule, kMaxCapsules> jaws;
      const auto count = static_cast<std::size_t>(PosedCapsules(shape, input, jaws));
      double left = gain;
      for (const TissuePoint& point : points)
        for (std::size_t k = 0; k < count; ++k)
          if (IsInCapsule(point.x, jaws[k])) left -= kBlocked;
      if (left > best.gain) best = {tip, roll, left};
    }
  }
  return best;
}

std::vector<glm::dvec3> MiddlesOf(std::span<const Ball> regions, const Rigid3& portal_from_body) {
  std::vector<glm::dvec3> middles;
  for (const Ball& ball : regions) {
    const double reach = ball.radius + kBeyond;
    for (double x = -reach; x <= reach; x += kMiddles)
      for (double y = -reach; y <= reach; y += kMiddles)
        for (double z = -reach; z <= reach; z += kMiddles)
          if (glm::length(glm::dvec3(x, y, z)) <= reach)
            middles.push_back(portal_from_body * (ball.centre + glm::dvec3(x, y, z)));
  }
  return middles;
}

// Brings the drawn tip to where it is wanted, against what holds it.
void Settle(RobotMind& mind, const glm::dvec3& tip) {
  constexpr int kFrames = 30;
  constexpr double kGain = 0.1, kNear = 3e-4, kMost = 4e-3;
  glm::dvec3 to = tip;
  for (int i = 0; i < kFrames && mind.IsRunning(); ++i) {
    const glm::dvec3 off =
        tip - glm::dvec3(mind.joint.frame().tool[Index(DeviceRole::kInstrument)].drawn_tip);
    if (glm::length(off) < kNear && i > 3) return;
    to += kGain * off;
    if (glm::distance(to, tip) > kMost) to = tip + kMost * glm::normalize(to - tip);
    RobotHands hands = mind.hands.at();
    hands.instrument = PoseOfTip(mind.joint.instrument_portal(), to, hands.instrument.roll);
    mind.hands.Frame(hands);
  }
}

void TakeBite(RobotMind& mind, const Bite& bite) {
  RodPose pose = PoseOfTip(mind.joint.instrument_portal(), bite.tip, bite.roll);
  mind.hands.Close(false, kJaws);
  // Open jaws are wide: they turn at the portal, and go straight to the tissue and back.
  RodPose begin = pose;
  begin.depth = kAtPortal;
  if (!mind.hands.Lead(DeviceRole::kInstrument, begin)) return;
  pose.roll = mind.hands.at().instrument.roll;
  if (!mind.hands.Leg(DeviceRole::kInstrument, pose)) return;
  Settle(mind, bite.tip);
  mind.hands.Close(true, kJaws);
  RodPose back = mind.hands.at().instrument;
  back.depth = kAtPortal;
  // Jaws that open in the tissue would catch it on the way back.
  mind.hands.Leg(DeviceRole::kInstrument, back);
  mind.hands.Close(false, kJaws);
}

}  // namespace

void Do(RobotMind& mind, const ResectStep& step) {
  const std::vector<int> targets = TargetsOf(mind.exercise(), step);
  if (targets.empty()) return;
  LookAtWork(mind, targets, 0.1);
  mind.joint.SetInstrument(ToolKind::kPunch);
  const TargetPlace& place = mind.joint.places()[static_cast<std::size_t>(targets.front())];
  const auto tissue = static_cast<std::size_t>(place.region_tissue);
  const LoadedScene& loaded = mind.joint.loaded();
  const BodyPlaces places =
      PlacesOf(loaded.scene.tissues[tissue], OrEmpty(loaded.surfaces[tissue]));
  const Pose& pose = loaded.scene.tissues[tissue].pose;
  const Rigid3 portal_from_body{pose.quaternion, pose.position};
  std::vector<Ball> regions;
  for (const int region : place.regions)
    regions.push_back(places.regions[static_cast<std::size_t>(region)].ball);
  // A novice takes a part that nobody marked.
  const std::vector<Ball> marked = regions;
  if (mind.Has(RobotFault::kCutsOutside))
    for (Ball& ball : regions) ball = BesideRegion(places.surface, ball);
  const ToolShape shape = ShapeOf(ToolKind::kPunch);
  std::vector<glm::dvec3> middles = MiddlesOf(regions, portal_from_body);
  for (int bites = 0; bites < kMostBites && mind.IsRunning(); ++bites) {
    if (mind.joint.engine().strip().progress >= 1) break;
    const SurfaceMesh* skin = &places.surface;
    if (const WorldPicture* world = mind.joint.tissues())
      for (const BodyPicture& body : world->bodies)
        if (body.tissue == place.region_tissue && body.skin) skin = &body.skin->surface;
    const auto points = PointsOf(*skin, regions, portal_from_body);
    Bite bite;
    for (const double rest : kRest)
      if (!(bite.gain > 0))
        bite = BestBite(points, middles, mind.joint.instrument_portal(), shape, rest);
    if (!(bite.gain > 0)) break;
    // The part beside is done with two bites; then the novice turns to the marked one.
    if (mind.Has(RobotFault::kCutsOutside) && bites == 1)
      regions = marked, middles = MiddlesOf(regions, portal_from_body);
    TakeBite(mind, bite);
  }
  if (mind.IsRunning() && mind.joint.engine().strip().progress < 1)
    mind.Trouble("no bite takes more of the regions than of the rest");
  mind.hands.WithdrawInstrument();
  WaitForStep(mind, 1.0);
}

}  // namespace arthro::simulation
