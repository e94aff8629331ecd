// When an instrument takes tissue, and what becomes of the pieces: one rule for tissue of elements
// and for tissue that is a function. s, m³.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "simulation/scene/scene.h"
#include "simulation/scene/surface_mesh.h"
#include "simulation/tissue/contact/tool_shape.h"
#include "simulation/tissue/field/pieces.h"
#include "simulation/tissue/field/solid_field.h"

namespace arthro::simulation {

enum class ToolCut { kNone, kBite, kShave };

// What one tissue remembers of one tool between steps. A tool that was away begins with a new one.
struct CutTrigger {
  bool is_ready_to_bite = false;  // was opened since the last bite
  int since_shave = 0;            // steps
};

// Jaws that were open and close bite once; a running shaver takes ten times a second, for the
// `time` since it last did.
ToolCut CutOf(ToolKind kind, const ToolInput& now, double dt, CutTrigger& trigger,
              double& time) noexcept;

// Takes away the fragments that none of the balls (the field's own frame) holds and that are small,
// as WashAway; but with no ball the largest piece is the tissue, and held.
struct WashReport {
  CrumbReport gone;
  int pieces = 0;  // that are left
};
WashReport WashAwayLoose(SolidField& field, std::span<const Ball> fixed);

// A flag a vertex: 1 where it lies on a face that cuts have made.
std::vector<std::uint8_t> FreshIn(const SurfaceMesh& skin, const SolidField& field);

}  // namespace arthro::simulation
