#include "simulation/tissue/contact/tool_shape.h"

#include <algorithm>
#include <cmath>

#include <glm/gtc/quaternion.hpp>

namespace arthro::simulation {
namespace {

constexpr double kShaftLength = 0.12;  // m, longer than the part inside a joint

// Returns a rod about z whose round end touches z = end.
Capsule Rod(double radius, double end, double length) {
  return {{0, 0, end - length}, {0, 0, end - radius}, radius};
}

// Probe with a hook of 1.5 mm rod, 4.15 mm long overall. The rod widens to a shaft of 3 mm in two
// steps, where the picture shows an even taper.
ToolShape Probe() {
  constexpr double kRod = 0.75e-3, kReach = 3.4e-3, kNeck = 0.005;
  constexpr double kTaper = 1.1e-3, kTaperEnd = 0.011, kShaft = 1.5e-3;
  ToolShape shape;
  shape.kind = ToolKind::kProbe;
  shape.capsules = {{{0, 0, -kRod}, {0, kReach - kRod, -kRod}, kRod},
                    {{0, 0, -kNeck}, {0, 0, -kRod}, kRod},
                    {{0, 0, -kTaperEnd}, {0, 0, -kNeck}, kTaper},
                    Rod(kShaft, -kTaperEnd, kShaftLength)};
  return shape;
}

// Basket forceps 3.4 mm wide: a fixed lower jaw that frames a window, and a punch that closes into
// it from +y. Jaw 6 mm long, opening 45°.
ToolShape Punch() {
  constexpr double kHalfWidth = 1.7e-3, kSide = 0.5e-3, kJaw = 6e-3, kTooth = 0.6e-3;
  const double side = kHalfWidth - kSide;
  ToolShape shape;
  shape.kind = ToolKind::kPunch;
  shape.capsules = {{{-side, -0.6e-3, -kJaw}, {-side, -0.6e-3, -kSide}, kSide},
                    {{side, -0.6e-3, -kJaw}, {side, -0.6e-3, -kSide}, kSide},
                    {{-side, -0.6e-3, -kSide}, {side, -0.6e-3, -kSide}, kSide},
                    {{0, 0.6e-3, -kJaw}, {0, 0.6e-3, -kSide - kTooth}, kTooth},
                    Rod(kHalfWidth, -kJaw, kShaftLength)};
  shape.jaw = {3};
  shape.hinge = {0, 0, -kJaw};
  shape.max_opening = 0.785;
  shape.bite = {{0, 0, -4.4e-3}, {0, 0, -1.7e-3}, 1.2e-3};
  return shape;
}

// Full-radius blade: tube of 4.5 mm with a round end and a window of 5 mm in its +y side. Tissue up
// to 0.5 mm outside the window is removed.
ToolShape Shaver() {
  constexpr double kTube = 2.25e-3, kTaken = 1.6e-3, kBeyond = 0.5e-3;
  ToolShape shape;
  shape.kind = ToolKind::kShaver;
  shape.capsules = {Rod(kTube, 0, kShaftLength)};
  const double out = kTube + kBeyond - kTaken;
  shape.bite = {{0, out, -5.5e-3}, {0, out, -2.2e-3}, kTaken};
  return shape;
}

// Grasper with two jaws of 10 mm length and 2 mm width; shaft 3.4 mm. Opening 40°.
ToolShape Grasper() {
  constexpr double kJaw = 0.01, kHalf = 0.8e-3, kShaft = 1.7e-3;
  ToolShape shape;
  shape.kind = ToolKind::kGrasper;
  shape.capsules = {{{0, -kHalf, -kJaw}, {0, -kHalf, -kHalf}, kHalf},
                    {{0, kHalf, -kJaw}, {0, kHalf, -kHalf}, kHalf},
                    Rod(kShaft, -kJaw, kShaftLength)};
  shape.jaw = {1};
  shape.hinge = {0, 0, -kJaw};
  shape.max_opening = 0.7;
  return shape;
}

}  // namespace

ToolShape ShapeOf(ToolKind kind) {
  switch (kind) {
    case ToolKind::kNone:
      return {};
    case ToolKind::kProbe:
      return Probe();
    case ToolKind::kPunch:
      return Punch();
    case ToolKind::kShaver:
      return Shaver();
    case ToolKind::kGrasper:
      return Grasper();
  }
  return {};
}

ToolKind ToolKindFromString(const std::string& word) {
  if (word == "punch") return ToolKind::kPunch;
  if (word == "shaver") return ToolKind::kShaver;
  if (word == "grasper") return ToolKind::kGrasper;
  return ToolKind::kProbe;
}

int PosedCapsules(const ToolShape& shape, const ToolInput& input,
                  std::span<Capsule> capsules) noexcept {
  const std::size_t count = std::min(capsules.size(), shape.capsules.size());
  if (!input.is_present) return 0;
  // A rotation about −x turns the jaw's far end from +z towards +y, which opens it.
  const double angle = std::clamp(input.opening, 0.0, 1.0) * shape.max_opening;
  const glm::dquat turn = glm::angleAxis(angle, shape.hinge_axis);
  for (std::size_t i = 0; i < count; ++i) {
    Capsule capsule = shape.capsules[i];
    if (angle > 0.0 && std::ranges::count(shape.jaw, static_cast<int>(i)) > 0) {
      capsule.a = shape.hinge + turn * (capsule.a - shape.hinge);
      capsule.b = shape.hinge + turn * (capsule.b - shape.hinge);
    }
    capsules[i] = {input.portal_from_tool * capsule.a, input.portal_from_tool * capsule.b,
                   capsule.radius};
  }
  return static_cast<int>(count);
}

}  // namespace arthro::simulation
