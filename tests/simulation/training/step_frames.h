// Frames made by hand for steps of an exercise: one target in sight, an instrument on it.
#pragma once

#include <vector>

#include "simulation/training/observe/attempt_frame.h"
#include "simulation/training/steps/step_engine.h"

namespace arthro::test {

// Both tools are known and lie in the joint; every target is clear in the middle, 10 mm away.
inline simulation::AttemptFrame QuietFrame(int targets = 1) {
  simulation::AttemptFrame frame;
  for (simulation::ToolFrame& tool : frame.tool) {
    tool.is_valid = true;
    tool.depth = 0.01F;
    tool.tip = tool.drawn_tip = {0, 0, 0.01F};
  }
  frame.view_angle = static_cast<float>(RadiansFromDegrees(30));
  frame.sight.targets = targets;
  frame.sight.is_tip_visible = true;
  for (int i = 0; i < targets; ++i) {
    simulation::PointSight& sight = frame.sight.target[static_cast<std::size_t>(i)];
    sight.place = {0.01F * static_cast<float>(i), 0, 0.02F};
    sight.centre = 0.1F;
    sight.distance = 0.01F;
    sight.is_clear = true;
  }
  return frame;
}

// The instrument presses on a target.
inline simulation::AttemptFrame PressFrame(int target, float force, int targets = 1) {
  simulation::AttemptFrame frame = QuietFrame(targets);
  simulation::ToolFrame& tool = frame.tool[1];
  tool.tip = tool.drawn_tip = frame.sight.target[static_cast<std::size_t>(target)].place;
  tool.mean_force = tool.peak_force = force;
  tool.contact = simulation::kBackdropContact;
  tool.contact_share = 1;
  return frame;
}

inline simulation::AttemptFrame HiddenFrame(int targets = 1) {
  simulation::AttemptFrame frame = QuietFrame(targets);
  for (simulation::PointSight& sight : frame.sight.target) sight.is_clear = false;
  return frame;
}

// An exercise of targets t0, t1, … as balls along x, 10 mm apart, as QuietFrame places them.
inline Exercise ExerciseOf(std::vector<ExerciseStep> steps, int targets = 1) {
  Exercise exercise;
  exercise.id = "test";
  for (int i = 0; i < targets; ++i) {
    ExerciseTarget& target = exercise.targets.emplace_back();
    target.id = "t" + std::to_string(i);
    target.ball = glm::dvec3(0.01 * i, 0, 0.02);
  }
  for (std::size_t i = 0; i < steps.size(); ++i)
    if (BaseOf(steps[i]).id.empty()) BaseOf(steps[i]).id = "s" + std::to_string(i);
  exercise.steps = std::move(steps);
  return exercise;
}

inline void Repeat(simulation::StepEngine& engine, const simulation::AttemptFrame& frame,
                   int count) {
  for (int i = 0; i < count; ++i) engine.Advance(frame);
}

}  // namespace arthro::test
