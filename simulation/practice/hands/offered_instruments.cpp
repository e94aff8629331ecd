#include "simulation/practice/hands/offered_instruments.h"

#include <algorithm>

namespace arthro::simulation {

std::vector<ToolKind> OfferedInstruments(const Scene& scene) {
  constexpr ToolKind kAll[] = {ToolKind::kProbe, ToolKind::kPunch, ToolKind::kShaver,
                               ToolKind::kGrasper};
  std::vector<ToolKind> offered;
  for (const ToolKind kind : kAll)
    if (scene.instruments.empty() ||
        std::any_of(scene.instruments.begin(), scene.instruments.end(),
                    [&](const Instrument& own) { return ToolKindFromString(own.kind) == kind; }))
      offered.push_back(kind);
  return offered;
}

bool IsOffered(const Scene& scene, ToolKind kind) {
  const std::vector<ToolKind> offered = OfferedInstruments(scene);
  return std::find(offered.begin(), offered.end(), kind) != offered.end();
}

ToolKind NextOffered(const std::vector<ToolKind>& offered, ToolKind kind) {
  const auto next = std::upper_bound(offered.begin(), offered.end(), kind);
  return next != offered.end() ? *next : offered.front();
}

}  // namespace arthro::simulation
