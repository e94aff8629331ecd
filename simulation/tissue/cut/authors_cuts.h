// What a tissue is before anybody touches it: the author's cuts are made, and what then hangs on
// nothing and is small is washed away as after a bite. Field's own frame, m, m³.
#pragma once

#include <span>
#include <vector>

#include "simulation/scene/tissue_parts.h"
#include "simulation/tissue/field/pieces.h"
#include "simulation/tissue/field/solid_field.h"

namespace arthro::simulation {

// A loose fragment of less is washed away; the largest that a 4.5 mm shaver's window lets through.
inline constexpr double kDebrisVolume = 60e-9;  // m³

// Takes away loose fragments that are small; none where nothing holds the tissue (`fixed` empty).
CrumbReport WashAway(SolidField& field, std::span<const Ball> fixed);

struct MadeCuts {
  std::vector<double> removed;  // m³, one a cut: what it took that those before had left
  CrumbReport washed;
  Box3 changed = kEmptyBox;
};
// Throws Error(kBadArgument) for a cut that is none and Error(kBadScene) where nothing is left.
MadeCuts MakeCuts(SolidField& field, std::span<const Cut> cuts, std::span<const Ball> fixed);

}  // namespace arthro::simulation
