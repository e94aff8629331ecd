#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <vtkCamera.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkTransform.h>

#include "app/view/drawing/loose_body_model.h"
#include "app/view/drawing/srgb.h"
#include "app/view/overview/overview_impl.h"
#include "simulation/core/error.h"
#include "simulation/core/units.h"

namespace arthro::app {
namespace {

const glm::dvec3 kFreshColour{0.97, 0.93,
                              0.84};  // a cut face is paler, like the inside of a tissue

}  // namespace

vtkSmartPointer<vtkMatrix4x4> MatrixOf(const Pose& pose) {
  const glm::dmat3 rotation = glm::mat3_cast(pose.quaternion);
  auto matrix = vtkSmartPointer<vtkMatrix4x4>::New();
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) matrix->SetElement(r, c, pose.scale * rotation[c][r]);
    matrix->SetElement(r, 3, pose.position[r]);
  }
  return matrix;
}

Pose PoseOf(const vtkMatrix4x4& matrix) {
  glm::dmat3 linear;
  Pose pose;
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) linear[c][r] = matrix.GetElement(r, c);
    pose.position[r] = matrix.GetElement(r, 3);
  }
  pose.scale = std::cbrt(glm::determinant(linear));
  // The box keeps its right angles, apart from rounding.
  const glm::dvec3 x = glm::normalize(linear[0]);
  const glm::dvec3 y = glm::normalize(linear[1] - glm::dot(linear[1], x) * x);
  pose.quaternion = glm::normalize(glm::quat_cast(glm::dmat3(x, y, glm::cross(x, y))));
  return pose;
}

Overview::Parts::Model* Overview::Parts::Held() {
  if (chosen < 0) return nullptr;
  Model& held_model = part.actor ? part : tissues[std::size_t(chosen)];
  return held_model.surface.triangles.empty() || held_model.is_hidden ? nullptr : &held_model;
}

void Overview::Parts::PlaceBox() {
  PlaceArms();
  if (Held() == nullptr) {
    box->Off();
    return;
  }
  // The box is that of the resting surface in its own frame; its transform is the pose.
  Model& model = *Held();
  double bounds[6];
  model.data->GetBounds(bounds);
  box_look->PlaceWidget(bounds);
  vtkNew<vtkTransform> transform;
  transform->SetMatrix(MatrixOf(model.pose));
  box_look->SetTransform(transform);
  box->On();
}

void Overview::SetTissues(std::span<const Tissue> tissues,
                          std::span<const SharedSurface> surfaces) {
  Parts& p = *parts_;
  for (const auto& model : p.tissues) p.renderer->RemoveActor(model.actor);
  ShowMarks(-1, {});
  p.tissues.clear();
  for (std::size_t i = 0; i < tissues.size(); ++i) {
    Parts::Model model;
    if (i < surfaces.size()) model.surface = OrEmpty(surfaces[i]);
    model.pose = tissues[i].pose;
    model.data = MakeSurfaceData(model.surface);
    const glm::dvec3& c = tissues[i].colour;
    // Slightly darker than in the joint, where light comes from the front only.
    model.actor =
        MakeActor(0.9 * glm::dvec3(SrgbFromLinear(c.x), SrgbFromLinear(c.y), SrgbFromLinear(c.z)));
    model.actor->GetProperty()->SetSpecular(0.06);
    model.actor->GetProperty()->SetSpecularPower(25);
    SetData(*model.actor, model.data);
    model.actor->SetUserMatrix(MatrixOf(model.pose));
    p.renderer->AddActor(model.actor);
    p.tissues.push_back(std::move(model));
  }
  if (p.chosen >= static_cast<int>(p.tissues.size())) p.chosen = -1;
  p.PlaceBox();
  p.changed = true;
}

void Overview::SetTissuePose(int index, const Pose& portal_from_tissue) {
  Parts& p = *parts_;
  auto& model = p.tissues.at(static_cast<std::size_t>(index));
  model.pose = portal_from_tissue;
  model.actor->SetUserMatrix(MatrixOf(model.pose));
  // The box under the pointer follows the pointer.
  if (index == p.chosen && !p.dragging) p.PlaceBox();
  if (index == p.chosen) p.PlaceArms();
  if (index == p.marked)
    for (const auto& mark : p.marks) mark->SetUserMatrix(MatrixOf(model.pose));
  p.changed = true;
}

bool Overview::SetTissueShape(int index, std::span<const glm::dvec3> positions,
                              std::span<const glm::dvec3> normals) {
  auto& model = parts_->tissues.at(static_cast<std::size_t>(index));
  if (positions.size() != model.surface.vertices.size() ||
      (!normals.empty() && normals.size() != positions.size()))
    throw Error(Code::kBadArgument,
                fmt::format("tissue {} was given {} vertices to draw; its "
                            "surface has {}",
                            index, positions.size(), model.surface.vertices.size()));
  if (std::equal(positions.begin(), positions.end(), model.surface.vertices.begin())) return false;
  model.surface.vertices.assign(positions.begin(), positions.end());
  MoveSurfaceData(*model.data, model.surface, normals);
  parts_->changed = true;
  return true;
}

void Overview::SetTissueSurface(int index, const SurfaceMesh& surface,
                                std::span<const std::uint8_t> fresh) {
  auto& model = parts_->tissues.at(static_cast<std::size_t>(index));
  model.surface = surface;
  model.data = MakeSurfaceData(surface);
  double own[3];
  model.actor->GetProperty()->GetColor(own);
  ColourVertices(*model.data, {own[0], own[1], own[2]}, kFreshColour, fresh);
  SetData(*model.actor, model.data);
  parts_->changed = true;
}

void Overview::ShowTissue(int index, bool is_shown) {
  Parts& p = *parts_;
  auto& model = p.tissues.at(static_cast<std::size_t>(index));
  if (model.is_hidden != is_shown) return;
  model.is_hidden = !is_shown;
  model.actor->SetVisibility(is_shown ? 1 : 0);
  if (index == p.chosen) p.PlaceBox();
  p.changed = true;
}

void Overview::ChooseTissue(int index) {
  Parts& p = *parts_;
  if (index >= static_cast<int>(p.tissues.size())) index = -1;
  if (index == p.chosen) return;
  p.chosen = index;
  p.PlaceBox();
  p.changed = true;
}

void Overview::ShowPart(const SharedSurface& surface, const Pose& portal_from_part) {
  Parts& p = *parts_;
  if (p.dragging || p.dragged_arm >= 0) return;
  const bool is_same_surface = surface == p.part_surface;
  if (is_same_surface && (!surface || portal_from_part == p.part.pose)) return;
  if (!is_same_surface && p.part.actor) {
    p.renderer->RemoveActor(p.part.actor);
    p.part = {};
  }
  p.part_surface = surface;
  if (surface) {
    if (!p.part.actor) {
      p.part.surface = *surface;
      p.part.data = MakeSurfaceData(p.part.surface);
      p.part.actor = MakeActor({1.0, 0.85, 0.3});
      p.part.actor->ForceTranslucentOn();
      p.part.actor->GetProperty()->SetOpacity(0.35);
      SetData(*p.part.actor, p.part.data);
      p.renderer->AddActor(p.part.actor);
    }
    p.part.pose = portal_from_part;
    p.part.actor->SetUserMatrix(MatrixOf(portal_from_part));
  }
  p.PlaceBox();
  p.changed = true;
}

// Balls that hold a tissue are small on it; regions may be larger than it, and are drawn fainter.
constexpr double kSmallBall = 4e-3, kBallOpacity = 0.6;  // m, opacity of small ones

void Overview::ShowBalls(int tissue, std::span<const Ball> balls, int chosen) {
  Parts& p = *parts_;
  if (tissue >= static_cast<int>(p.tissues.size())) tissue = -1;
  const bool is_shown = tissue >= 0 && !balls.empty();
  const Pose pose = is_shown ? p.tissues[std::size_t(tissue)].pose : Pose{};
  const bool is_same = is_shown == p.shows_balls && chosen == p.chosen_ball &&
                       std::equal(balls.begin(), balls.end(), p.balls.begin(), p.balls.end()) &&
                       pose.position == p.balls_pose.position &&
                       pose.quaternion == p.balls_pose.quaternion &&
                       pose.scale == p.balls_pose.scale;
  if (is_same) return;
  p.shows_balls = is_shown;
  p.chosen_ball = chosen;
  p.balls.assign(balls.begin(), balls.end());
  p.balls_pose = pose;
  std::vector<Ball> others, lit;
  for (std::size_t i = 0; i < balls.size(); ++i)
    (static_cast<int>(i) == chosen ? lit : others).push_back(balls[i]);
  for (const auto& [actor, some] :
       {std::pair{p.held.Get(), &others}, {p.held_chosen.Get(), &lit}}) {
    SetData(*actor, MakeSurfaceData(MakeBalls(*some)));
    double widest = kSmallBall;
    for (const Ball& ball : *some) widest = std::max(widest, ball.radius * pose.scale);
    const double least = some == &lit ? 0.4 : 0.2;
    actor->GetProperty()->SetOpacity(std::max(least, kBallOpacity * kSmallBall / widest));
    actor->SetUserMatrix(MatrixOf(pose));
    actor->SetVisibility(is_shown && !some->empty() ? 1 : 0);
  }
  p.changed = true;
}

void Overview::ShowLooseBodies(std::span<const Ball> bodies) {
  Parts& p = *parts_;
  if (std::ranges::equal(bodies, p.loose)) return;
  if (!std::ranges::equal(bodies, p.loose, {}, &Ball::radius, &Ball::radius)) {
    for (const auto& actor : p.loose_actors) p.renderer->RemoveActor(actor);
    p.loose_actors.clear();
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      const glm::dvec3 c = LooseBodyTissue(bodies[i]).colour;
      p.loose_actors.push_back(
          MakeActor({SrgbFromLinear(c.x), SrgbFromLinear(c.y), SrgbFromLinear(c.z)}));
      SetData(*p.loose_actors.back(),
              MakeSurfaceData(MakeLooseBody(bodies[i].radius, static_cast<int>(i))));
      p.renderer->AddActor(p.loose_actors.back());
    }
  }
  p.loose.assign(bodies.begin(), bodies.end());
  for (std::size_t i = 0; i < bodies.size(); ++i)
    p.loose_actors[i]->SetUserMatrix(MatrixOf(LooseBodyTissue(bodies[i]).pose));
  p.changed = true;
}

namespace {

// World coordinates of a pixel on the near plane (0) or the far one (1).
glm::dvec3 WorldAt(vtkRenderer& renderer, double x, double y_from_below, double depth) {
  double world[4];
  renderer.SetDisplayPoint(x, y_from_below, depth);
  renderer.DisplayToWorld();
  renderer.GetWorldPoint(world);
  return glm::dvec3(world[0], world[1], world[2]) / world[3];
}

}  // namespace

Overview::Line Overview::LineThrough(double x, double y) const {
  const Parts& p = *parts_;
  const glm::dvec3 near = WorldAt(*p.renderer, x, p.height - 1 - y, 0),
                   far = WorldAt(*p.renderer, x, p.height - 1 - y, 1);
  vtkCamera* camera = p.renderer->GetActiveCamera();
  double eye[3];
  camera->GetPosition(eye);
  const double edge = camera->GetUseHorizontalViewAngle() ? p.width : p.height;
  const double focal = 0.5 * edge / std::tan(0.5 * RadiansFromDegrees(camera->GetViewAngle()));
  return {{eye[0], eye[1], eye[2]}, glm::normalize(far - near), focal};
}

std::optional<glm::dvec2> Overview::PixelOf(const glm::dvec3& x_in_portal) const {
  const Parts& p = *parts_;
  double eye[3], forward[3], display[3];
  vtkCamera* camera = p.renderer->GetActiveCamera();
  camera->GetPosition(eye);
  camera->GetDirectionOfProjection(forward);
  const glm::dvec3 way = x_in_portal - glm::dvec3(eye[0], eye[1], eye[2]);
  if (!(glm::dot(way, glm::dvec3(forward[0], forward[1], forward[2])) > 0)) return std::nullopt;
  p.renderer->SetWorldPoint(x_in_portal.x, x_in_portal.y, x_in_portal.z, 1.0);
  p.renderer->WorldToDisplay();
  p.renderer->GetDisplayPoint(display);
  return glm::dvec2(display[0], p.height - 1 - display[1]);
}

std::optional<glm::dvec2> Overview::HandlePlace() const {
  const Parts& p = *parts_;
  if (p.Held() == nullptr || p.height < 1) return std::nullopt;
  const Parts::Model& model = *p.Held();
  double middle[3];
  model.data->GetCenter(middle);
  const auto place = PixelOf(
      model.pose.position +
      model.pose.scale * (model.pose.quaternion * glm::dvec3(middle[0], middle[1], middle[2])));
  if (!place) return std::nullopt;
  const bool is_seen = place->x >= 0 && place->y >= 0 && place->x < p.width && place->y < p.height;
  return is_seen ? place : std::nullopt;
}

std::optional<Overview::TissuePlace> Overview::PickTissue(double x, double y) const {
  const Parts& p = *parts_;
  const glm::dvec3 near = WorldAt(*p.renderer, x, p.height - 1 - y, 0),
                   far = WorldAt(*p.renderer, x, p.height - 1 - y, 1);
  return PickAlong(near, far - near);
}

std::optional<Overview::TissuePlace> Overview::PickTissueNear(double x, double y,
                                                              double radius) const {
  constexpr int kAround = 16;
  for (double away = 0; away <= radius; away += 1.0)
    for (int i = 0; i < (away > 0 ? kAround : 1); ++i) {
      const double turn = 2 * std::numbers::pi * i / kAround;
      if (const auto place = PickTissue(x + away * std::cos(turn), y + away * std::sin(turn)))
        return place;
    }
  return std::nullopt;
}

std::optional<Overview::TissuePlace> Overview::PickAlong(const glm::dvec3& start,
                                                         const glm::dvec3& line) const {
  const Parts& p = *parts_;
  std::optional<TissuePlace> place;
  double nearest = 1.0;  // share of the line
  for (std::size_t i = 0; i < p.tissues.size(); ++i) {
    if (p.tissues[i].is_hidden) continue;
    const Pose& pose = p.tissues[i].pose;
    const auto own = [&](const glm::dvec3& world) {
      return (glm::conjugate(pose.quaternion) * (world - pose.position)) / pose.scale;
    };
    const glm::dvec3 from = own(start), way = own(start + line) - from;
    if (const auto share = FirstHit(p.tissues[i].surface, from, way); share && *share < nearest) {
      nearest = *share;
      place = TissuePlace{static_cast<int>(i), from + *share * way};
    }
  }
  return place;
}

}  // namespace arthro::app
