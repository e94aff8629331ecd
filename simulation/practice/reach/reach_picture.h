// The panorama with what scope and instrument reach as colours over it, in cells of
// ScopeReach::pixel_step pixels.
#pragma once

#include <array>
#include <cstdint>

#include "simulation/practice/reach/portal_reach.h"
#include "simulation/scene/image.h"

namespace arthro::simulation {

// In order from nothing to all.
enum class ReachClass { kNeither, kSeen, kTouched, kBoth, kGood };

struct ReachColour {
  std::array<std::uint8_t, 3> rgb;
  const char* words;
};
const ReachColour& ColourOf(ReachClass reached);
inline constexpr std::array kReachClasses = {ReachClass::kGood, ReachClass::kBoth,
                                             ReachClass::kSeen, ReachClass::kTouched,
                                             ReachClass::kNeither};

ReachClass ClassOf(const PlaceReach& place);

// Places that were not imaged keep their colour.
ColourImage DrawReach(const ColourImage& panorama, const ScopeReach& scope,
                      const PortalReach& reach);

}  // namespace arthro::simulation
