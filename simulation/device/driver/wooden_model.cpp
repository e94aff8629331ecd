#include "simulation/device/driver/wooden_model.h"

#include <array>

namespace arthro::simulation {
namespace {

WoodenArm Arm2015() noexcept {
  WoodenArm arm;
  arm.origin = {0.220, 0, 0.080};
  arm.gimbal_counts_per_turn = 0;
  return arm;
}

WoodenArm ArmPolhem1() noexcept {
  WoodenArm arm;
  arm.transmission = {10.0 / 180, 10.0 / 100, 10.0 / 100};
  arm.sign = {-1, -1, -1};
  arm.column = 0.058, arm.upper = 0.174, arm.lower = 0.133;
  arm.origin = {0.140, 0, 0.100};
  arm.torque_constant = 0.0538;
  arm.gimbal_sign = {-1, 1, -1};
  return arm;
}

const std::array kModels{
    WoodenModel{"woodenhaptics_2015",
                "WoodenHaptics (2015)",
                Arm2015(),
                false,
                {0, 0, 6000, 0, 0, 0},
                5,
                1000,
                0.1},
    WoodenModel{
        "polhem_v1", "Polhem version 1", ArmPolhem1(), true, {0, 0, -5000, 0, 0, 0}, 5, 800, 0.1}};

}  // namespace

std::span<const WoodenModel> WoodenModels() noexcept { return kModels; }

const WoodenModel* FindWoodenModel(std::string_view word) noexcept {
  for (const WoodenModel& model : kModels)
    if (word == model.word) return &model;
  return nullptr;
}

std::string WoodenModelWords() {
  std::string words;
  for (const WoodenModel& model : kModels) {
    if (!words.empty()) words += " or ";
    words += model.word;
  }
  return words;
}

bool IsSecretWoodenModel(std::string_view word) noexcept {
  return word == "polhem_v2" || word == "polhem_v3";
}

}  // namespace arthro::simulation
