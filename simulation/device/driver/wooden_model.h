// Arms with the protocol of WoodenHaptics, with dimensions as published with their software
// [devices.md, Report layouts]. Polhem from version 2 on has a linkage whose kinematics are not
// public; it is refused by name, since a wrong geometry would push in a wrong direction.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "simulation/device/codec/wooden_haptics.h"

namespace arthro::simulation {

struct WoodenModel {
  const char* word;  // text in rig files
  const char* name;
  WoodenArm arm;
  bool has_gimbal;                   // its encoders are sent as F, E, D, with the button in D
  std::array<std::int16_t, 6> home;  // counters with the handle in its rest
  double peak_force, max_stiffness;  // N, N/m, as stated by its makers
  double reach;                      // m, radius about the middle of the workspace
};

std::span<const WoodenModel> WoodenModels() noexcept;
// Returns nullptr for an unknown or refused model.
const WoodenModel* FindWoodenModel(std::string_view word) noexcept;
// Lists the models that are driven: "a or b".
std::string WoodenModelWords();
// Returns true for a model whose geometry is not public.
bool IsSecretWoodenModel(std::string_view word) noexcept;

}  // namespace arthro::simulation
