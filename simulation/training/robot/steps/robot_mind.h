// Knowledge and plans of a robot that works on a step: places of the targets, poses of the scope
// that see them, and one function per kind of step. Internal to the robot. Portal frame, m, rad.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "simulation/training/robot/robot_hands.h"

namespace arthro::simulation {

inline constexpr double kSettle = 0.2;        // s, waited beyond the end of a path or a time
inline constexpr double kFarthestLook = 0.1;  // m from the eye to what it works on

struct RobotMind {
  RobotJoint& joint;
  RobotHandsMover& hands;
  RobotOptions options;
  std::vector<std::string>& troubles;
  ScopeEye& trial;  // eye of the same scene, to plan with
  int step = -1;    // number of the step under way

  bool Has(RobotFault fault) const { return options.fault == fault; }
  const Exercise& exercise() const { return joint.engine().exercise(); }
  bool IsRunning() const;  // the step is under way
  // Places of the targets as they are seen now.
  glm::dvec3 PlaceNow(int target) const;
  glm::dvec3 NormalOf(int target) const;  // at rest; towards the instrument's portal for a ball
  double RadiusOf(int target) const;
  // Largest value of a criterion, or nullopt.
  std::optional<double> MostOf(const std::string& metric, const std::string& part) const;
  PoseSearch Search(const std::vector<TargetPlace>& places) const;
  void Trouble(const std::string& sentence);
};

// The instrument as it was in the last frame.
inline const ToolFrame& InstrumentOf(const RobotMind& mind) {
  return mind.joint.frame().tool[Index(DeviceRole::kInstrument)];
}

// Waits until the step is over, at most so long. Returns false where it still runs.
bool WaitForStep(RobotMind& mind, double seconds);
// Leads the scope to a pose that sees all targets of a work with the instrument.
void LookAtWork(RobotMind& mind, const std::vector<int>& targets, double farthest);
// Moves the scope straight on until it presses with `force`, and back.
void RamScope(RobotMind& mind, double force);
// A novice that presses too hard does so on this target.
void TouchTooHard(RobotMind& mind, int target);
// Leads a tool into the first zone to avoid, and out.
void EnterZone(RobotMind& mind);

void Do(RobotMind& mind, const SeeStep& step);
void Do(RobotMind& mind, const HoldStep& step);
void Do(RobotMind& mind, const TelescopeStep& step);
void Do(RobotMind& mind, const PeriscopeStep& step);
void Do(RobotMind& mind, const TrackStep& step);
void Do(RobotMind& mind, const ProbeStep& step);
void Do(RobotMind& mind, const FollowStep& step);
void Do(RobotMind& mind, const MeasureStep& step);
void Do(RobotMind& mind, const TransferStep& step);
void Do(RobotMind& mind, const ResectStep& step);
void Do(RobotMind& mind, const RecoverStep& step);
void Do(RobotMind& mind, const AnswerStep& step);

}  // namespace arthro::simulation
