#include "app/view/overview/overview_parts.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

#include <glm/geometric.hpp>
#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkTextProperty.h>
#include <vtkTubeFilter.h>
#include <vtkUnsignedCharArray.h>

#include "simulation/scene/backdrop/relief_surface.h"
#include "simulation/scene/mesh/vertex_normals.h"
#include "simulation/scene/shrunk_projection.h"

namespace arthro::app {

vtkSmartPointer<vtkPolyData> MakeReliefMesh(const glm::ivec2& panorama_size, const DepthMap& depth,
                                            Backdrop backdrop, int cells) {
  const int width = depth.empty() ? panorama_size.x : depth.width,
            height = depth.empty() ? panorama_size.y : depth.height;
  backdrop.projection =
      Shrunk(backdrop.projection, static_cast<double>(panorama_size.x) / std::max(width, 1));
  const ReliefSurface surface =
      MakeReliefSurface(width, height, depth, backdrop, cells, ReliefSample::kAtCorner);
  vtkNew<vtkPoints> points;
  vtkNew<vtkFloatArray> places;
  places->SetNumberOfComponents(2);
  for (std::size_t i = 0; i < surface.pixel.size(); ++i) {
    const glm::dvec3& x = surface.mesh.vertices[i];
    points->InsertNextPoint(x.x, x.y, x.z);
    places->InsertNextTuple2((surface.pixel[i].x + 0.5) / width,
                             1.0 - (surface.pixel[i].y + 0.5) / height);
  }
  vtkNew<vtkCellArray> polys;
  for (const auto& t : surface.mesh.triangles) polys->InsertNextCell({t[0], t[1], t[2]});
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  data->SetPolys(polys);
  data->GetPointData()->SetTCoords(places);
  return data;
}

vtkSmartPointer<vtkTexture> MakePanoramaTexture(const ColourImage& panorama) {
  constexpr int kMaxSide = 2048;
  const int step = (std::max(panorama.width, panorama.height) + kMaxSide - 1) / kMaxSide;
  vtkNew<vtkImageData> image;
  const int width = panorama.width / step, height = panorama.height / step;
  image->SetDimensions(width, height, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)  // VTK's first row is the lowest
      std::memcpy(image->GetScalarPointer(x, height - 1 - y, 0), panorama.at(x * step, y * step),
                  3);
  auto texture = vtkSmartPointer<vtkTexture>::New();
  texture->SetInputData(image);
  texture->InterpolateOn();
  texture->MipmapOn();
  texture->SetMaximumAnisotropicFiltering(1.0f);
  texture->RepeatOff();
  texture->EdgeClampOn();
  return texture;
}

vtkSmartPointer<vtkPolyData> MakeSurfaceData(const SurfaceMesh& surface) {
  auto data = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  points->SetNumberOfPoints(static_cast<vtkIdType>(surface.vertices.size()));
  data->SetPoints(points);
  vtkNew<vtkCellArray> polys;
  for (const auto& t : surface.triangles) polys->InsertNextCell({t[0], t[1], t[2]});
  data->SetPolys(polys);
  vtkNew<vtkFloatArray> normals;
  normals->SetNumberOfComponents(3);
  normals->SetNumberOfTuples(points->GetNumberOfPoints());
  data->GetPointData()->SetNormals(normals);
  MoveSurfaceData(*data, surface);
  return data;
}

void MoveSurfaceData(vtkPolyData& data, const SurfaceMesh& surface,
                     std::span<const glm::dvec3> normals) {
  std::vector<glm::dvec3> own;
  if (normals.empty()) {
    own.resize(surface.vertices.size());
    ComputeVertexNormals(surface.vertices, surface.triangles, own);
    normals = own;
  }
  for (std::size_t i = 0; i < normals.size(); ++i) {
    const glm::dvec3 &p = surface.vertices[i], &n = normals[i];
    data.GetPoints()->SetPoint(static_cast<vtkIdType>(i), p.x, p.y, p.z);
    data.GetPointData()->GetNormals()->SetTuple3(static_cast<vtkIdType>(i), n.x, n.y, n.z);
  }
  data.GetPoints()->Modified();
  data.GetPointData()->GetNormals()->Modified();
  data.Modified();
}

void ColourVertices(vtkPolyData& data, const glm::dvec3& others, const glm::dvec3& flagged,
                    std::span<const std::uint8_t> flags) {
  if (flags.empty()) {
    data.GetPointData()->SetScalars(nullptr);
    return;
  }
  vtkNew<vtkUnsignedCharArray> colours;
  colours->SetNumberOfComponents(3);
  colours->SetNumberOfTuples(static_cast<vtkIdType>(flags.size()));
  for (std::size_t i = 0; i < flags.size(); ++i) {
    const glm::dvec3 c = 255.0 * (flags[i] != 0 ? flagged : others);
    colours->SetTuple3(static_cast<vtkIdType>(i), std::lround(c.x), std::lround(c.y),
                       std::lround(c.z));
  }
  data.GetPointData()->SetScalars(colours);
}

SurfaceMesh MakeBalls(std::span<const Ball> balls) {
  constexpr int kAround = 20, kAlong = 10;
  SurfaceMesh mesh;
  for (const Ball& ball : balls) {
    const int first = static_cast<int>(mesh.vertices.size());
    for (int j = 0; j <= kAlong; ++j)
      for (int i = 0; i < kAround; ++i) {
        const double a = 2.0 * std::numbers::pi * i / kAround, b = std::numbers::pi * j / kAlong;
        mesh.vertices.push_back(ball.centre + ball.radius * glm::dvec3(std::sin(b) * std::cos(a),
                                                                       std::sin(b) * std::sin(a),
                                                                       std::cos(b)));
      }
    for (int j = 0; j < kAlong; ++j)
      for (int i = 0; i < kAround; ++i) {
        const int p = first + j * kAround + i, q = first + j * kAround + (i + 1) % kAround;
        mesh.triangles.push_back({p, p + kAround, q + kAround});
        mesh.triangles.push_back({p, q + kAround, q});
      }
  }
  return mesh;
}

std::optional<double> FirstHit(const SurfaceMesh& surface, const glm::dvec3& from,
                               const glm::dvec3& way) {
  std::optional<double> first;
  for (const auto& [i, j, k] : surface.triangles) {
    // Intersection test of Möller and Trumbore.
    const glm::dvec3& a = surface.vertices[static_cast<std::size_t>(i)];
    const glm::dvec3 u = surface.vertices[static_cast<std::size_t>(j)] - a,
                     v = surface.vertices[static_cast<std::size_t>(k)] - a;
    const glm::dvec3 across = glm::cross(way, v), offset = from - a;
    const double determinant = glm::dot(u, across);
    if (determinant == 0.0) continue;
    const double s = glm::dot(offset, across) / determinant;
    const glm::dvec3 turned = glm::cross(offset, u);
    const double t = glm::dot(way, turned) / determinant;
    const double share = glm::dot(v, turned) / determinant;
    if (s < 0.0 || t < 0.0 || s + t > 1.0 || share < 0.0 || share > 1.0) continue;
    if (!first || share < *first) first = share;
  }
  return first;
}

vtkSmartPointer<vtkPolyData> MakeBars(const std::vector<std::vector<glm::dvec3>>& lines,
                                      double radius, int sides) {
  vtkNew<vtkPolyData> input;
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> cells;
  for (const auto& line : lines) {
    cells->InsertNextCell(static_cast<int>(line.size()));
    for (const glm::dvec3& p : line) cells->InsertCellPoint(points->InsertNextPoint(p.x, p.y, p.z));
  }
  input->SetPoints(points);
  input->SetLines(cells);
  vtkNew<vtkTubeFilter> tube;
  tube->SetInputData(input);
  tube->SetRadius(radius);
  tube->SetNumberOfSides(sides);
  tube->CappingOn();
  tube->Update();
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->ShallowCopy(tube->GetOutput());
  return data;
}

std::vector<std::vector<glm::dvec3>> ViewConeLines(const simulation::ScopeView& view,
                                                   double field_of_view, double radius) {
  constexpr int kRimSteps = 72, kRays = 8;
  // Just inside the sphere, so that the lines stay visible on a bare one.
  const double reach = 0.995 * radius;
  std::vector<std::vector<glm::dvec3>> lines(1);
  for (int i = 0; i <= kRimSteps; ++i) {
    const double a = 2.0 * std::numbers::pi * i / kRimSteps, theta = field_of_view / 2.0;
    const glm::dvec3 ray = std::cos(theta) * view.view +
                           std::sin(theta) * (std::cos(a) * view.up + std::sin(a) * view.right);
    lines[0].push_back(simulation::SphereHit(view.tip, ray, reach));
    if (i < kRimSteps && i % (kRimSteps / kRays) == 0) lines.push_back({view.tip, lines[0].back()});
  }
  return lines;
}

vtkSmartPointer<vtkActor> MakeActor(const glm::dvec3& colour, double ambient) {
  auto actor = vtkSmartPointer<vtkActor>::New();
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->ScalarVisibilityOff();
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(colour.x, colour.y, colour.z);
  actor->GetProperty()->SetAmbient(ambient);
  actor->GetProperty()->SetDiffuse(1.0 - ambient);
  actor->ForceOpaqueOn();
  actor->PickableOff();
  return actor;
}

void SetData(vtkActor& actor, vtkPolyData* data) {
  auto& mapper = *static_cast<vtkPolyDataMapper*>(actor.GetMapper());
  mapper.SetInputData(data);
  mapper.SetScalarVisibility(data && data->GetPointData()->GetScalars() ? 1 : 0);
}

vtkSmartPointer<vtkBillboardTextActor3D> MakeLabel(const std::string& text,
                                                   const glm::dvec3& colour) {
  auto label = vtkSmartPointer<vtkBillboardTextActor3D>::New();
  label->SetInput(text.c_str());
  vtkTextProperty* property = label->GetTextProperty();
  property->SetFontSize(kLabelSize);
  property->SetColor(colour.x, colour.y, colour.z);
  property->SetBackgroundColor(0.10, 0.11, 0.13);  // readable over any tissue
  property->SetBackgroundOpacity(1.0);
  label->PickableOff();
  return label;
}

}  // namespace arthro::app
