// Parts of the overview, as VTK data in the portal frame, m.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <glm/vec3.hpp>
#include <vtkActor.h>
#include <vtkBillboardTextActor3D.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkTexture.h>

#include "simulation/scene/image.h"
#include "simulation/scene/mesh/surface_mesh.h"
#include "simulation/scene/scene.h"
#include "simulation/scope/arthroscope.h"

namespace arthro::app {

// Returns the relief D − h over the panorama as a grid of at most `cells` cells along its longer
// side, with texture coordinates and holes where nothing was imaged. Its front faces the portal.
// The depth map has the shape of the panorama, in pixels of any size.
vtkSmartPointer<vtkPolyData> MakeReliefMesh(const glm::ivec2& panorama_size, const DepthMap& depth,
                                            Backdrop backdrop, int cells = 160);

// Returns at most 2048 px per side.
vtkSmartPointer<vtkTexture> MakePanoramaTexture(const ColourImage& panorama);

// Adds smooth normals.
vtkSmartPointer<vtkPolyData> MakeSurfaceData(const SurfaceMesh& surface);
// Computes normals when none are given.
void MoveSurfaceData(vtkPolyData& data, const SurfaceMesh& surface,
                     std::span<const glm::dvec3> normals = {});

// Colours flagged vertices in one colour, the others in another (sRGB); without flags the actor's.
void ColourVertices(vtkPolyData& data, const glm::dvec3& others, const glm::dvec3& flagged,
                    std::span<const std::uint8_t> flags);

// Returns one sphere per ball.
SurfaceMesh MakeBalls(std::span<const Ball> balls);

// Returns where from + share · way first meets a surface, 0 ≤ share ≤ 1, from either side.
std::optional<double> FirstHit(const SurfaceMesh& surface, const glm::dvec3& from,
                               const glm::dvec3& way);

// Returns a round bar along each line of points.
vtkSmartPointer<vtkPolyData> MakeBars(const std::vector<std::vector<glm::dvec3>>& lines,
                                      double radius, int sides = 12);

// Returns the rim of the scope's view on the backdrop's sphere, and rays from the tip to it.
std::vector<std::vector<glm::dvec3>> ViewConeLines(const simulation::ScopeView& view,
                                                   double field_of_view, double radius);

vtkSmartPointer<vtkActor> MakeActor(const glm::dvec3& colour, double ambient = 0.25);
void SetData(vtkActor& actor, vtkPolyData* data);

inline constexpr int kLabelSize = 15;  // px at scale 1
vtkSmartPointer<vtkBillboardTextActor3D> MakeLabel(const std::string& text,
                                                   const glm::dvec3& colour);

}  // namespace arthro::app
