// Resection: bites of basket forceps where they take most of the regions that is left, least of the
// rest, and where the jaws fit past the tissue at rest.
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include "simulation/practice/living_tissues.h"
#include "simulation/training/robot/steps/bite_plan.h"
#include "simulation/training/robot/steps/robot_mind.h"
#include "simulation/training/steps/exercise_index.h"

namespace arthro::simulation {
namespace {

constexpr double kAtPortal = 2e-3;  // m, insertion between two bites
constexpr double kRests = 0.4;      // s, in which tip and tissue come to rest before a bite
constexpr double kJaws = 0.3;       // s, in which jaws close or open
constexpr double kYields = 1.0;     // N at the tip, from which the hand yields
// Costs of a point of the rest, per point of the regions, from a careful bite to a bold one.
constexpr std::array kPauses = {4.0, 2.0, 1.0, 0.5};
// Share of what is left of the regions that a bite takes, before the next bolder one is tried.
constexpr double kWorthwhile = 0.08;
constexpr double kTried = 1e-3;   // m about a bite that was not worth it, in which none is tried
constexpr double kLeast = 2e-10;  // m³; a bite that takes less is not tried there again
constexpr int kMostBites = 60;

// Brings the drawn tip to where it is wanted, against what holds it.
void Settle(RobotMind& mind, const glm::dvec3& tip) {
  constexpr int kFrames = 30;
  constexpr double kGain = 0.1, kNear = 3e-4, kMost = 4e-3;
  glm::dvec3 to = tip;
  for (int i = 0; i < kFrames && mind.IsRunning(); ++i) {
    const ToolFrame& tool = InstrumentOf(mind);
    if (tool.peak_force > static_cast<float>(kYields)) return;
    const glm::dvec3 off = tip - glm::dvec3(tool.drawn_tip);
    if (glm::length(off) < kNear && i > 3) return;
    to += kGain * off;
    if (glm::distance(to, tip) > kMost) to = tip + kMost * glm::normalize(to - tip);
    RobotHands hands = mind.hands.at();
    hands.instrument = PoseOfTip(mind.joint.instrument_portal(), to, hands.instrument.roll);
    mind.hands.Frame(hands);
  }
}

// Slides the instrument along its rod to an insertion. Returns false where it stops, because its
// tip feels too much.
bool SlideTo(RobotMind& mind, double depth) {
  const double from = mind.hands.at().instrument.depth;
  const int frames = FramesOf(kPeakOfMean * std::abs(depth - from) / mind.options.speed);
  for (int i = 1; i <= frames && mind.IsRunning(); ++i) {
    if (InstrumentOf(mind).peak_force > static_cast<float>(kYields)) return false;
    RobotHands hands = mind.hands.at();
    hands.instrument.depth = from + MinimumJerk(static_cast<double>(i) / frames) * (depth - from);
    mind.hands.Frame(hands);
  }
  return true;
}

// Brings the hand to where its tip is held, so that nothing pulls at it.
void LetGo(RobotMind& mind) {
  const glm::dvec3 tip(InstrumentOf(mind).drawn_tip);
  mind.hands.Leg(DeviceRole::kInstrument,
                 PoseOfTip(mind.joint.instrument_portal(), tip, mind.hands.at().instrument.roll));
}

// Withdraws the instrument along its rod; where the tip is held, it sets out again from there.
void WithdrawJaws(RobotMind& mind) {
  constexpr int kMostTries = 10;
  LetGo(mind);
  for (int i = 0; i < kMostTries && mind.IsRunning() && !SlideTo(mind, kAtPortal); ++i) LetGo(mind);
  RodPose back = mind.hands.at().instrument;
  back.depth = kAtPortal;
  mind.hands.Leg(DeviceRole::kInstrument, back);
}

// A ball of the same size on the skin, a diameter and a half away from the region.
Ball BesideRegion(const SurfaceMesh& skin, const Ball& ball) {
  Ball beside = ball;
  double nearest = 1e9;
  for (const glm::dvec3& x : skin.vertices) {
    const double off = std::abs(glm::distance(x, ball.centre) - 3 * ball.radius);
    if (off >= nearest) continue;
    nearest = off;
    beside.centre = x;
  }
  return beside;
}

// Volumes that the attempt has taken, which a trainee sees in the picture.
struct TakenSoFar {
  double inside = 0, outside = 0;  // m³, of the regions
  explicit TakenSoFar(const RobotMind& mind) {
    for (const AttemptFrame& frame : mind.joint.frames()) {
      inside += static_cast<double>(frame.taken);
      outside += static_cast<double>(frame.taken_outside);
    }
  }
  double all() const { return inside + outside; }
};

void LeaveOut(std::vector<glm::dvec3>& middles, const glm::dvec3& tried) {
  std::erase_if(middles, [&](const glm::dvec3& x) { return glm::distance(x, tried) < kTried; });
}

struct Resection {
  RobotMind& mind;
  int tissue;  // in the scene
  BodyPlaces places;
  Rigid3 portal_from_body;
  std::vector<Ball> regions;  // to bite, frame of the body
  ToolShape shape = ShapeOf(ToolKind::kPunch);
  // Middles of bites that are still to be tried, per cost of a point of the rest.
  std::array<std::vector<glm::dvec3>, kPauses.size()> middles = EveryMiddle();

  std::array<std::vector<glm::dvec3>, kPauses.size()> EveryMiddle() const {
    std::array<std::vector<glm::dvec3>, kPauses.size()> each;
    each.fill(MiddlesOf(regions, portal_from_body));
    return each;
  }
  void TurnTo(std::vector<Ball> balls) {
    regions = std::move(balls);
    middles = EveryMiddle();
  }
  const BodyPicture* Picture() const {
    if (const WorldPicture* world = mind.joint.tissues())
      for (const BodyPicture& body : world->bodies)
        if (body.tissue == tissue && body.skin) return &body;
    return nullptr;
  }
  // Points of the tissue that is left, at rest.
  std::vector<TissuePoint> Points() const {
    const BodyPicture* picture = Picture();
    return PointsOf(picture == nullptr ? places.surface : picture->skin->surface, regions,
                    portal_from_body);
  }
  // The most careful bite that is worthwhile, else the most careful with a gain, and the number of
  // its cost.
  std::pair<Bite, std::size_t> Plan() const {
    const std::vector<TissuePoint> points = Points();
    const double wanted =
        static_cast<double>(std::ranges::count_if(points, &TissuePoint::is_wanted));
    std::pair<Bite, std::size_t> small;
    for (std::size_t cost = 0; cost < kPauses.size(); ++cost) {
      const Bite bite =
          BestBite(points, middles[cost], mind.joint.instrument_portal(), shape, kPauses[cost]);
      if (bite.gain > kWorthwhile * wanted) return {bite, cost};
      if (bite.gain > 0 && small.first.gain <= 0) small = {bite, cost};
    }
    return small;
  }
  // True where the jaws, where they have come to, hold as much of the regions and as little of the
  // rest as the bite was planned for. Tissue that yields is not where it was at rest.
  bool IsWorthIt(double rest) const {
    std::vector<TissuePoint> points = Points();
    if (const BodyPicture* picture = Picture())
      MoveWithSkin(points, picture->skin->surface.vertices, picture->positions, portal_from_body);
    return GainAt(points, mind.joint.instrument_portal(), glm::dvec3(InstrumentOf(mind).drawn_tip),
                  shape, rest) > 0;
  }
};

Resection ResectionOf(RobotMind& mind, int target) {
  const TargetPlace& place = mind.joint.places()[static_cast<std::size_t>(target)];
  const auto tissue = static_cast<std::size_t>(place.region_tissue);
  const LoadedScene& loaded = mind.joint.loaded();
  const Pose& pose = loaded.scene.tissues[tissue].pose;
  BodyPlaces places = PlacesOf(loaded.scene.tissues[tissue], OrEmpty(loaded.surfaces[tissue]));
  std::vector<Ball> regions;
  for (const int region : place.regions)
    regions.push_back(places.regions[static_cast<std::size_t>(region)].ball);
  return {mind, place.region_tissue, std::move(places), {pose.quaternion, pose.position}, regions};
}

// `is_careless`: the jaws close whatever they hold.
void TakeBite(Resection& work, const Bite& bite, std::size_t cost, bool is_careless) {
  RobotMind& mind = work.mind;
  RodPose pose = PoseOfTip(mind.joint.instrument_portal(), bite.tip, bite.roll);
  mind.hands.Close(false, kJaws);
  // Open jaws are wide: they turn at the portal, and go straight to the tissue and back.
  RodPose begin = pose;
  begin.depth = kAtPortal;
  if (!mind.hands.Lead(DeviceRole::kInstrument, begin)) return;
  if (SlideTo(mind, pose.depth)) Settle(mind, bite.tip);
  if (!mind.hands.Wait(kRests)) return;
  if (is_careless || work.IsWorthIt(std::max(kPauses[cost], 1.0))) {
    const double before = TakenSoFar(mind).all();
    mind.hands.Close(true, kJaws);
    if (TakenSoFar(mind).all() - before < kLeast)
      for (auto& middles : work.middles) LeaveOut(middles, bite.middle);
  } else {
    LeaveOut(work.middles[cost], bite.middle);
  }
  // Jaws that open in the tissue would catch it on the way back.
  WithdrawJaws(mind);
  mind.hands.Close(false, kJaws);
}

}  // namespace

void Do(RobotMind& mind, const ResectStep& step) {
  const std::vector<int> targets = TargetsOf(mind.exercise(), step);
  if (targets.empty()) return;
  LookAtWork(mind, targets, 0.1);
  mind.joint.SetInstrument(ToolKind::kPunch);
  TouchTooHard(mind, targets.front());
  Resection work = ResectionOf(mind, targets.front());
  const std::vector<Ball> marked = work.regions;
  // A novice takes a part that nobody marked, until it is more than a criterion allows.
  bool is_beside = mind.Has(RobotFault::kCutsOutside);
  const double most = mind.MostOf("taken_outside", "").value_or(0);
  if (is_beside) {
    std::vector<Ball> beside;
    beside.reserve(marked.size());
    for (const Ball& ball : marked) beside.push_back(BesideRegion(work.places.surface, ball));
    work.TurnTo(beside);
  }
  for (int bites = 0; bites < kMostBites && mind.IsRunning(); ++bites) {
    if (mind.joint.engine().strip().progress >= 1) break;
    const auto [bite, cost] = work.Plan();
    const bool is_good = bite.gain > 0;
    if (is_good) TakeBite(work, bite, cost, is_beside);
    if (is_beside && (!is_good || TakenSoFar(mind).outside > most)) {
      work.TurnTo(marked);
      is_beside = false;
    } else if (!is_good) {
      break;
    }
  }
  if (mind.IsRunning() && mind.joint.engine().strip().progress < 1)
    mind.Trouble("no bite takes more of the regions than of the rest");
  mind.hands.WithdrawInstrument();
  WaitForStep(mind, 1.0);
}

}  // namespace arthro::simulation
