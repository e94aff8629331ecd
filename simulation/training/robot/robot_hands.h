// Hands of a robot: minimum-jerk legs of both tools, on ways that keep their shafts off relief and
// tissues, with tremor. Poses are of the rod in its own portal; m, rad, s.
#pragma once

#include <optional>

#include "simulation/training/robot/pose_search.h"
#include "simulation/training/robot/robot.h"
#include "simulation/training/robot/robot_joint.h"

namespace arthro::simulation {

// Share of a leg that is done at the share `s` of its time, with least jerk.
double MinimumJerk(double s);
inline constexpr double kPeakOfMean = 1.875;  // its peak speed per mean speed
// Pose of a straight rod from `portal` whose tip is at `tip`.
RodPose PoseOfTip(const glm::dvec3& portal, const glm::dvec3& tip, double roll);

class RobotHandsMover {
 public:
  RobotHandsMover(RobotJoint& joint, const RobotOptions& options);

  // Wanted poses of the hands, without tremor.
  const RobotHands& at() const { return at_; }
  glm::dvec3 InstrumentTip() const;

  // Each returns false when the attempt has ended.
  bool Frame(const RobotHands& to);  // one frame
  bool Wait(double seconds);
  bool Close(bool closes, double seconds);
  // A straight leg of one tool in the space of its pose.
  bool Leg(DeviceRole role, const RodPose& to, double speed_share = 1);
  // A way that withdraws the tool as far as it needs to turn freely.
  bool Lead(DeviceRole role, const RodPose& to);
  bool WithdrawInstrument();

 private:
  bool IsFree(DeviceRole role, const RodPose& pose) const;
  RodPose Trembling(DeviceRole role, RodPose pose) const;

  RobotJoint& joint_;
  RobotOptions options_;
  RobotHands at_;
  std::vector<SurfaceBvh> tissues_;
  long frames_ = 0;
};

}  // namespace arthro::simulation
