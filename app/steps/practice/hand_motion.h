// How mouse and keys move the two hands and the camera's head: the keys that are held, as a list
// that the help page shows too, and drags over the picture. A rod swings about its own portal, so
// the tip goes where the pointer goes and the hand, outside, the other way.
#pragma once

#include <functional>
#include <span>

#include "app/steps/practice/practice_step.h"
#include "simulation/scope/arthroscope.h"
#include "simulation/scope/rod_pose.h"

namespace arthro::app {

struct HandMotion {
  const char* words;  // "Scope deeper"
  int key;            // GLFW_KEY_…, held
  const char* key_words;
  bool moves_instrument;
  bool in_picture_only;          // arrows and page keys also walk through the panels
  simulation::RodPose a_second;  // change of the pose
  double head_a_second = 0;      // rad, of the camera's head
};
std::span<const HandMotion> HandMotions();

// Change of one hand's pose by the held keys in `seconds`. `held` returns whether a key is held.
simulation::RodPose MotionOfKeys(bool instrument, bool picture_has_focus, double seconds,
                                 const std::function<bool(int key)>& held);
// rad, of the camera's head.
double HeadTurnOfKeys(double seconds, const std::function<bool(int key)>& held);

// A drag by (dx, dy) of the picture's width (right, down positive): the tip swings along the
// picture's own right and up, whatever way the scope is rolled.
simulation::RodPose MotionOfDrag(const simulation::RodPose& pose, const simulation::ScopeView& view,
                                 double field_of_view, double dx, double dy);

// Held in practice: jaws close, the shaver runs. GLFW_KEY_C.
inline constexpr int kActKey = 67;

// Held in practice: the devices may push. GLFW_KEY_V.
inline constexpr int kDeadManKey = 86;

// One notch of the wheel.
inline constexpr double kInsertionANotch = 1e-3;     // m
inline constexpr double kRollANotch = 0.0872664626;  // rad, 5°
// One press of a button that turns the camera's head; twenty a second while it is held.
inline constexpr double kHeadStep = 0.0349065850;  // rad, 2°

simulation::RodPose Sum(const simulation::RodPose& a, const simulation::RodPose& b);

// Moves the author's hands, or those of the running practice, within the same limits. True when
// there was something to move.
bool MoveHands(EditorState& state, const simulation::RodPose& scope,
               const simulation::RodPose& instrument);

// The camera's head of the running practice, rad, to the right positive. True: it was turned.
bool TurnHead(EditorState& state, double angle);

}  // namespace arthro::app
