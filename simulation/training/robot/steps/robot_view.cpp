// Steps that are done with the scope, and views of the work with the instrument.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "simulation/training/robot/steps/robot_mind.h"
#include "simulation/training/steps/exercise_index.h"
#include "simulation/training/steps/path_pieces.h"

namespace arthro::simulation {
namespace {

constexpr double kMargin = 1e-3;  // m, within the distances that a step allows
constexpr double kAngleMargin = RadiansFromDegrees(5);
constexpr double kBeside = 0.2;  // radii of the picture, of a target that is off the centre

TargetPlace PlaceOfTarget(const RobotMind& mind, int target) {
  TargetPlace place = mind.joint.places()[static_cast<std::size_t>(target)];
  if (place.is_loose) place = TargetInBall(mind.PlaceNow(target), place.radius);
  return place;
}

bool IsWithin(double x, const glm::dvec2& range, double margin) {
  return x >= range.x + margin && x <= range.y - margin;
}

const std::string& IdOf(const RobotMind& mind, int target) {
  return mind.exercise().targets[static_cast<std::size_t>(target)].id;
}

std::string AngleWords(const RobotMind& mind) {
  return fmt::format("{:.0f}°", mind.joint.view_angle() * 180 / std::numbers::pi);
}

// The pose turned until the target lies beside the centre.
RodPose BesideCentre(const PoseSearch& search, RodPose pose) {
  constexpr double kStep = 0.005;
  for (int i = 0; i < 100 && search.See(pose).target[0].centre < static_cast<float>(kBeside); ++i)
    pose.latitude += kStep;
  return pose;
}

struct Wanted {
  glm::dvec2 distance;
  double incidence, hold;
};

// Shows each target of a step in turn.
void ShowEach(RobotMind& mind, const ExerciseStep& step, const Wanted& wanted) {
  mind.hands.WithdrawInstrument();
  for (const int target : TargetsOf(mind.exercise(), step)) {
    if (!mind.IsRunning()) return;
    const PoseSearch search = mind.Search({PlaceOfTarget(mind, target)});
    auto pose = search.Best(0, [&](const ScopeLook& look) -> std::optional<double> {
      if (!IsWithin(look.sight.distance, wanted.distance, kMargin)) return std::nullopt;
      if (look.sight.incidence > wanted.incidence - kAngleMargin) return std::nullopt;
      return look.sight.incidence;
    });
    if (!pose) {
      mind.Trouble(
          fmt::format("no pose sees target \"{}\" with {}", IdOf(mind, target), AngleWords(mind)));
      continue;
    }
    if (mind.Has(RobotFault::kOffCentre)) pose = BesideCentre(search, *pose);
    if (!mind.hands.Lead(DeviceRole::kScope, *pose)) return;
    WaitForStep(mind, wanted.hold + kSettle);
  }
}

// Poses from which the tip hardly moves while it sees a ring of targets.
std::vector<RodPose> RingPoses(const PoseSearch& search, const PeriscopeStep& step) {
  std::vector<RodPose> best;
  double least = step.tip_within - kMargin;
  constexpr double kFiner = RadiansFromDegrees(15);
  for (const double insertion : PoseSearch::Insertions()) {
    std::vector<std::vector<RodPose>> looks(static_cast<std::size_t>(search.count()));
    for (int target = 0; target < search.count(); ++target)
      for (int i = 0; i < 24; ++i)
        if (const auto look = search.At(target, i * kFiner, insertion);
            look && IsWithin(look->sight.distance, step.distance, kMargin))
          looks[static_cast<std::size_t>(target)].push_back(look->pose);
    for (const RodPose& anchor : looks.front()) {
      std::vector<RodPose> ring{anchor};
      double farthest = 0;
      for (std::size_t i = 1; i < looks.size() && farthest < least; ++i) {
        double nearest = least;
        for (const RodPose& pose : looks[i]) {
          const double d = glm::distance(TipInOwnPortal(pose), TipInOwnPortal(anchor));
          if (d >= nearest) continue;
          nearest = d;
          ring.resize(i);
          ring.push_back(pose);
        }
        farthest = std::max(farthest, nearest);
      }
      if (ring.size() < looks.size() || farthest >= least) continue;
      least = farthest;
      best = ring;
    }
  }
  return best;
}

}  // namespace

void Do(RobotMind& mind, const SeeStep& step) {
  ShowEach(mind, step, {step.distance, step.incidence, step.hold});
}

void Do(RobotMind& mind, const HoldStep& step) {
  ShowEach(mind, step, {step.distance, std::numbers::pi, step.hold});
}

void Do(RobotMind& mind, const TelescopeStep& step) {
  mind.hands.WithdrawInstrument();
  const int target = TargetsOf(mind.exercise(), step).front();
  const PoseSearch search = mind.Search({PlaceOfTarget(mind, target)});
  const double near = step.near - 0.5 * kMargin, far = step.far + 0.5 * kMargin;
  // A roll with a run of insertions from the far distance to the near one.
  std::optional<RodPose> from, to;
  constexpr double kFirst = 5e-4, kStep = 1e-3;
  double least = 0;
  for (const double roll : PoseSearch::Rolls()) {
    std::optional<RodPose> start;
    for (double insertion = kFirst; insertion < kFarthestLook; insertion += kStep) {
      const auto look = search.At(0, roll, insertion);
      if (!look) {
        start.reset();
        continue;
      }
      if (look->sight.distance >= static_cast<float>(far)) start = look->pose;
      if (!start || look->sight.distance > static_cast<float>(near)) continue;
      if (!from || look->sight.incidence < least)
        least = look->sight.incidence, from = start, to = look->pose;
      break;
    }
  }
  if (!from)
    return mind.Trouble(fmt::format("no roll lets the scope go from {:g} to {:g} mm of \"{}\"",
                                    1e3 * step.far, 1e3 * step.near, IdOf(mind, target)));
  if (!mind.hands.Lead(DeviceRole::kScope, *from)) return;
  const int frames = FramesOf(1.875 * (to->depth - from->depth) / mind.options.speed);
  for (int leg = 0; leg < 2 * step.cycles + 2 && mind.IsRunning(); ++leg) {
    for (int i = 1; i <= frames && mind.IsRunning(); ++i) {
      const double share = MinimumJerk(static_cast<double>(i) / frames);
      RobotHands hands = mind.hands.at();
      const double s = leg % 2 == 0 ? share : 1 - share;
      hands.scope.depth = from->depth + s * (to->depth - from->depth);
      if (const auto pose = search.Centred(hands.scope, search.Place(0))) hands.scope = *pose;
      if (!mind.hands.Frame(hands)) return;
    }
    WaitForStep(mind, kSettle);
  }
}

void Do(RobotMind& mind, const PeriscopeStep& step) {
  mind.hands.WithdrawInstrument();
  mind.joint.SetViewAngle(step.view_angle);
  mind.hands.Wait(kSettle);
  std::vector<TargetPlace> places;
  for (const int target : TargetsOf(mind.exercise(), step))
    places.push_back(PlaceOfTarget(mind, target));
  const std::vector<RodPose> ring = RingPoses(mind.Search(places), step);
  if (ring.empty())
    return mind.Trouble(
        fmt::format("no place of the tip sees the whole ring with {}", AngleWords(mind)));
  if (!mind.hands.Lead(DeviceRole::kScope, ring.front())) return;
  for (std::size_t i = 0; i < ring.size() && mind.IsRunning(); ++i) {
    RodPose next = ring[i];
    next.roll = mind.hands.at().scope.roll +
                std::remainder(next.roll - mind.hands.at().scope.roll, 2 * std::numbers::pi);
    if (!mind.hands.Leg(DeviceRole::kScope, next)) return;
    WaitForStep(mind, step.hold + kSettle);
  }
}

void LookAtWork(RobotMind& mind, const std::vector<int>& targets, double farthest) {
  constexpr double kRim = 0.85;     // radii of the picture, within which work is done
  constexpr double kLifted = 1e-2;  // m, of a tip on its way to a target
  constexpr double kUnseen = 0.3;   // cost of a way that is not seen, in radii of the picture
  std::vector<TargetPlace> places;
  places.reserve(targets.size());
  for (const int target : targets) places.push_back(PlaceOfTarget(mind, target));
  const int count = static_cast<int>(places.size());
  if (count == 0 || 2 * count > kMostTargets) return;
  const glm::dvec3 portal = mind.joint.instrument_portal();
  for (const int target : targets) {
    const glm::dvec3 x = mind.PlaceNow(target);
    places.push_back(TargetInBall(x + kLifted * glm::normalize(portal - x), kPieceLength));
  }
  const PoseSearch search = mind.Search(places);
  const auto cost_of = [&](const RodPose& pose) -> std::optional<double> {
    const Observation seen = search.See(pose);
    double worst = 0, unseen = 0;
    for (int i = 0; i < search.count(); ++i) {
      const PointSight& sight = seen.target[static_cast<std::size_t>(i)];
      const bool is_good = sight.is_clear && sight.centre <= static_cast<float>(kRim) &&
                           sight.distance <= static_cast<float>(farthest) &&
                           sight.distance >= static_cast<float>(8 * kMargin);
      if (i < count && !is_good) return std::nullopt;
      if (i < count) worst = std::max(worst, static_cast<double>(sight.centre));
      if (!is_good) unseen += kUnseen;
    }
    return worst + unseen;
  };
  if (const auto now = cost_of(mind.hands.at().scope); now && *now <= kRim) return;
  std::optional<RodPose> best;
  double least = 0;
  for (int i = 0; i < count; ++i) {
    const auto pose = search.Best(i, [&](const ScopeLook& look) { return cost_of(look.pose); });
    if (!pose) continue;
    const double cost = *cost_of(*pose);
    if (best && cost >= least) continue;
    least = cost;
    best = pose;
  }
  if (!best) return mind.Trouble("no pose of the scope sees the work of the instrument");
  mind.hands.Lead(DeviceRole::kScope, *best);
}

void RamScope(RobotMind& mind, double force) {
  const RodPose before = mind.hands.at().scope;
  constexpr double kPerFrame = 5e-4;  // m
  for (int i = 0; i < 200; ++i) {
    if (mind.joint.frame().tool[Index(DeviceRole::kScope)].peak_force > static_cast<float>(force))
      break;
    RobotHands to = mind.hands.at();
    to.scope.depth += kPerFrame;
    if (!mind.hands.Frame(to)) return;
  }
  mind.hands.Leg(DeviceRole::kScope, before);
}

}  // namespace arthro::simulation
