// Marks and colours on the tissues of the overview.
#include <algorithm>

#include <glm/geometric.hpp>
#include <vtkPointData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkUnsignedCharArray.h>

#include "app/view/overview/overview_impl.h"

namespace arthro::app {
namespace {

constexpr double kMarkRadius = 1.6e-4;    // m, of the bar along a marked edge
constexpr std::size_t kMostEdges = 4000;  // more cannot be told apart

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

}  // namespace arthro::app
