// Steps that follow a path, with the view or with the tip.
#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <glm/geometric.hpp>

#include "simulation/training/robot/steps/robot_mind.h"
#include "simulation/training/steps/exercise_index.h"
#include "simulation/training/steps/path_pieces.h"

namespace arthro::simulation {
namespace {

constexpr double kOffPath = 1.2;  // times the error that a criterion allows

std::vector<glm::dvec3> PathOf(const RobotMind& mind, const std::vector<std::string>& ids) {
  std::vector<glm::dvec3> path;
  path.reserve(ids.size());
  for (const std::string& id : ids) path.push_back(mind.PlaceNow(TargetIndex(mind.exercise(), id)));
  return path;
}

// A roll and an insertion with which the scope can follow the whole path.
std::optional<RodPose> PoseForPath(const PoseSearch& search) {
  std::optional<RodPose> best;
  double least = 0;
  for (const double roll : PoseSearch::Rolls())
    for (const double insertion : PoseSearch::Insertions()) {
      std::optional<RodPose> first, last;
      double cost = 0;
      for (int i = 0; i < search.count(); ++i) {
        RodPose pose;
        pose.roll = roll;
        pose.depth = insertion;
        if (last) pose = *last;
        const auto next = search.Centred(pose, search.Place(i));
        if (!next || !search.IsFree(*next)) {
          first.reset();
          break;
        }
        const PointSight sight = search.See(*next).target[static_cast<std::size_t>(i)];
        cost += sight.is_clear ? 0 : 1;
        if (last) cost += glm::distance(TipInOwnPortal(*next), TipInOwnPortal(*last)) / insertion;
        if (!first) first = next;
        last = next;
      }
      if (!first || (best && cost >= least)) continue;
      least = cost;
      best = first;
    }
  return best;
}

PoseSearch SearchForPath(const RobotMind& mind, std::span<const glm::dvec3> path) {
  std::vector<TargetPlace> places;
  places.reserve(kMostTargets);
  for (int i = 0; i < kMostTargets; ++i)
    places.push_back(
        TargetInBall(PointAt(path, LengthOf(path) * i / (kMostTargets - 1)), kPieceLength));
  return mind.Search(places);
}

// A point beside a path, as seen from the lens.
glm::dvec3 Beside(const RobotMind& mind, const glm::dvec3& x, double metres) {
  const glm::dvec3 lens = TipInOwnPortal(mind.hands.at().scope);
  const glm::dvec3 way = x - lens;
  return x + metres * glm::normalize(glm::cross(way, glm::dvec3(1.0, 0.0, 0.0)));
}

double OffPath(const RobotMind& mind, const char* metric) {
  return mind.Has(RobotFault::kLeavesLine) ? kOffPath * mind.MostOf(metric, "").value_or(0) : 0.0;
}

// One frame in which the middle of the picture goes to a point.
bool LookAt(RobotMind& mind, const PoseSearch& search, const glm::dvec3& x) {
  RobotHands to = mind.hands.at();
  if (const auto pose = search.Centred(to.scope, x)) to.scope = *pose;
  return mind.hands.Frame(to);
}

}  // namespace

void Do(RobotMind& mind, const TrackStep& step) {
  const std::vector<glm::dvec3> path = PathOf(mind, step.path);
  if (step.by == StepBy::kTip) {
    LookAtWork(mind, TargetsOf(mind.exercise(), step), kFarthestLook);
    const double roll = mind.hands.at().instrument.roll;
    if (!mind.hands.Lead(DeviceRole::kInstrument,
                         PoseOfTip(mind.joint.instrument_portal(), path.front(), roll)))
      return;
    while (mind.IsRunning()) {
      RobotHands to = mind.hands.at();
      const glm::dvec3 goal = mind.joint.engine().strip().goal.value_or(path.front());
      to.instrument = PoseOfTip(mind.joint.instrument_portal(), goal, roll);
      mind.hands.Frame(to);
    }
    return;
  }
  mind.hands.WithdrawInstrument();
  const PoseSearch search = SearchForPath(mind, path);
  const auto start = PoseForPath(search);
  if (!start) return mind.Trouble("no roll and insertion follow the whole path");
  if (!mind.hands.Lead(DeviceRole::kScope, *start)) return;
  const double off = OffPath(mind, "track_error");
  while (mind.IsRunning()) {
    const auto goal = mind.joint.engine().strip().goal;
    if (!LookAt(mind, search, Beside(mind, goal.value_or(path.front()), off))) return;
  }
}

void Do(RobotMind& mind, const FollowStep& step) {
  const std::vector<glm::dvec3> path = PathOf(mind, step.path);
  const bool by_tip = step.by == StepBy::kTip;
  const PoseSearch search = SearchForPath(mind, path);
  const double off = OffPath(mind, "line_error");
  constexpr double kAbove = 1e-3;  // m, of a tip over the path, so that it touches lightly
  const std::vector<int> targets = TargetsOf(mind.exercise(), step);
  const glm::dvec3 portal = mind.joint.instrument_portal();
  const auto pose_at = [&](const glm::dvec3& x) {
    return PoseOfTip(portal, x + kAbove * glm::normalize(portal - x), 0);
  };
  if (by_tip) {
    LookAtWork(mind, targets, kFarthestLook);
    TouchTooHard(mind, targets.front());
    if (!mind.hands.Lead(DeviceRole::kInstrument, pose_at(path.front()))) return;
  } else {
    mind.hands.WithdrawInstrument();
    const auto start = PoseForPath(search);
    if (!start) return mind.Trouble("no roll and insertion follow the whole path");
    if (!mind.hands.Lead(DeviceRole::kScope, *start)) return;
  }
  for (std::size_t leg = 0; leg + 1 < path.size(); ++leg) {
    const double length = glm::distance(path[leg], path[leg + 1]);
    const int frames = FramesOf(1.875 * length / mind.options.speed);
    for (int i = 1; i <= frames && mind.IsRunning(); ++i) {
      const double s = MinimumJerk(static_cast<double>(i) / frames);
      const glm::dvec3 x = Beside(mind, path[leg] + s * (path[leg + 1] - path[leg]), off);
      if (by_tip) {
        RobotHands to = mind.hands.at();
        to.instrument = pose_at(x);
        mind.hands.Frame(to);
      } else {
        LookAt(mind, search, x);
      }
    }
  }
  WaitForStep(mind, kSettle);
  if (by_tip) mind.hands.WithdrawInstrument();
}

}  // namespace arthro::simulation
