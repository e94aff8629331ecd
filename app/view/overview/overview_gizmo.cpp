// Arms and rings of the handle: a drag on the end of an arm moves what is held along its axis, a
// drag on a ring turns it about its axis.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <vtkProperty.h>

#include "app/view/overview/overview_impl.h"

namespace arthro::app {
namespace {

const glm::dvec3 kArmColours[3] = {{0.90, 0.35, 0.32}, {0.45, 0.80, 0.40}, {0.40, 0.58, 0.95}};
constexpr double kArmLength = 0.16, kRingRadius = 0.24;          // shares of the backdrop's radius
constexpr double kArmThickness = 3e-4, kRingThickness = 1.8e-4;  // m, radii of the bars
constexpr int kRingParts = 64;
constexpr double kArmGrab = 9, kRingGrab = 6;  // px at scale 1

// Whole multiple of a step; as it is where there is no step.
double Snapped(double value, double step) {
  return step > 0 ? std::round(value / step) * step : value;
}

}  // namespace

glm::dvec3 Overview::Parts::MiddleOf(const Model& model) const {
  double middle[3];
  model.data->GetCenter(middle);
  return model.pose * glm::dvec3(middle[0], middle[1], middle[2]);
}

glm::dvec3 Overview::Parts::AxisOf(const Model& model, int axis) const {
  glm::dvec3 unit(0.0);
  unit[axis] = 1.0;
  return arms == Arms::kOwn ? model.pose.quaternion * unit : unit;
}

glm::dvec3 Overview::Parts::ArmOf(const Model& model, int axis) const {
  return kArmLength * radius * AxisOf(model, axis);
}

std::vector<glm::dvec3> Overview::Parts::RingOf(const Model& model, int axis) const {
  const glm::dvec3 middle = MiddleOf(model), first = AxisOf(model, (axis + 1) % 3),
                   second = AxisOf(model, (axis + 2) % 3);
  std::vector<glm::dvec3> ring;
  for (int i = 0; i <= kRingParts; ++i) {
    const double a = 2 * std::numbers::pi * i / kRingParts;
    ring.push_back(middle + kRingRadius * radius * (std::cos(a) * first + std::sin(a) * second));
  }
  return ring;
}

void Overview::Parts::PlaceArms() {
  const Model* held_model = Held();
  for (int axis = 0; axis < 3; ++axis) {
    auto &arm = arm_actors[std::size_t(axis)], &ring = ring_actors[std::size_t(axis)];
    if (!arm) {
      arm = MakeActor(kArmColours[axis], 0.7);
      ring = MakeActor(kArmColours[axis], 0.7);
      ring->ForceTranslucentOn();
      ring->GetProperty()->SetOpacity(0.7);
      renderer->AddActor(arm);
      renderer->AddActor(ring);
    }
    arm->SetVisibility(held_model != nullptr ? 1 : 0);
    ring->SetVisibility(held_model != nullptr ? 1 : 0);
    if (held_model == nullptr) continue;
    const glm::dvec3 from = MiddleOf(*held_model), to = from + ArmOf(*held_model, axis);
    SetData(*arm, MakeBars({{from, to}}, kArmThickness));
    SetData(*ring, MakeBars({RingOf(*held_model, axis)}, kRingThickness, 6));
  }
}

void Overview::ShowArms(Arms arms) {
  if (parts_->arms == arms) return;
  parts_->arms = arms;
  parts_->PlaceArms();
  parts_->changed = true;
}

std::vector<glm::dvec2> Overview::ArmPlaces() const {
  const Parts& p = *parts_;
  std::vector<glm::dvec2> places;
  if (p.Held() == nullptr || p.height < 1) return places;
  const Parts::Model& model = *p.Held();
  for (int axis = 0; axis < 3; ++axis)
    places.push_back(PixelOf(p.MiddleOf(model) + p.ArmOf(model, axis)).value_or(glm::dvec2(-1e6)));
  return places;
}

std::vector<glm::dvec2> Overview::RingPlaces(int axis) const {
  const Parts& p = *parts_;
  std::vector<glm::dvec2> places;
  if (p.Held() == nullptr || p.height < 1) return places;
  for (const glm::dvec3& x : p.RingOf(*p.Held(), axis))
    places.push_back(PixelOf(x).value_or(glm::dvec2(-1e6)));
  return places;
}

// Poses what is held, and says so.
void Overview::PlaceHeld(const Pose& pose, bool is_finished) {
  Parts& p = *parts_;
  if (p.part.actor) {
    p.part.pose = pose;
    p.part.actor->SetUserMatrix(MatrixOf(pose));
    p.PlaceBox();
    p.changed = true;
    if (on_part) on_part(pose, is_finished);
    return;
  }
  if (on_pose) on_pose(p.chosen, pose, is_finished);
  SetTissuePose(p.chosen, pose);
}

bool Overview::DragArm(const PointerEvent& event) {
  Parts& p = *parts_;
  const glm::dvec2 at(event.x, event.y);
  using Kind = PointerEvent::Kind;
  if (event.kind == Kind::kPress) {
    if (event.button != PointerEvent::Button::kLeft) return false;
    const std::vector<glm::dvec2> ends = ArmPlaces();
    const auto near = [&](const glm::dvec2& end) {
      return glm::distance(end, at) <= kArmGrab * handle_scale;
    };
    const auto found = std::find_if(ends.begin(), ends.end(), near);
    if (found == ends.end()) return false;
    p.dragged_arm = static_cast<int>(found - ends.begin());
    p.drag_from = at;
    p.drag_pose = p.Held()->pose;
    return true;
  }
  if (p.dragged_arm < 0 || p.Held() == nullptr) return false;
  const bool is_finished = event.kind == Kind::kRelease;
  Parts::Model model = *p.Held();
  model.pose = p.drag_pose;
  const glm::dvec3 middle = p.MiddleOf(model), arm = p.ArmOf(model, p.dragged_arm);
  const auto from = PixelOf(middle), to = PixelOf(middle + arm);
  if (is_finished) p.dragged_arm = -1;
  if (!from || !to) return true;
  const glm::dvec2 way = *to - *from;
  const double length2 = glm::dot(way, way);
  constexpr double kLeastWay = 25;  // px²; an arm that points at the eye has no direction
  if (length2 < kLeastWay) return true;
  const double length = glm::length(arm);
  const double moved_by = glm::dot(at - p.drag_from, way) / length2 * length;
  Pose moved = p.drag_pose;
  moved.position += Snapped(moved_by, snap_step) * arm / length;
  PlaceHeld(moved, is_finished);
  return true;
}

// Angle about the ring's axis from the place where the drag began, rad.
double Overview::RingAngle(const glm::dvec2& at) const {
  const Parts& p = *parts_;
  Parts::Model model = *p.Held();
  model.pose = p.drag_pose;
  const glm::dvec3 middle = p.MiddleOf(model), axis = p.AxisOf(model, p.dragged_ring),
                   out = p.ring_from - middle;
  // Finds where the line of sight meets the plane of the ring, unless it runs along it.
  constexpr double kAlong = 0.2;
  const Line line = LineThrough(at.x, at.y);
  const double across = glm::dot(line.direction, axis);
  if (std::abs(across) > kAlong) {
    const glm::dvec3 hit =
        line.eye + glm::dot(middle - line.eye, axis) / across * line.direction - middle;
    return std::atan2(glm::dot(axis, glm::cross(out, hit)), glm::dot(out, hit));
  }
  constexpr double kSmall = 1e-3;  // rad
  const auto from = PixelOf(p.ring_from),
             to = PixelOf(p.ring_from + kSmall * glm::cross(axis, out));
  if (!from || !to || *from == *to) return 0;
  const glm::dvec2 way = (*to - *from) / kSmall;
  return glm::dot(at - *from, way) / glm::dot(way, way);
}

bool Overview::DragRing(const PointerEvent& event) {
  Parts& p = *parts_;
  const glm::dvec2 at(event.x, event.y);
  using Kind = PointerEvent::Kind;
  if (event.kind == Kind::kPress) {
    if (event.button != PointerEvent::Button::kLeft || p.Held() == nullptr) return false;
    double nearest = kRingGrab * handle_scale;
    for (int axis = 0; axis < 3; ++axis) {
      const std::vector<glm::dvec2> places = RingPlaces(axis);
      for (std::size_t i = 0; i < places.size(); ++i) {
        const double distance = glm::distance(places[i], at);
        if (distance > nearest) continue;
        nearest = distance;
        p.dragged_ring = axis;
        p.ring_from = p.RingOf(*p.Held(), axis)[i];
      }
    }
    if (p.dragged_ring < 0) return false;
    p.drag_pose = p.Held()->pose;
    p.ring_start = RingAngle(at);
    return true;
  }
  if (p.dragged_ring < 0 || p.Held() == nullptr) return false;
  const bool is_finished = event.kind == Kind::kRelease;
  Parts::Model model = *p.Held();
  model.pose = p.drag_pose;
  const glm::dvec3 middle = p.MiddleOf(model), axis = p.AxisOf(model, p.dragged_ring);
  const double angle =
      Snapped(std::remainder(RingAngle(at) - p.ring_start, 2 * std::numbers::pi), snap_turn);
  if (is_finished) p.dragged_ring = -1;
  const glm::dquat turn = glm::angleAxis(angle, axis);
  Pose moved = p.drag_pose;
  moved.quaternion = glm::normalize(turn * moved.quaternion);
  moved.position = middle + turn * (moved.position - middle);
  PlaceHeld(moved, is_finished);
  return true;
}

}  // namespace arthro::app
