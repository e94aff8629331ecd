#include "tests/support/haptics/energy_cycles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>

#include <glm/geometric.hpp>

#include "simulation/core/random.h"
#include "simulation/core/units.h"
#include "simulation/scene/projection.h"
#include "simulation/scope/rod_pose.h"
#include "tests/support/ticks.h"

namespace arthro::test {
namespace {

using namespace simulation;

constexpr double kRadius = 0.05, kSpacing = 0.018;         // m
constexpr double kSlowest = 0.02, kFastest = 0.15;         // m/s
constexpr double kShallowest = -0.003, kMiddling = 0.006;  // m, of a waypoint below the sphere
constexpr double kDeepest = 0.030;
constexpr double kFreeShare = 0.4;       // share of the radius at which a cycle begins
constexpr double kSmallestPatch = 0.05;  // share of the picture that a cycle covers
constexpr double kMargin = 0.06;  // share of the picture by which waypoints lie outside its edges
constexpr int kSamplesPerLeg = 400;
constexpr int kStill = 20;  // ticks without motion before and after a cycle

Projection ProjectionOf(ProjectionType type, int width, int height) {
  Projection projection;
  projection.type = type;
  projection.centre_px = {0.5 * (width - 1), 0.5 * (height - 1)};
  projection.focal_px = 0.5 * width;      // 90° across
  projection.px_per_deg = width / 200.0;  // 200° across
  return projection;
}

// Waves of random directions; amplitude a few millimetres, wavelengths from a sixth of the picture.
DepthMap Hills(int width, int height, std::uint64_t seed) {
  Random random(seed);
  struct Wave {
    double x, y, phase, height;
  };
  std::array<Wave, 5> waves;
  for (Wave& wave : waves) {
    const double turns = 2 * std::numbers::pi * random.Uniform(0.5, 6.0) / width;
    const double angle = random.Uniform(0, 2 * std::numbers::pi);
    wave = {turns * std::cos(angle), turns * std::sin(angle),
            random.Uniform(0, 2 * std::numbers::pi), random.Uniform(0.3e-3, 1.2e-3)};
  }
  DepthMap map(width, height, 0.0f);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      double h = 0.005;
      for (const Wave& wave : waves)
        h += wave.height * std::sin(wave.x * x + wave.y * y + wave.phase);
      map.at(x, y) = static_cast<float>(h);
    }
  return map;
}

DepthMap Steps(DepthMap map, std::uint64_t seed) {
  Random random(seed);
  for (int block = 0; block < 12; ++block) {
    const auto w = static_cast<std::uint64_t>(map.width),
               h = static_cast<std::uint64_t>(map.height);
    const int x0 = static_cast<int>(random.Below(w)), y0 = static_cast<int>(random.Below(h));
    const int x1 = std::min(map.width, x0 + static_cast<int>(w / 16 + random.Below(w / 5)));
    const int y1 = std::min(map.height, y0 + static_cast<int>(h / 16 + random.Below(h / 5)));
    const auto raise = static_cast<float>(random.Uniform(-3e-3, 5e-3));
    for (int y = y0; y < y1; ++y)
      for (int x = x0; x < x1; ++x) map.at(x, y) += raise;
  }
  return map;
}

DepthMap Holes(DepthMap map, std::uint64_t seed) {
  Random random(seed);
  constexpr float kHole = std::numeric_limits<float>::quiet_NaN();
  for (int hole = 0; hole < 6; ++hole) {
    const double x0 = random.Uniform(0, map.width), y0 = random.Uniform(0, map.height);
    const double r = random.Uniform(0.01, 0.08) * map.width;
    for (int y = 0; y < map.height; ++y)
      for (int x = 0; x < map.width; ++x)
        if (std::hypot(x - x0, y - y0) < r) map.at(x, y) = kHole;
  }
  return map;
}

DepthMap Noise(DepthMap map, double height, std::uint64_t seed) {
  Random random(seed);
  for (float& h : map.relief) h += static_cast<float>(random.Uniform(-height, height));
  return map;
}

DepthMap EightBit(DepthMap map) {
  constexpr float kStep = 0.012f / 255;
  for (float& h : map.relief) h = kStep * std::round(h / kStep);
  return map;
}

LoadedScene SceneOver(ProjectionType type, int width, int height, DepthMap map) {
  LoadedScene loaded;
  loaded.scene.backdrop.radius = kRadius;
  loaded.scene.backdrop.projection = ProjectionOf(type, width, height);
  loaded.scene.portals.incision_spacing = kSpacing;
  loaded.panorama = Share(ColourImage(width, height));
  loaded.depth = Share(std::move(map));
  return loaded;
}

// Tip of a tool, relative to its portal, to hand.
glm::dvec3 HipOf(const glm::dvec3& tip, const DeviceRig& rig) {
  RodPose pose;
  pose.depth = glm::length(tip);
  pose.latitude = -std::asin(std::clamp(tip.y / pose.depth, -1.0, 1.0));
  pose.longitude = std::atan2(tip.x, tip.z);
  return HipFromRodPose(pose, rig);
}

// Closed Catmull-Rom curve through the points.
glm::dvec3 OnCurve(std::span<const glm::dvec3> points, std::size_t leg, double s) {
  const std::size_t n = points.size();
  const glm::dvec3 &a = points[(leg + n - 1) % n], &b = points[leg], &c = points[(leg + 1) % n],
                   &d = points[(leg + 2) % n];
  return b +
         0.5 * s * (c - a + s * (2.0 * a - 5.0 * b + 4.0 * c - d + s * (3.0 * (b - c) + d - a)));
}

}  // namespace

std::vector<CycleGround> CycleGrounds() {
  constexpr auto kRound = ProjectionType::kEquirectangular, kPlane = ProjectionType::kGnomonic;
  std::vector<CycleGround> grounds;
  const auto add = [&](const char* name, ProjectionType type, DepthMap map) {
    const int width = map.width, height = map.height;
    grounds.push_back({name, SceneOver(type, width, height, std::move(map))});
  };
  add("hills, 96 x 72", kRound, Hills(96, 72, 1));
  add("hills, 96 x 72, gnomonic", kPlane, Hills(96, 72, 2));
  add("steps, 96 x 72", kRound, Steps(Hills(96, 72, 3), 3));
  add("noise of 0.5 mm, 96 x 72", kRound, Noise(Hills(96, 72, 4), 5e-4, 4));
  add("holes, 96 x 72", kRound, Holes(Hills(96, 72, 5), 5));
  add("hills, 1024 x 768", kRound, Hills(1024, 768, 6));
  add("steps, 1024 x 768, gnomonic", kPlane, Steps(Hills(1024, 768, 7), 7));
  add("8 bit, 1024 x 768", kRound, EightBit(Hills(1024, 768, 8)));
  add("holes and noise of 0.1 mm, 1024 x 768", kRound,
      Holes(Noise(Hills(1024, 768, 9), 1e-4, 9), 9));
  grounds.push_back({"bare sphere", SceneOver(kRound, 1024, 768, {})});
  return grounds;
}

CycleHand::CycleHand(const CycleGround& ground)
    : radius_(ground.loaded.scene.backdrop.radius),
      spacing_(ground.loaded.scene.portals.incision_spacing),
      projection_(ground.loaded.scene.backdrop.projection),
      size_px_(ground.loaded.panorama->width, ground.loaded.panorama->height),
      session_(ground.loaded) {}

EnergyCycle CycleHand::Go(std::uint64_t number) {
  Random random(number);
  EnergyCycle cycle;
  SessionOptions options;
  options.limiter.ramp_time = 0;  // armed long since
  if (random.Below(2) == 0) options.contact.static_friction = options.contact.sliding_friction = 0;
  session_.SetOptions(options);
  const bool is_scope = random.Below(2) == 0;
  const DeviceRig& rig = is_scope ? session_.scope_rig() : session_.instrument_rig();
  const glm::dvec3 portal(is_scope ? 0.0 : spacing_, 0.0, 0.0);
  cycle.speed = kSlowest * std::pow(kFastest / kSlowest, random.Uniform(0, 1));

  // From free space over two to five points, most of them under the surface, once or twice around.
  const double patch = random.Uniform(kSmallestPatch, 1);
  const glm::dvec2 corner(random.Uniform(-kMargin, 1 + kMargin - patch),
                          random.Uniform(-kMargin, 1 + kMargin - patch));
  const auto at = [&](double depth) {
    const glm::dvec2 share(random.Uniform(0, patch), random.Uniform(0, patch));
    return (radius_ + depth) * DirectionFromPixel(projection_, size_px_ * (corner + share));
  };
  std::vector<glm::dvec3> points{at((kFreeShare - 1) * radius_)};
  const bool is_deep = random.Below(2) == 0;
  const auto touched = 2 + random.Below(4), rounds = 1 + random.Below(2);
  for (std::uint64_t i = 0; i < touched; ++i)
    points.push_back(
        at(is_deep ? random.Uniform(kMiddling, kDeepest) : random.Uniform(kShallowest, kMiddling)));
  for (std::uint64_t i = touched; i < touched * rounds; ++i)
    points.push_back(points[points.size() - touched]);

  // Evenly along the hand's own way.
  std::vector<glm::dvec3> way;
  for (std::size_t leg = 0; leg < points.size(); ++leg)
    for (int i = 0; i < kSamplesPerLeg; ++i)
      way.push_back(
          HipOf(OnCurve(points, leg, static_cast<double>(i) / kSamplesPerLeg) - portal, rig));
  way.push_back(way.front());
  std::vector<glm::dvec3> hips(kStill, way.front());
  const double step = cycle.speed * kTick;
  double left = step;
  for (std::size_t i = 1; i < way.size(); ++i) {
    const double length = glm::distance(way[i - 1], way[i]);
    double s = left;
    for (; s < length; s += step) hips.push_back(glm::mix(way[i - 1], way[i], s / length));
    left = s - length;
  }
  hips.insert(hips.end(), kStill, way.front());

  session_.Tick({}, {}, kTick);  // no hand: the next one enters anew
  glm::dvec3 force(0.0);
  double run = 0, episode = 0;
  for (std::size_t i = 0; i < hips.size(); ++i) {
    if (i > 0) {
      const double work = glm::dot(force, hips[i] - hips[i - 1]);
      cycle.work += work;
      episode += work;
    }
    DeviceSample sample;
    sample.t = t_ += kTick;
    sample.hip_in_device = hips[i];
    sample.valid = true;
    session_.Tick(is_scope ? sample : DeviceSample{}, is_scope ? DeviceSample{} : sample, kTick);
    const ToolState& tool = is_scope ? session_.snapshot().scope : session_.snapshot().instrument;
    const double now = glm::length(tool.hand_force);
    cycle.largest_rise = std::max(cycle.largest_rise, now - glm::length(force));
    cycle.strongest = std::max(cycle.strongest, now);
    cycle.deepest = std::max(cycle.deepest, tool.penetration);
    force = tool.hand_force;
    if (now > 0 || tool.contact >= 0) continue;
    run = std::max(run, 0.0) + episode;
    episode = 0;
    cycle.gain = std::max(cycle.gain, run);
  }
  return cycle;
}

std::vector<EnergyRow> MeasureEnergy(int count, const Progress& progress) {
  std::vector<EnergyRow> rows;
  const std::vector<CycleGround> grounds = CycleGrounds();
  const int each = count / static_cast<int>(grounds.size());
  for (const CycleGround& ground : grounds) {
    EnergyRow row;
    row.ground = ground.name;
    row.cycles = each;
    CycleHand hand(ground);
    const std::uint64_t first = 1000000 * rows.size();
    for (int i = 0; i < each; ++i) {
      if (i % 20 == 0)
        progress.Step("energy", (static_cast<double>(rows.size()) + static_cast<double>(i) / each) /
                                    static_cast<double>(grounds.size()));
      const EnergyCycle cycle = hand.Go(first + static_cast<std::uint64_t>(i));
      row.touched += cycle.deepest > 0;
      row.largest_rise = std::max(row.largest_rise, cycle.largest_rise);
      if (i > 0 && cycle.gain <= row.cycle.gain) continue;
      row.cycle = cycle;
      row.worst = first + static_cast<std::uint64_t>(i);
    }
    rows.push_back(row);
  }
  return rows;
}

}  // namespace arthro::test
