// The arms that speak as WoodenHaptics does: their measures as published with their software
// [devices.md, Report layouts]. Polhem from version 2 on has a linkage whose kinematics are not
// public: it is refused by name, since a wrong geometry would push the wrong way.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "simulation/device/codec/wooden_haptics.h"

namespace arthro::simulation {

struct WoodenModel {
  const char* word;  // as in rig files
  const char* name;
  WoodenArm arm;
  bool has_gimbal;                   // its encoders come as F, E, D, with the button in D
  std::array<std::int16_t, 6> home;  // counters with the handle in its rest
  double peak_force, max_stiffness;  // N, N/m; what its makers state
  double reach;                      // m, about the middle of the workspace
};

std::span<const WoodenModel> WoodenModels() noexcept;
// Nothing: unknown, or refused.
const WoodenModel* FindWoodenModel(std::string_view word) noexcept;
// The words of those that are driven: "a or b".
std::string WoodenModelWords();
// One whose geometry is not public.
bool IsSecretWoodenModel(std::string_view word) noexcept;

}  // namespace arthro::simulation
