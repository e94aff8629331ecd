#include "app/steps/practice/hand_motion.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <GLFW/glfw3.h>
#include <glm/geometric.hpp>

namespace arthro::app {
namespace {

using simulation::RodPose;

constexpr double kSwing = 0.35;       // rad/s: a view is crossed in about four seconds
constexpr double kInsertion = 0.012;  // m/s
constexpr double kRoll = 1.2;         // rad/s
constexpr double kHeadTurn = 0.7;     // rad/s

constexpr HandMotion kMotions[] = {
    {"Swing the scope's tip left", GLFW_KEY_LEFT, "Left", false, true, {0, -kSwing, 0, 0}},
    {"Swing the scope's tip right", GLFW_KEY_RIGHT, "Right", false, true, {0, kSwing, 0, 0}},
    {"Swing the scope's tip up", GLFW_KEY_UP, "Up", false, true, {kSwing, 0, 0, 0}},
    {"Swing the scope's tip down", GLFW_KEY_DOWN, "Down", false, true, {-kSwing, 0, 0, 0}},
    {"Scope deeper", GLFW_KEY_PAGE_UP, "Page up", false, true, {0, 0, 0, kInsertion}},
    {"Scope back", GLFW_KEY_PAGE_DOWN, "Page down", false, true, {0, 0, 0, -kInsertion}},
    {"Roll the scope to the left", GLFW_KEY_Q, "Q", false, false, {0, 0, -kRoll, 0}},
    {"Roll the scope to the right", GLFW_KEY_E, "E", false, false, {0, 0, kRoll, 0}},
    {"Swing the instrument's tip left", GLFW_KEY_A, "A", true, false, {0, -kSwing, 0, 0}},
    {"Swing the instrument's tip right", GLFW_KEY_D, "D", true, false, {0, kSwing, 0, 0}},
    {"Swing the instrument's tip up", GLFW_KEY_W, "W", true, false, {kSwing, 0, 0, 0}},
    {"Swing the instrument's tip down", GLFW_KEY_S, "S", true, false, {-kSwing, 0, 0, 0}},
    {"Instrument deeper", GLFW_KEY_R, "R", true, false, {0, 0, 0, kInsertion}},
    {"Instrument back", GLFW_KEY_F, "F", true, false, {0, 0, 0, -kInsertion}},
    {"Roll the instrument to the left", GLFW_KEY_Z, "Z", true, false, {0, 0, -kRoll, 0}},
    {"Roll the instrument to the right", GLFW_KEY_X, "X", true, false, {0, 0, kRoll, 0}},
    {"Turn the camera head to the left", GLFW_KEY_G, "G", false, false, {}, -kHeadTurn},
    {"Turn the camera head to the right", GLFW_KEY_H, "H", false, false, {}, kHeadTurn},
};

}  // namespace

std::span<const HandMotion> HandMotions() { return kMotions; }

RodPose Sum(const RodPose& a, const RodPose& b) {
  return {a.latitude + b.latitude, a.longitude + b.longitude, a.roll + b.roll, a.depth + b.depth};
}

RodPose MotionOfKeys(bool instrument, bool picture_has_focus, double seconds,
                     const std::function<bool(int key)>& held) {
  RodPose sum;
  for (const HandMotion& motion : kMotions)
    if (motion.moves_instrument == instrument && (picture_has_focus || !motion.in_picture_only) &&
        held(motion.key))
      sum = Sum(sum, {motion.a_second.latitude * seconds, motion.a_second.longitude * seconds,
                      motion.a_second.roll * seconds, motion.a_second.depth * seconds});
  return sum;
}

double HeadTurnOfKeys(double seconds, const std::function<bool(int key)>& held) {
  double sum = 0;
  for (const HandMotion& motion : kMotions)
    if (motion.head_a_second != 0 && held(motion.key)) sum += motion.head_a_second * seconds;
  return sum;
}

RodPose MotionOfDrag(const RodPose& pose, const simulation::ScopeView& view, double field_of_view,
                     double dx, double dy) {
  // A drag across the whole picture turns the rod by half the field of view: fine enough to place,
  // wide enough to look around.
  const double angle = 0.5 * field_of_view;
  const glm::dvec3 along = dx * angle * view.right - dy * angle * view.up;
  const simulation::RodBasis basis = simulation::BasisOf(pose);
  const double cos_latitude = std::max(0.2, std::cos(pose.latitude));
  return {glm::dot(along, basis.north), glm::dot(along, basis.east) / cos_latitude, 0, 0};
}

bool MoveHands(EditorState& state, const RodPose& scope, const RodPose& instrument) {
  const auto is_still = [](const RodPose& change) {
    return change.latitude == 0 && change.longitude == 0 && change.roll == 0 && change.depth == 0;
  };
  if (is_still(scope) && is_still(instrument)) return false;
  if (state.practice) {
    state.practice->scope().Advance(scope);
    state.practice->instrument().Advance(instrument);
    return true;
  }
  const Scene& scene = state.document().scene;
  const auto moved = [](const RodPose& pose, const RodPose& change,
                        const simulation::RodLimits& limits) {
    const RodPose sum = Sum(pose, change);
    return RodPose{std::clamp(sum.latitude, -limits.max_latitude, limits.max_latitude),
                   std::clamp(sum.longitude, -limits.max_longitude, limits.max_longitude), sum.roll,
                   std::clamp(sum.depth, limits.min_depth, limits.max_depth)};
  };
  state.scope = moved(state.scope, scope, simulation::ScopeLimits(scene));
  state.instrument = moved(state.instrument, instrument, simulation::InstrumentLimits(scene));
  if (state.steps.practice->poke) {
    state.steps.practice->poke->scope().Set(state.scope);
    state.steps.practice->poke->instrument().Set(state.instrument);
  }
  return true;
}

bool TurnHead(EditorState& state, double angle) {
  if (!state.practice || angle == 0) return false;
  state.steps.practice->head.turn =
      std::remainder(state.steps.practice->head.turn + angle, 2.0 * std::numbers::pi);
  return true;
}

}  // namespace arthro::app
