#include "app/steps/depth/touch_probe.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "app/steps/depth/depth_step.h"
#include "simulation/core/units.h"
#include "simulation/scope/rod_pose.h"
#include "simulation/tissue/body/elastic_layer.h"

namespace arthro::app {
namespace {

constexpr double kTick = 1e-3;      // s
constexpr double kApproach = 3e-3;  // m, free way in front of the surface
constexpr double kLeastApproach = 2e-4;
constexpr int kApproachTicks = 60;
constexpr double kSearch = 5e-3;  // m, behind the relief
constexpr double kStep = 5e-5;    // m per tick
constexpr int kPressTicks = 60;
constexpr double kReached = 3e-3;      // m, of the tip from the point before it presses
constexpr double kEndRadius = 5e-4;    // m, of the probe's end
constexpr double kLayerPress = 5e-5;   // m, at which a thin layer is read; its law is linear there
constexpr double kSightRadius = 1e-5;  // m; a line without one could pass between triangles

}  // namespace

std::vector<double> TipStiffness(const Scene& scene,
                                 const std::vector<simulation::TissuePreset>& presets) {
  std::vector<double> stiffness;
  for (const Tissue& tissue : scene.tissues) {
    stiffness.push_back(0);
    const simulation::TissuePreset* found = FindTissuePreset(presets, tissue.material);
    if (found == nullptr) continue;
    const simulation::TissuePreset preset = WithElasticity(*found, tissue.elasticity);
    const simulation::Material& material = preset.material;
    if (IsThinLayer(tissue, presets) && preset.layer_thickness > 0)
      stiffness.back() = simulation::ElasticLayer(material, preset.layer_thickness)
                             .PressFlat(kEndRadius, kLayerPress)
                             .force /
                         kLayerPress;
    else
      stiffness.back() = 2 * kEndRadius * material.young_modulus /
                         (1 - material.poisson_ratio * material.poisson_ratio);
  }
  return stiffness;
}

TouchProbe::TouchProbe(const LoadedScene& scene, const simulation::SessionOptions& options,
                       std::vector<double> stiffness)
    : session_(scene, options),
      stiffness_(std::move(stiffness)),
      contact_(options.contact.stiffness),
      rig_(scene.scene.rig.instrument),
      portal_(scene.scene.portals.incision_spacing, 0, 0) {
  // The ramp after arming, and the rise of the whole force.
  const simulation::LimiterOptions& limiter = options.limiter;
  for (std::size_t i = 0; i < scene.scene.tissues.size(); ++i) {
    const bool is_there = i < scene.surfaces.size() && scene.surfaces[i] != nullptr;
    tissues_.push_back(is_there
                           ? simulation::SurfaceBvh(*scene.surfaces[i], scene.scene.tissues[i].pose)
                           : simulation::SurfaceBvh());
  }
  settled_ = static_cast<int>(
      std::ceil((limiter.ramp_time + limiter.max_force / limiter.max_rise) / kTick));
}

void TouchProbe::Lead(const glm::dvec3& tip, int ticks) {
  const glm::dvec3 from = tip_;
  for (int i = 1; i <= ticks; ++i) {
    tip_ = glm::mix(from, tip, static_cast<double>(i) / ticks);
    const glm::dvec3 way = tip_ - portal_;
    const double depth = glm::length(way);
    const glm::dvec3 axis = depth > 0 ? way / depth : glm::dvec3(0, 0, 1);
    simulation::RodPose pose;
    pose.depth = depth;
    pose.latitude = -std::asin(std::clamp(axis.y, -1.0, 1.0));
    pose.longitude = std::atan2(axis.x, axis.z);
    simulation::DeviceSample sample;
    sample.t = t_ += kTick;
    sample.hip_in_device = simulation::HipFromRodPose(pose, rig_);
    sample.handle_in_device = simulation::HandleFromRodPose(pose, rig_);
    sample.valid = true;
    session_.Tick({}, sample, kTick);
  }
}

std::optional<TouchProbe::TissueHit> TouchProbe::TissueAlong(const authoring::Sight& sight,
                                                             double range) const {
  simulation::SweepHit hit;
  std::optional<TissueHit> found;
  for (std::size_t i = 0; i < tissues_.size(); ++i)
    if (!tissues_[i].empty() &&
        tissues_[i].Sweep(sight.eye, sight.eye + range * sight.direction, kSightRadius, -1, hit))
      found =
          TissueHit{static_cast<int>(i),
                    sight.eye + hit.fraction * range * sight.direction - kSightRadius * hit.normal,
                    hit.normal};
  return found;
}

TouchReading TouchProbe::Press(const glm::dvec3& point, double press) {
  return PressAlong(point, glm::normalize(point), press);
}

TouchReading TouchProbe::PressTissue(const glm::dvec3& point, int tissue, const glm::dvec3& normal,
                                     double press) {
  const auto index = static_cast<std::size_t>(tissue);
  const double soft = index < stiffness_.size() ? stiffness_[index] : 0.0;
  // Tissue and contact are springs in series: the contact gives its share of the way.
  TouchReading reading =
      PressAlong(point, -normal, soft > 0 ? press * soft / (soft + contact_) : press);
  reading.tissue = tissue;
  if (soft > 0 && reading.stiffness > 0) reading.stiffness = 1 / (1 / soft + 1 / reading.stiffness);
  return reading;
}

TouchReading TouchProbe::PressAlong(const glm::dvec3& point, const glm::dvec3& inwards,
                                    double press) {
  TouchReading reading;
  reading.point = point;
  reading.range = glm::length(point);
  const simulation::ToolState& tool = session_.snapshot().instrument;
  // In a narrow gap the place in front of one surface lies in the surface opposite.
  double free_way = 2 * kApproach;
  do {
    free_way /= 2;
    const glm::dvec3 before = point - free_way * inwards;
    session_.Tick({}, {}, kTick);  // the instrument enters anew, through its portal
    tip_ = portal_ + 1e-3 * glm::normalize(before - portal_);
    Lead(tip_, settled_);  // armed in free space
    Lead(before, kApproachTicks);
    reading.is_reached = glm::distance(tool.proxy_in_portal, before) < kReached;
  } while (tool.contact >= 0 && free_way > kLeastApproach);
  // The felt surface is smoothed, so it lies a little before or behind the relief.
  double depth = -free_way;
  while (tool.contact < 0 && depth < kSearch) Lead(point + (depth += kStep) * inwards, 1);
  Lead(point + (depth + press) * inwards, kPressTicks);
  Lead(point + (depth + press) * inwards, settled_);
  reading.tip_force = glm::length(tool.tip_force);
  reading.force = glm::length(tool.hand_force);
  if (reading.tip_force > 0) {
    reading.normal = tool.tip_force / reading.tip_force;
    const double given = glm::dot(tool.proxy_in_portal - tool.tip_in_portal, reading.normal);
    reading.stiffness = given > 0 ? reading.tip_force / given : 0.0;
  }
  return reading;
}

void ToggleTouch(EditorState& state) {
  TouchPreview& touch = state.steps.depth->touch;
  // From another page it is switched on, whatever it was there.
  touch.is_on = state.step != Step::kDepth || !touch.is_on;
  state.step = Step::kDepth;
  touch.reading.reset();
  if (touch.is_on && state.steps.depth->board.tool == MapTool::kBrush) LeaveDepthBrush(state);
  if (!touch.is_on) touch = {};
}

bool TouchesRelief(const EditorState& state) {
  return state.step == Step::kDepth && state.steps.depth->touch.is_on && state.document().depth &&
         !state.practice && !state.practice_only;
}

void KeepTouchFresh(EditorState& state, const simulation::SessionOptions& options) {
  TouchPreview& touch = state.steps.depth->touch;
  const authoring::Document& document = state.document();
  if (!TouchesRelief(state) || state.jobs.busy() || DepthIsUnderWay(state) ||
      (touch.depth == document.depth && touch.surfaces == document.surfaces &&
       touch.tissues == document.scene.tissues))
    return;
  touch.depth = document.depth;
  touch.surfaces = document.surfaces;
  touch.tissues = document.scene.tissues;
  touch.probe.reset();
  state.jobs.Start(
      "Touch preview",
      [document, options, stiffness = TipStiffness(document.scene, state.tissue_presets)](
          const Progress&) -> Jobs::Apply {
        auto probe = std::make_shared<TouchProbe>(document, options, stiffness);
        return [probe, depth = document.depth](EditorState& now) {
          if (now.steps.depth->touch.depth == depth) now.steps.depth->touch.probe = probe;
        };
      });
}

void TouchAlong(EditorState& state, const authoring::Sight& sight) {
  TouchPreview& touch = state.steps.depth->touch;
  touch.reading.reset();
  if (!touch.probe) return;
  const auto point = authoring::PointOnRelief(state.document(), sight);
  const double range = point ? glm::distance(point->x_in_portal, sight.eye)
                             : glm::length(sight.eye) + state.document().scene.backdrop.radius;
  if (const auto hit = touch.probe->TissueAlong(sight, range))
    touch.reading = touch.probe->PressTissue(hit->point, hit->tissue, hit->normal, touch.press);
  else if (point)
    touch.reading = touch.probe->Press(point->x_in_portal, touch.press);
}

std::string WordsOfTouch(const EditorState& state, const TouchReading& reading) {
  const auto& tissues = state.document().scene.tissues;
  std::string words = fmt::format("{:.1f} mm from the portal", MmFromMetres(reading.range));
  if (reading.tissue >= 0 && reading.tissue < static_cast<int>(tissues.size()))
    words = fmt::format("{}: {}", tissues[static_cast<std::size_t>(reading.tissue)].name, words);
  if (!(reading.tip_force > 0)) return words + "; the probe feels nothing here";
  // Tilt of the surface against the line from the portal.
  const double cosine =
      std::clamp(-glm::dot(reading.normal, glm::normalize(reading.point)), -1.0, 1.0);
  words +=
      fmt::format("; normal tilted by {:.0f}°; {:.2f} N/mm; {:.2f} N on the hand",
                  DegreesFromRadians(std::acos(cosine)), 1e-3 * reading.stiffness, reading.force);
  return reading.is_reached ? words : words + "; the rod meets something on its way";
}

}  // namespace arthro::app
