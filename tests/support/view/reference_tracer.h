// Expected picture of the arthroscope, by an independent double-precision ray tracer [method.md,
// Oblique view] with no GL: ray -> sphere of radius D about the portal -> panorama pixel ->
// bilinear colour. Portal frame, m, rad; pixels from the centre of the top-left one. Tests and
// `bench view` hold the renderer against it, so it shares nothing with what it judges: nothing of
// app/view, of its shaders or of OpenGL is included here (tests/layering checks it), and no
// function of simulation/scope is called, of which only the type of a view is used. The view is a
// product of rotations, the sphere is met by foot and half chord, the lens is Lambert's equal-area
// form, so that an error in one derivation shows against the other.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "simulation/scene/image.h"
#include "simulation/scene/lens.h"
#include "simulation/scene/mesh/surface_mesh.h"
#include "simulation/scene/scene.h"
#include "simulation/scope/arthroscope.h"

namespace arthro::test {

struct ReferencePose {
  double latitude = 0, longitude = 0, roll = 0, depth = 0, view_angle = 0;
  std::optional<double> head_roll;
};

// [right, up, view] = Ry(λ) Rx(φ) Rz(γ) Rx(α) Rz(κ − γ) applied to the neutral scope's axes.
simulation::ScopeView ReferenceView(const ReferencePose& pose);

// Unit ray of a pixel of the round window of a size x size picture; nothing outside the window.
// With a lens the window is its circle, and the ray the lens' own.
std::optional<glm::dvec3> ReferenceRay(const simulation::ScopeView& view, double field_of_view,
                                       int size, const glm::dvec2& pixel,
                                       const Lens* lens = nullptr);

// Point at which a ray from `origin` meets the sphere ahead of it; nothing if it does not.
std::optional<glm::dvec3> ReferenceSphereHit(const glm::dvec3& origin, const glm::dvec3& direction,
                                             double radius);

std::optional<glm::dvec2> ReferencePixel(const Projection& projection, const glm::dvec3& direction);

// First point of a ray behind the relief or on the bare sphere: sampled every `radius / 2000` and
// then bisected to 1e-12 of the radius. The relief between pixels is
// bilinear; beyond the panorama, and where it is not known, there is none.
std::optional<glm::dvec3> ReferenceReliefHit(const Backdrop& backdrop, const DepthMap& depth,
                                             const glm::dvec3& origin, const glm::dvec3& direction);

// Panorama pixel that the round window shows at `pixel`: all of the above in a row.
std::optional<glm::dvec2> PanoramaPixelAt(const Backdrop& backdrop,
                                          const simulation::ScopeView& view, double field_of_view,
                                          int size, const glm::dvec2& pixel,
                                          const Lens* lens = nullptr);

// Bilinear in the stored bytes, 0 to 255. Half a pixel beyond the outermost centres the edge colour
// goes on; further out is black.
glm::dvec3 ReferenceColour(const ColourImage& panorama, const glm::dvec2& pixel);

// An opaque mesh of one unlit colour (bytes, 0 to 255), in the portal frame. Both sides are seen.
struct ReferenceMesh {
  const SurfaceMesh* surface = nullptr;
  glm::dvec3 colour{255.0};
};

// First hit of a ray.
struct TracedRay {
  static constexpr int kNothing = -1;
  static constexpr int kBackdrop = 0;  // 1 + i is mesh i
  int what = kNothing;
  double distance = 0;     // from the tip, m
  glm::dvec3 colour{0.0};  // bytes, 0 to 255
};

// Unit rays from one tip. Without a depth map only the sphere is traced [method.md, Oblique view],
// which is what a plain picture shows.
std::vector<TracedRay> TraceRays(const Backdrop& backdrop, const ColourImage& panorama,
                                 const glm::dvec3& tip, std::span<const glm::dvec3> rays,
                                 std::span<const ReferenceMesh> meshes = {},
                                 const DepthMap* depth = nullptr);

struct TracedPicture {
  // Outside the round window, or the ray meets nothing.
  static constexpr int kOutside = TracedRay::kNothing;
  static constexpr int kBackdrop = TracedRay::kBackdrop;  // 1 + i is mesh i
  ColourImage colours;           // one ray per pixel, through its centre; black where kOutside
  std::vector<int> what;         // row-major
  std::vector<double> distance;  // from the tip, m; 0 where kOutside
};

// The rays of a whole window; with a lens it is its circle, as for ReferenceRay.
TracedPicture TraceWindow(const Backdrop& backdrop, const ColourImage& panorama,
                          const simulation::ScopeView& view, double field_of_view, int size,
                          std::span<const ReferenceMesh> meshes = {},
                          const DepthMap* depth = nullptr, const Lens* lens = nullptr);

}  // namespace arthro::test
