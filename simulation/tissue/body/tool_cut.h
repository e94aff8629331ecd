// Rule by which an instrument removes tissue and loose pieces are washed away, common to tissue of
// elements and to implicit tissue. s, m³.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "simulation/scene/mesh/surface_mesh.h"
#include "simulation/scene/scene.h"
#include "simulation/tissue/contact/tool_shape.h"
#include "simulation/tissue/field/pieces.h"
#include "simulation/tissue/field/solid_field.h"

namespace arthro::simulation {

enum class ToolCut { kNone, kBite, kShave };

// Memory of one tool on one tissue between steps. A tool that was away starts with a new one.
struct CutTrigger {
  bool is_ready_to_bite = false;  // opened since the last bite
  int since_shave = 0;            // steps
};

// Returns the cut of a step. Jaws that were open and close bite once. A running shaver cuts ten
// times per second, for the `time` since its last cut.
ToolCut TriggerCut(ToolKind kind, const ToolInput& now, double dt, CutTrigger& trigger,
                   double& time) noexcept;

// Removes small fragments that none of the balls (field's frame) holds, as RemoveDebris. Without a
// ball the largest piece is held.
struct LooseReport {
  CrumbReport gone;
  int pieces = 0;  // remaining pieces
};
LooseReport RemoveLoosePieces(SolidField& field, std::span<const Ball> fixed);

// Returns a flag per vertex: 1 on faces made by cuts.
std::vector<std::uint8_t> MarkFreshVertices(const SurfaceMesh& skin, const SolidField& field);

}  // namespace arthro::simulation
