// Working end of an instrument as capsules, so that hook and shaft touch and not only a point. Tool
// frame: origin at the tip, +z along the rod into the joint, +y in the hook's direction at roll 0;
// m.
#pragma once

#include <span>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "simulation/core/frames.h"

namespace arthro::simulation {

struct Capsule {
  glm::dvec3 a{0.0}, b{0.0};
  double radius = 5e-4;
};

// kProbe: hook; kPunch: basket forceps; kShaver: tube with a window; kGrasper.
enum class ToolKind { kNone, kProbe, kPunch, kShaver, kGrasper };

struct ToolShape {
  ToolKind kind = ToolKind::kNone;
  std::vector<Capsule> capsules;  // at opening 0 (closed); the jaw's capsules rotate about `hinge`
  std::vector<int> jaw;           // indices of the moving jaw's capsules
  glm::dvec3 hinge{0.0}, hinge_axis{-1, 0, 0};  // right-handed rotation
  double max_opening = 0;                       // rad
  Capsule bite;  // volume removed by a closing punch; shaver: its window
};

// Returns the shape in real dimensions: probe with a hook 4 mm long of 1.5 mm rod (drawn by
// app/view/instruments/probe_mesh), punch 3.4 mm wide, shaver 4.5 mm.
ToolShape ShapeOf(ToolKind kind);
// "probe", "punch", "shaver", "grasper" of Instrument::kind; another word: kProbe.
ToolKind ToolKindFromString(const std::string& word);

// State of a tool at a step, in the portal frame.
struct ToolInput {
  bool is_present = false;
  Rigid3 portal_from_tool;
  double opening = 0;       // 0 closed … 1 open; punch and grasper
  bool is_running = false;  // shaver
};

inline constexpr int kMaxCapsules = 8;  // per shape

// Writes the capsules of the posed tool, jaw opened, in the portal frame, and returns their number.
// An absent tool has none.
int PosedCapsules(const ToolShape& shape, const ToolInput& input,
                  std::span<Capsule> capsules) noexcept;

}  // namespace arthro::simulation
