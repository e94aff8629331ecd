// State of a tissue at the start: the author's cuts are made, then small loose fragments are
// removed as after a bite. Field's frame, m, m³.
#pragma once

#include <span>
#include <vector>

#include "simulation/scene/tissue_parts.h"
#include "simulation/tissue/field/pieces.h"
#include "simulation/tissue/field/solid_field.h"

namespace arthro::simulation {

// Largest volume of a loose fragment that is washed away: the largest that passes the window of a
// 4.5 mm shaver.
inline constexpr double kDebrisVolume = 60e-9;  // m³

// Removes small loose fragments; none if nothing holds the tissue (`fixed` empty).
CrumbReport RemoveDebris(SolidField& field, std::span<const Ball> fixed);

struct MadeCuts {
  std::vector<double> removed;  // m³ per cut: volume removed beyond that of the cuts before it
  CrumbReport washed;
  Box3 changed = kEmptyBox;
};
// Throws Error(kBadArgument) for an invalid cut and Error(kBadScene) if nothing is left.
MadeCuts MakeCuts(SolidField& field, std::span<const Cut> cuts, std::span<const Ball> fixed);

}  // namespace arthro::simulation
