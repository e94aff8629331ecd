// What an educator lays over a practice's picture (app/view/disturbances.h): each is switched by a
// command, and keeps the strength that it was given last.
#pragma once

#include <span>

#include "app/view/disturbances/disturbances.h"

namespace arthro::app {

struct EditorState;

inline constexpr double kUsualStrength = 0.5;  // plain to see, and one can still work
inline constexpr double kLeastStrength = 0.05;

struct Disturbing {
  Disturbances now;  // 0: off
  // What switching one on gives.
  Disturbances chosen{kUsualStrength, kUsualStrength, kUsualStrength, kUsualStrength,
                      kUsualStrength, kUsualStrength, kUsualStrength};
  bool shows_panel = false;  // instead of the practice's
};

using Strength = double Disturbances::*;
struct DisturbanceSwitch {
  const char* command;  // its id
  Strength strength;
};
std::span<const DisturbanceSwitch> DisturbanceSwitches();

void ToggleDisturbance(EditorState& state, Strength strength);
// Of one that is on, or will be.
void SetDisturbance(EditorState& state, Strength strength, double value);

}  // namespace arthro::app
