#include "authoring/phantom/phantom_trace.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

#include "authoring/phantom/shape/crescent.h"
#include "simulation/core/units.h"
#include "simulation/scope/rod_pose.h"

namespace arthro::authoring {
namespace {

using simulation::RodPose;
constexpr double kDuration = 12.0, kRate = 100.0;       // s, Hz
constexpr double kViewAngle = 30.0 * kRadianPerDegree;  // oblique view of the phantom's scope

// Minimum-jerk interpolation between two rests [Flash & Hogan 1985].
double Ease(double t) {
  t = std::clamp(t, 0.0, 1.0);
  return t * t * t * (10.0 - 15.0 * t + 6.0 * t * t);
}

template <class T>
struct Key {
  double t;
  T value;
};

template <class T, class Blend>
T At(const std::vector<Key<T>>& keys, double t, const Blend& blend) {
  if (t <= keys.front().t) return keys.front().value;
  for (std::size_t i = 1; i < keys.size(); ++i)
    if (t <= keys[i].t)
      return blend(keys[i - 1].value, keys[i].value,
                   Ease((t - keys[i - 1].t) / (keys[i].t - keys[i - 1].t)));
  return keys.back().value;
}

RodPose Pose4(double latitude_deg, double longitude_deg, double roll_deg, double depth_mm) {
  return {RadiansFromDegrees(latitude_deg), RadiansFromDegrees(longitude_deg),
          RadiansFromDegrees(roll_deg), depth_mm * kMm};
}

RodPose PoseOfTip(const glm::dvec3& tip_from_portal, double roll) {
  const double depth = glm::length(tip_from_portal);
  return {-std::asin(tip_from_portal.y / depth), std::atan2(tip_from_portal.x, tip_from_portal.z),
          roll, depth};
}

// Pose of a scope with view angle α at depth ρ that centres `target` in its picture, from the side
// `from` of it. The rod passes the target at δ = α − asin(ρ sin α / |target|), and is rolled until
// the view leans back to it. Among equivalent turns, takes the one nearest to `near_roll`.
RodPose AimAt(const glm::dvec3& target, double depth, double view_angle, const glm::dvec3& from,
              double near_roll) {
  const double distance = glm::length(target);
  const glm::dvec3 x = target / distance;
  const glm::dvec3 side = glm::normalize(from - glm::dot(from, x) * x);
  const double delta = view_angle - std::asin(depth * std::sin(view_angle) / distance);
  RodPose pose = PoseOfTip(depth * (std::cos(delta) * x + std::sin(delta) * side), 0.0);
  const simulation::RodBasis basis = BasisOf(pose);
  constexpr double kTurn = 2.0 * std::numbers::pi;
  const double roll = std::atan2(glm::dot(x, basis.east), glm::dot(x, basis.north));
  pose.roll = roll + kTurn * std::round((near_roll - roll) / kTurn);
  return pose;
}

// Pose of the instrument: its tip in the portal frame and the turn of its hook.
struct HandPose {
  glm::dvec3 tip{0.0};
  double roll = 0;
};

// Motion of the lift: down beside the edge with the hook dipped below it, outwards under it, turned
// level, up, held, and drawn in until the edge slips off.
std::vector<Key<HandPose>> HookKeys(const EdgeLift& lift, const Cavity& cavity,
                                    const glm::dvec3& instrument_portal) {
  constexpr double kReach = 3.4 * kMm;                   // reach of a probe's hook from its rod
  constexpr double kDip = 35.0 * kRadianPerDegree;       // lowers the hook's end by 2 mm
  constexpr double kRaise = 10.0 * kRadianPerDegree;     // above level
  constexpr double kUnder = 3.2 * kMm, kUp = 2.0 * kMm;  // under the edge; rise of the hand
  // The hook is perpendicular to the rod; this is the most outward direction that allows.
  const RodPose rod = PoseOfTip(lift.x_in_portal - instrument_portal, 0.0);
  const simulation::RodBasis basis = BasisOf(rod);
  const glm::dvec3 level =
      glm::normalize(lift.outwards - glm::dot(lift.outwards, basis.axis) * basis.axis);
  const glm::dvec3 across = glm::cross(basis.axis, level);
  const glm::dvec3 raised = glm::dot(across, lift.up) > 0.0 ? across : -across;
  const auto roll_at = [&](double angle) {
    const glm::dvec3 hook = std::cos(angle) * level + std::sin(angle) * raised;
    return std::atan2(glm::dot(hook, basis.east), glm::dot(hook, basis.north));
  };
  // Position of the tip with the hook's end this far past the edge and this high over the plateau.
  const glm::dvec3 reach = kReach * (level - glm::dot(level, lift.up) * lift.up);
  const Rigid3 plateau_from_portal = Inverse(cavity.plateau.portal_from_plateau);
  const auto tip_at = [&](double past, double height) {
    const glm::dvec3 p = plateau_from_portal * (lift.x_in_portal + past * lift.outwards - reach);
    return cavity.plateau.portal_from_plateau *
           glm::dvec3(p.x, p.y, PlateauHeight(cavity.plateau, p.x, p.y, false) + height);
  };
  constexpr double kBefore = -3.5 * kMm, kOver = 4.0 * kMm;
  const double dipped = roll_at(-kDip), lifting = roll_at(kRaise);
  return {{lift.from_t, {tip_at(kBefore, kOver), dipped}},
          {lift.from_t + 0.4, {tip_at(kBefore, 0.0), dipped}},
          {lift.from_t + 1.1, {tip_at(kUnder, 0.0), dipped}},
          {lift.from_t + 1.45, {tip_at(kUnder, 0.0), lifting}},
          {lift.from_t + 1.9, {tip_at(kUnder, kUp), lifting}},
          {lift.from_t + 2.3, {tip_at(kUnder, kUp), lifting}},
          {lift.to_t, {tip_at(kBefore - 1.0 * kMm, kUp), lifting}}};
}

}  // namespace

std::vector<ProbeContact> ProbeContacts(const Cavity& cavity, const PhantomTissue& meniscus) {
  std::vector<ProbeContact> contacts;
  // Low point of the condyle on its medial side, seen from the instrument's portal.
  const Ellipsoid& condyle = cavity.condyle;
  const glm::dvec3 body = glm::normalize(glm::dvec3(0.45, 0.62, -0.65));
  const glm::dvec3 on_condyle = condyle.centre + condyle.portal_from_body * (body * condyle.radii);
  contacts.push_back({on_condyle, NormalAt(cavity, Surface::kCondyle, on_condyle), 1.5 * kMm,
                      5.0 * kMm, 3.75, 4.5});
  // Point of the plateau in front of the cartilage layer.
  const double x = -1.0 * kMm, y = -10.4 * kMm;
  const glm::dvec3 on_plateau =
      cavity.plateau.portal_from_plateau * glm::dvec3(x, y, PlateauHeight(cavity.plateau, x, y));
  contacts.push_back({on_plateau, NormalAt(cavity, Surface::kPlateau, on_plateau), 2.0 * kMm,
                      5.0 * kMm, 5.1, 5.9});
  // Body of the meniscus, nearer to its free edge.
  const auto named = [&](const char* name) {
    return std::find_if(meniscus.landmarks.begin(), meniscus.landmarks.end(),
                        [&](const Landmark& l) { return l.name == name; })
        ->x_in_portal;
  };
  const glm::dvec3 guess =
      0.6 * named("meniscus body, free edge") + 0.4 * named("meniscus body, outer rim");
  const SurfaceMesh mesh = InPortal(meniscus);
  std::size_t nearest = 0;
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
    if (glm::distance(mesh.vertices[i], guess) < glm::distance(mesh.vertices[nearest], guess))
      nearest = i;
  glm::dvec3 normal(0.0);
  for (const auto& [a, b, c] : mesh.triangles)
    if (std::min({std::abs(a - static_cast<int>(nearest)), std::abs(b - static_cast<int>(nearest)),
                  std::abs(c - static_cast<int>(nearest))}) == 0)
      normal +=
          glm::cross(mesh.vertices[b] - mesh.vertices[a], mesh.vertices[c] - mesh.vertices[a]);
  contacts.push_back(
      {mesh.vertices[nearest], glm::normalize(normal), 1.5 * kMm, 2.5 * kMm, 6.6, 7.4});
  return contacts;
}

EdgeLift LiftOfEdge(const Cavity& cavity) {
  // Angle between body and posterior horn: most tears lie there, and a hook from the front is
  // nearly perpendicular to the edge.
  constexpr double kAngle = 55.0 * kRadianPerDegree;
  const Crescent crescent = MakeCrescent(cavity);
  const double edge = OuterRadius(crescent, kAngle) - WedgeAt(crescent, kAngle).width;
  const glm::dquat& turn = cavity.plateau.portal_from_plateau.rotation;
  EdgeLift lift;
  lift.x_in_portal =
      cavity.plateau.portal_from_plateau * OnPlateau(cavity, crescent, kAngle, edge, 0.0);
  lift.outwards = turn * glm::dvec3(std::cos(kAngle), std::sin(kAngle), 0.0);
  lift.up = turn * glm::dvec3(0.0, 0.0, 1.0);
  return lift;
}

std::vector<TraceRow> MakeTrace(const Cavity& cavity, const PhantomTissue& meniscus,
                                double incision_spacing) {
  const glm::dvec3 instrument_portal(incision_spacing, 0.0, 0.0);
  const std::vector<ProbeContact> touches = ProbeContacts(cavity, meniscus);
  const EdgeLift lift = LiftOfEdge(cavity);
  // The scope goes in, surveys the whole joint with a full roll, and follows the probe from touch
  // to touch.
  std::vector<Key<RodPose>> scope{{0.0, Pose4(8, -4, 0, 2)},
                                  {0.7, Pose4(6, -2, 20, 9)},
                                  {1.4, Pose4(4, 6, 110, 11)},
                                  {2.4, Pose4(2, -6, 260, 11)},
                                  {3.2, Pose4(0, 4, 370, 11)}};
  const auto look_at = [&scope](const glm::dvec3& x, double from_t, double to_t) {
    const RodPose aim =
        AimAt(x, 11.0 * kMm, kViewAngle, glm::dvec3(-1.0, -0.4, 0.0), scope.back().value.roll);
    scope.push_back({from_t, aim});
    scope.push_back({to_t, aim});
  };
  for (const ProbeContact& touch : touches) look_at(touch.x_in_portal, touch.from_t, touch.to_t);
  look_at(lift.x_in_portal, lift.from_t, lift.to_t);
  scope.push_back({12.0, Pose4(4, 0, 450, 4)});

  const HandPose outside{instrument_portal + glm::dvec3(-1.0, 0.5, 3.0) * kMm, 0.0};
  const HandPose inside{glm::dvec3(16.0, 0.5, 13.0) * kMm, 0.2};
  std::vector<Key<HandPose>> hand{{0.0, outside}, {2.4, outside}, {3.2, inside}};
  // Each touch: over the point, in, a short slide, out along the normal.
  for (const ProbeContact& touch : touches) {
    const glm::dvec3 side =
        glm::normalize(glm::cross(touch.normal, glm::dvec3(0, 0, 1)) + glm::dvec3(1e-6, 0, 0));
    const glm::dvec3 over = touch.x_in_portal + touch.lift * touch.normal,
                     in = touch.x_in_portal - touch.press * touch.normal;
    hand.push_back({touch.from_t, {over, 0.2}});
    hand.push_back({touch.from_t + 0.35, {in, 0.1}});
    hand.push_back({touch.to_t - 0.25, {in + 1.0 * kMm * side, -0.1}});
    hand.push_back({touch.to_t, {over + 1.0 * kMm * side, -0.2}});
  }
  const std::vector<Key<HandPose>> hook = HookKeys(lift, cavity, instrument_portal);
  hand.insert(hand.end(), hook.begin(), hook.end());
  hand.push_back({12.0, outside});

  const DeviceRig rig;  // rig of a scene that names none
  std::vector<TraceRow> rows;
  for (int i = 0; i <= static_cast<int>(kDuration * kRate); ++i) {
    const double t = i / kRate;
    const RodPose scope_pose = At(scope, t, [](const RodPose& a, const RodPose& b, double s) {
      return RodPose{a.latitude + s * (b.latitude - a.latitude),
                     a.longitude + s * (b.longitude - a.longitude), a.roll + s * (b.roll - a.roll),
                     a.depth + s * (b.depth - a.depth)};
    });
    const HandPose held = At(hand, t, [](const HandPose& a, const HandPose& b, double s) {
      return HandPose{a.tip + s * (b.tip - a.tip), a.roll + s * (b.roll - a.roll)};
    });
    const RodPose probe_pose = PoseOfTip(held.tip - instrument_portal, held.roll);
    rows.push_back(
        {t, true, HipFromRodPose(scope_pose, rig), HandleFromRodPose(scope_pose, rig), 0});
    rows.push_back(
        {t, false, HipFromRodPose(probe_pose, rig), HandleFromRodPose(probe_pose, rig), 0});
  }
  return rows;
}

}  // namespace arthro::authoring
