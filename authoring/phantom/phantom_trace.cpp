#include "authoring/phantom/phantom_trace.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

#include "simulation/core/units.h"
#include "simulation/scope/rod_pose.h"

namespace arthro::authoring {
namespace {

using simulation::RodPose;
constexpr double kMm = kMetrePerMillimetre;
constexpr double kDuration = 12.0, kRate = 100.0;       // s, Hz
constexpr double kViewAngle = 30.0 * kRadianPerDegree;  // of the phantom's scope

// Least jerk between two rests.
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

// Where to hold a scope of view angle α at depth ρ so that `target` is in the middle of its
// picture, from the side `from` of it: the rod passes the target at δ = α − asin(ρ sin α /
// |target|), and is rolled until the view leans back to it. Of all turns the one nearest to
// `near_roll`.
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

}  // namespace

std::vector<ProbeContact> ProbeContacts(const Cavity& cavity, const PhantomTissue& meniscus) {
  std::vector<ProbeContact> contacts;
  // The condyle low on its medial side, seen from the instrument's portal.
  const Ellipsoid& condyle = cavity.condyle;
  const glm::dvec3 body = glm::normalize(glm::dvec3(0.45, 0.62, -0.65));
  const glm::dvec3 on_condyle = condyle.centre + condyle.portal_from_body * (body * condyle.radii);
  contacts.push_back({on_condyle, NormalAt(cavity, Surface::kCondyle, on_condyle), 1.5 * kMm,
                      5.0 * kMm, 5.2, 6.2});
  // The plateau in front of the cartilage layer.
  const double x = -1.0 * kMm, y = -16.0 * kMm;
  const glm::dvec3 on_plateau =
      cavity.plateau.portal_from_plateau * glm::dvec3(x, y, PlateauHeight(cavity.plateau, x, y));
  contacts.push_back({on_plateau, NormalAt(cavity, Surface::kPlateau, on_plateau), 2.0 * kMm,
                      5.0 * kMm, 7.0, 8.0});
  // The body of the meniscus, nearer to its free edge.
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
      {mesh.vertices[nearest], glm::normalize(normal), 1.5 * kMm, 2.5 * kMm, 8.9, 10.0});
  return contacts;
}

std::vector<TraceRow> MakeTrace(const Cavity& cavity, const PhantomTissue& meniscus,
                                double incision_spacing) {
  const glm::dvec3 instrument_portal(incision_spacing, 0.0, 0.0);
  // In, a look at the whole joint with a full roll, then after the probe from touch to touch.
  std::vector<Key<RodPose>> scope{{0.0, Pose4(8, -4, 0, 2)},
                                  {0.8, Pose4(6, -2, 0, 9)},
                                  {1.8, Pose4(4, 6, 60, 11)},
                                  {3.2, Pose4(2, -6, 250, 11)},
                                  {4.2, Pose4(0, 4, 400, 11)}};
  for (const ProbeContact& touch : ProbeContacts(cavity, meniscus)) {
    const RodPose aim = AimAt(touch.x_in_portal, 11.0 * kMm, kViewAngle,
                              glm::dvec3(-1.0, -0.4, 0.0), scope.back().value.roll);
    scope.push_back({touch.from_t, aim});
    scope.push_back({touch.to_t, aim});
  }
  scope.push_back({12.0, Pose4(4, 0, 450, 4)});
  // Each touch: over the point, in, a short slide, out along the normal.
  std::vector<Key<glm::dvec3>> tip{{0.0, instrument_portal + glm::dvec3(-1.0, 0.5, 3.0) * kMm},
                                   {3.4, instrument_portal + glm::dvec3(-1.0, 0.5, 3.0) * kMm},
                                   {4.3, glm::dvec3(24.0, 1.0, 13.0) * kMm}};
  for (const ProbeContact& touch : ProbeContacts(cavity, meniscus)) {
    const glm::dvec3 side =
        glm::normalize(glm::cross(touch.normal, glm::dvec3(0, 0, 1)) + glm::dvec3(1e-6, 0, 0));
    const glm::dvec3 in = touch.x_in_portal - touch.press * touch.normal;
    tip.push_back({touch.from_t, touch.x_in_portal + touch.lift * touch.normal});
    tip.push_back({touch.from_t + 0.4, in});
    tip.push_back({touch.to_t - 0.35, in + 1.0 * kMm * side});
    tip.push_back({touch.to_t, touch.x_in_portal + touch.lift * touch.normal + 1.0 * kMm * side});
  }
  tip.push_back({10.9, glm::dvec3(24.0, 1.0, 13.0) * kMm});
  tip.push_back({12.0, instrument_portal + glm::dvec3(-1.0, 0.5, 3.0) * kMm});

  const DeviceRig rig;  // the rig of a scene that names none
  std::vector<TraceRow> rows;
  for (int i = 0; i <= static_cast<int>(kDuration * kRate); ++i) {
    const double t = i / kRate;
    const RodPose scope_pose = At(scope, t, [](const RodPose& a, const RodPose& b, double s) {
      return RodPose{a.latitude + s * (b.latitude - a.latitude),
                     a.longitude + s * (b.longitude - a.longitude), a.roll + s * (b.roll - a.roll),
                     a.depth + s * (b.depth - a.depth)};
    });
    const glm::dvec3 x = At(
        tip, t, [](const glm::dvec3& a, const glm::dvec3& b, double s) { return a + s * (b - a); });
    const RodPose probe_pose = PoseOfTip(x - instrument_portal, 0.3 * std::sin(1.1 * t));
    rows.push_back(
        {t, true, HipFromRodPose(scope_pose, rig), HandleFromRodPose(scope_pose, rig), 0});
    rows.push_back(
        {t, false, HipFromRodPose(probe_pose, rig), HandleFromRodPose(probe_pose, rig), 0});
  }
  return rows;
}

}  // namespace arthro::authoring
