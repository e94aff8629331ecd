#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <vtkCellArray.h>
#include <vtkDataArray.h>
#include <vtkDoubleArray.h>
#include <vtkFlyingEdges3D.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include "simulation/core/error.h"
#include "simulation/scene/mesh/mesh_io.h"
#include "simulation/scene/solids/solid_function.h"
#include "simulation/scene/solids/solid_io.h"

namespace arthro {
namespace {

// Offset of the grid in cells, so that planes of symmetry and round sizes miss its nodes.
constexpr double kOffset = 0.381966;
constexpr int kMargin = 2;         // cells around the box
constexpr int kSteps = 4;          // steps of Newton's method
constexpr double kFarthest = 0.5;  // cells that a vertex may move

// Moves a vertex of the contour onto the zero of the function; back where that is too far.
glm::dvec3 OntoSurface(const SolidFunction& function, const glm::dvec3& from, double cell) {
  glm::dvec3 x = from;
  for (int step = 0; step < kSteps; ++step) {
    const SolidSample sample = function.Sample(x);
    const double slope = glm::dot(sample.gradient, sample.gradient);
    if (!(slope > 0.01)) break;
    x -= sample.value / slope * sample.gradient;
  }
  return glm::distance(x, from) < kFarthest * cell ? x : from;
}

}  // namespace

SurfaceMesh SurfaceOfSolid(const Solid& solid, int cells) {
  const SolidFunction function(solid);
  const Box3& box = function.bounds();
  const glm::dvec3 size = box.high - box.low;
  const double cell = std::max({size.x, size.y, size.z}) / std::clamp(cells, 8, 256);
  glm::ivec3 count;
  for (int a = 0; a < 3; ++a) count[a] = static_cast<int>(std::ceil(size[a] / cell)) + 2 * kMargin;
  const glm::dvec3 origin = box.low - (kMargin - kOffset) * cell;

  vtkNew<vtkImageData> grid;
  grid->SetDimensions(count.x, count.y, count.z);
  grid->SetSpacing(cell, cell, cell);
  grid->SetOrigin(origin.x, origin.y, origin.z);
  vtkNew<vtkDoubleArray> values;
  values->SetNumberOfValues(static_cast<vtkIdType>(count.x) * count.y * count.z);
  vtkIdType node = 0;
  for (int k = 0; k < count.z; ++k)
    for (int j = 0; j < count.y; ++j)
      for (int i = 0; i < count.x; ++i)
        values->SetValue(node++, function.Value(origin + cell * glm::dvec3(i, j, k)));
  grid->GetPointData()->SetScalars(values);
  vtkNew<vtkFlyingEdges3D> contour;
  contour->SetInputData(grid);
  contour->SetValue(0, 0.0);
  contour->ComputeNormalsOff();
  contour->ComputeGradientsOff();
  contour->ComputeScalarsOff();
  contour->Update();

  vtkPolyData* found = contour->GetOutput();
  SurfaceMesh surface;
  for (vtkIdType i = 0; i < found->GetNumberOfPoints(); ++i) {
    double x[3];
    found->GetPoint(i, x);
    surface.vertices.push_back(OntoSurface(function, {x[0], x[1], x[2]}, cell));
  }
  vtkCellArray* triangles = found->GetPolys();
  triangles->InitTraversal();
  vtkIdType corners = 0;
  const vtkIdType* corner = nullptr;
  while (triangles->GetNextCell(corners, corner) != 0)
    if (corners == 3)
      surface.triangles.push_back(
          {static_cast<int>(corner[0]), static_cast<int>(corner[1]), static_cast<int>(corner[2])});
  double volume = 0;  // six times that of the solid, negative where the triangles face inwards
  for (const auto& [a, b, c] : surface.triangles)
    volume += glm::dot(surface.vertices[static_cast<std::size_t>(a)] - box.low,
                       glm::cross(surface.vertices[static_cast<std::size_t>(b)] - box.low,
                                  surface.vertices[static_cast<std::size_t>(c)] - box.low));
  if (volume < 0.0)
    for (auto& triangle : surface.triangles) std::swap(triangle[1], triangle[2]);
  if (surface.triangles.empty())
    throw Error(Code::kBadMesh,
                "nothing is left of the solid: its parts take one another away, or it is thinner "
                "than a cell of its grid");
  return surface;
}

}  // namespace arthro
