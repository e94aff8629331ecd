#include "tests/support/haptics/tissue_bridge.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <numbers>

#include <glm/geometric.hpp>

#include "simulation/tissue/contact/coupling.h"
#include "tests/support/ticks.h"

namespace arthro::test {
namespace {

using namespace simulation;

constexpr double kSpring = 500, kSlope = 500, kGrowth = 6e4;  // N/m, N/m, N/m²
constexpr int kTicks = 4000;
constexpr int kSettled = 500;  // ticks before the measurement

// How far the tissue gives way.
double Dent(double depth) noexcept {
  if (!(depth > 0.0)) return 0.0;
  const double b = kSlope + kSpring;
  return 2.0 * kSpring * depth / (b + std::sqrt(b * b + 4.0 * kGrowth * kSpring * depth));
}

// dF/dd: the tissue's own slope in series with the spring.
double Stiffness(double depth) noexcept {
  const double own = kSlope + 2.0 * kGrowth * Dent(depth);
  return own * kSpring / (own + kSpring);
}

// Coupling of a step that was solved at this depth of the tip.
ToolCoupling CouplingAt(double depth, std::uint64_t step) {
  ContactPoint contact;
  contact.owner = 0;
  contact.normal = {0, 0, 1};
  ContactResult result;
  result.gap = -Dent(depth);
  result.push = result.force = {0, 0, BridgedForce(depth)};
  TouchedSkin skin;
  skin.stiffness = Stiffness(depth);
  skin.depth = depth;
  ToolCoupling coupling;
  coupling.step = step;
  coupling.tip = {0, 0, depth};
  AddContacts({&contact, 1}, {&result, 1}, 0, skin, kSpring, {1, 0, 0, 0}, 0, coupling);
  return coupling;
}

// The servo's view of the steps: a step begins when the one before it ends, and its result is known
// when it ends itself.
class Servo {
 public:
  explicit Servo(Bridge bridge) : bridge_(bridge) {}
  void Finish(double depth) {
    depth_ = depth;
    force_ = BridgedForce(depth);
    stiffness_ = Stiffness(depth);
    if (bridge_ == Bridge::kOurs) TakeCoupling(blend_, CouplingAt(depth, ++step_));
  }
  double Force(double depth) noexcept {
    switch (bridge_) {
      case Bridge::kHold:
        return force_;
      case Bridge::kSecant:
        return depth_ > 0 ? std::max(0.0, force_ / depth_ * depth) : 0.0;
      case Bridge::kTangent:
        return std::max(0.0, force_ + stiffness_ * (depth - depth_));
      case Bridge::kOurs:
        return -BlendedForce(blend_, {0, 0, depth}, kTick, kTissueFrame).force.z;
    }
    return 0;
  }

 private:
  Bridge bridge_;
  double depth_ = 0, force_ = 0, stiffness_ = 0;
  CouplingBlend blend_;
  std::uint64_t step_ = 0;
};

}  // namespace

double BridgedForce(double depth) noexcept {
  const double x = Dent(depth);
  return kSlope * x + kGrowth * x * x;
}

const char* ToString(Bridge bridge) noexcept {
  switch (bridge) {
    case Bridge::kHold:
      return "hold the last force";
    case Bridge::kSecant:
      return "secant spring";
    case Bridge::kTangent:
      return "tangent spring";
    case Bridge::kOurs:
      return "ours";
  }
  return "";
}

BridgeRow MeasureBridge(Bridge bridge, double step_rate, double stroke_rate, int rounds) {
  BridgeRow row{bridge, step_rate, stroke_rate};
  row.seconds = std::numeric_limits<double>::infinity();
  std::vector<double> depth(kTicks), felt(kTicks);
  for (int i = 0; i < kTicks; ++i)
    depth[static_cast<std::size_t>(i)] =
        2e-3 + 1.5e-3 * std::sin(2.0 * std::numbers::pi * stroke_rate * i * kTick);
  for (int round = 0; round < rounds; ++round) {
    Servo servo(bridge);
    double under_way = depth[0];  // depth at which the step under way began
    long frames = 0;
    const auto start = std::chrono::steady_clock::now();
    for (std::size_t i = 0; i < depth.size(); ++i) {
      const long now = static_cast<long>(static_cast<double>(i) * kTick * step_rate + 1e-9);
      if (i == 0 || now != frames) {
        servo.Finish(under_way);
        under_way = depth[i];
        frames = now;
      }
      felt[i] = servo.Force(depth[i]);
    }
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start;
    row.seconds = std::min(row.seconds, passed.count() / kTicks);
  }
  double error = 0, all = 0;
  for (std::size_t i = kSettled; i < depth.size(); ++i) {
    const double exact = BridgedForce(depth[i]), before = BridgedForce(depth[i - 1]);
    error += (felt[i] - exact) * (felt[i] - exact);
    all += exact * exact;
    row.excess_step =
        std::max(row.excess_step, std::abs(felt[i] - felt[i - 1]) - std::abs(exact - before));
  }
  row.rms = std::sqrt(error / all);
  return row;
}

std::vector<BridgeRow> MeasureBridges(int rounds) {
  std::vector<BridgeRow> rows;
  for (const double step_rate : {60.0, 20.0})
    for (const double stroke_rate : {1.0, 2.0, 4.0})
      for (const Bridge bridge : kBridges)
        rows.push_back(MeasureBridge(bridge, step_rate, stroke_rate, rounds));
  return rows;
}

}  // namespace arthro::test
