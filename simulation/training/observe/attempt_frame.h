// Observation of an attempt, one frame every 10 ms; the metrics read nothing else, so that a
// recorded attempt and a live one give the same bits [method.md, Metrics]. Portal frame, m, N, rad.
// Numbers are rounded to 32 bits.
#pragma once

#include <array>

#include <glm/vec3.hpp>

#include "simulation/device/device_sample.h"
#include "simulation/practice/snapshot.h"
#include "simulation/tissue/contact/tool_shape.h"
#include "simulation/training/observe/observation.h"

namespace arthro::simulation {

inline constexpr double kFrameTime = 0.01;  // s

struct ToolFrame {
  // Means over the ticks of the frame, weighted by their length.
  glm::vec3 tip{0.0F};               // held by the hand
  glm::vec3 drawn_tip{0.0F};         // outside the surfaces
  glm::vec3 axis{0.0F, 0.0F, 1.0F};  // from hand to tip; unit
  float mean_force = 0;              // on the tip
  float peak_force = 0;              // on the tip, largest of the ticks
  float roll = 0, depth = 0;         // in the last tick
  int contact = kNoContact;          // surface touched for the longest time
  float contact_share = 0;           // share of the frame's time in contact with it
  bool is_valid = false;             // every tick had a sample without a fault of the device
  bool is_inside() const { return is_valid && depth > 0; }
  friend bool operator==(const ToolFrame&, const ToolFrame&) = default;
};

struct AttemptFrame {
  std::array<ToolFrame, 2> tool;  // indexed by DeviceRole
  bool is_paused = false;
  // In the last tick.
  ToolKind instrument = ToolKind::kProbe;
  float opening = 1;     // opening of the jaws; 0 closed
  float view_angle = 0;  // rad
  float head_roll = 0;   // rad, of the camera head from upright (scope/camera_head.h)
  float incision_spacing = 0;
  float haze = 0, fog = 0;  // strengths of the disturbances that hide targets
  float taken = 0;          // m³ of tissue removed in the frame
  float taken_outside = 0;  // m³ of it that no region of a target holds
  // m, from the faces that were cut to the wall that holds the tissue, and their root mean square
  // distance from the spheres of the regions; −1: nothing was cut.
  float rim = -1, contour = -1;
  glm::vec3 lens{0.0F};  // from which the picture was drawn
  Observation sight;     // sight of the exercise's targets
  friend bool operator==(const AttemptFrame&, const AttemptFrame&) = default;
};

}  // namespace arthro::simulation
