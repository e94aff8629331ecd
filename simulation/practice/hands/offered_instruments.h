// Instruments that a scene offers in practice: those that it lists, or all where it lists none.
#pragma once

#include <vector>

#include "simulation/scene/scene.h"
#include "simulation/tissue/contact/tool_shape.h"

namespace arthro::simulation {

// In the order of ToolKind, each once; never empty.
std::vector<ToolKind> OfferedInstruments(const Scene& scene);
bool IsOffered(const Scene& scene, ToolKind kind);
// The one after `kind`, the first again after the last.
ToolKind NextOffered(const std::vector<ToolKind>& offered, ToolKind kind);

}  // namespace arthro::simulation
