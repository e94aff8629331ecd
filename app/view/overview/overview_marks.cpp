// Marks and colours on the tissues of the overview, and the arms of the handle.
#include <algorithm>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <vtkPointData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkUnsignedCharArray.h>

#include "app/view/overview/overview_impl.h"

namespace arthro::app {
namespace {

const glm::dvec3 kArmColours[3] = {{0.90, 0.35, 0.32}, {0.45, 0.80, 0.40}, {0.40, 0.58, 0.95}};
constexpr double kMarkRadius = 1.6e-4;    // m, of the bar along a marked edge
constexpr std::size_t kMostEdges = 4000;  // more cannot be told apart
constexpr double kArmLength = 0.16;       // share of the backdrop's radius
constexpr double kArmRadius = 3e-4;       // m

std::vector<std::vector<glm::dvec3>> LinesOf(const SurfaceMark& mark) {
  std::vector<std::vector<glm::dvec3>> lines;
  for (std::size_t i = 0; i < std::min(mark.edges.size(), kMostEdges); ++i)
    lines.push_back({mark.edges[i][0], mark.edges[i][1]});
  return lines;
}

SurfaceMesh SurfaceOf(const SurfaceMark& mark) {
  SurfaceMesh surface;
  for (const auto& corners : mark.triangles) {
    const int first = static_cast<int>(surface.vertices.size());
    surface.vertices.insert(surface.vertices.end(), corners.begin(), corners.end());
    surface.triangles.push_back({first, first + 1, first + 2});
  }
  return surface;
}

}  // namespace

void Overview::ShowMarks(int tissue, std::span<const SurfaceMark> marks) {
  Parts& p = *parts_;
  for (const auto& mark : p.marks) p.renderer->RemoveActor(mark);
  p.marks.clear();
  p.marked = tissue >= 0 && tissue < static_cast<int>(p.tissues.size()) ? tissue : -1;
  p.changed = true;
  if (p.marked < 0) return;
  const auto add = [&](const glm::dvec3& colour, vtkPolyData* data) {
    auto actor = MakeActor(colour, 0.75);
    SetData(*actor, data);
    actor->SetUserMatrix(MatrixOf(p.tissues[static_cast<std::size_t>(tissue)].pose));
    p.renderer->AddActor(actor);
    p.marks.push_back(actor);
    return actor;
  };
  for (const SurfaceMark& mark : marks) {
    add(mark.colour, MakeBars(LinesOf(mark), kMarkRadius, 6));
    if (mark.triangles.empty()) continue;
    const auto filled = add(mark.colour, MakeSurfaceData(SurfaceOf(mark)));
    // Before the surface in which they lie.
    auto* mapper = vtkPolyDataMapper::SafeDownCast(filled->GetMapper());
    mapper->SetRelativeCoincidentTopologyPolygonOffsetParameters(-2, -2);
  }
}

void Overview::SetTissueColours(int index, std::span<const glm::dvec3> colours) {
  Parts::Model& model = parts_->tissues.at(static_cast<std::size_t>(index));
  if (colours.size() != model.surface.vertices.size()) return;
  vtkNew<vtkUnsignedCharArray> values;
  values->SetNumberOfComponents(3);
  for (const glm::dvec3& colour : colours)
    values->InsertNextTuple3(255 * colour.r, 255 * colour.g, 255 * colour.b);
  model.data->GetPointData()->SetScalars(values);
  SetData(*model.actor, model.data);
  parts_->changed = true;
}

glm::dvec3 Overview::Parts::MiddleOf(const Model& model) const {
  double middle[3];
  model.data->GetCenter(middle);
  return model.pose * glm::dvec3(middle[0], middle[1], middle[2]);
}

glm::dvec3 Overview::Parts::ArmOf(const Model& model, int axis) const {
  glm::dvec3 unit(0.0);
  unit[axis] = kArmLength * radius;
  return arms == Arms::kOwn ? model.pose.quaternion * unit : unit;
}

void Overview::Parts::PlaceArms() {
  const Model* held_model = Held();
  for (int axis = 0; axis < 3; ++axis) {
    auto& actor = arm_actors[std::size_t(axis)];
    if (!actor) {
      actor = MakeActor(kArmColours[axis], 0.7);
      renderer->AddActor(actor);
    }
    actor->SetVisibility(held_model != nullptr ? 1 : 0);
    if (held_model == nullptr) continue;
    const glm::dvec3 from = MiddleOf(*held_model), to = from + ArmOf(*held_model, axis);
    SetData(*actor, MakeBars({{from, to}}, kArmRadius));
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

bool Overview::DragArm(const PointerEvent& event) {
  constexpr double kGrab = 9;  // px at scale 1
  Parts& p = *parts_;
  const glm::dvec2 at(event.x, event.y);
  using Kind = PointerEvent::Kind;
  if (event.kind == Kind::kPress) {
    if (event.button != PointerEvent::Button::kLeft) return false;
    const std::vector<glm::dvec2> ends = ArmPlaces();
    const auto near = [&](const glm::dvec2& end) {
      return glm::distance(end, at) <= kGrab * handle_scale;
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
  Pose moved = p.drag_pose;
  moved.position += glm::dot(at - p.drag_from, way) / length2 * arm;
  if (p.part.actor) {
    p.part.pose = moved;
    p.part.actor->SetUserMatrix(MatrixOf(moved));
    p.PlaceBox();
    p.changed = true;
    if (on_part) on_part(moved, is_finished);
    return true;
  }
  if (on_pose) on_pose(p.chosen, moved, is_finished);
  SetTissuePose(p.chosen, moved);
  return true;
}

}  // namespace arthro::app
