// Surface seen through the arthroscope's lens: a VTK actor whose vertex shader maps each vertex
// through the lens, with the depth of the backdrop, and whose fragment shader lights it from the
// lens.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkOpenGLPolyDataMapper.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include "app/view/drawing/lens_shade.h"
#include "app/view/drawing/metered_models.h"
#include "app/view/drawing/tissue_grain.h"
#include "app/view/shaders/constants.h"
#include "simulation/core/frames.h"
#include "simulation/scene/mesh/surface_mesh.h"
#include "simulation/scope/window_lens.h"

namespace arthro::app {

// Relief that models meet, as the backdrop's texture. Lengths in m.
struct ReliefContact {
  int texture_unit = -1;  // while a frame is drawn; -1: there is no relief
  glm::dvec3 tip{0.0}, right{1.0, 0.0, 0.0}, up{0.0, 1.0, 0.0}, ahead{0.0, 0.0, 1.0};
  double radius = 0;                   // radius of the backdrop
  glm::dvec2 centre{0.0}, scale{1.0};  // projection, texture units
  bool is_equirectangular = false, wraps = false;
};

// Values that all models of a frame share.
struct LensFrame {
  double field_of_view = 1.57;  // full, rad
  simulation::WindowLens lens;  // lens for that field of view
  double window_radius = 256;   // px
  double light_reach = 0.03;    // m
  double gain = 1, relit = 0;   // camera gain; share of the scope's own lamp in the light
  double mirrored_share = 1;    // ratio by medium (simulation/scene/medium.h)
  LensShade shade;
  ReliefContact contact;
  glm::dvec3 light_colour{1.0};  // linear; colour of white under lamp and camera
  glm::dvec3 surround{0.2};      // linear; colour that a shining surface mirrors
  // Change of that colour from the middle towards right, up and back: blurred surroundings.
  std::array<glm::dvec3, 3> slope{};
};

class LensModel {
 public:
  enum class Look { kTissue, kSteel };
  explicit LensModel(Look look);

  vtkActor* actor() { return actor_; }
  void Show(bool visible) { actor_->SetVisibility(visible && !triangles_.empty() ? 1 : 0); }
  // Tissue only: the look, and the whole surface at rest, on which its pattern lies.
  void SetLook(const simulation::TissueLook& look, const SurfaceMesh& whole);
  // Surface at rest. `fresh` is 1 for a vertex of a cut face; empty: no cut face.
  void SetSurface(const SurfaceMesh& surface, std::span<const std::uint8_t> fresh = {});
  // Positions and normals per vertex; computes normals when none are given. Returns false, and
  // uploads nothing, when nothing moved.
  bool SetShape(std::span<const glm::dvec3> positions, std::span<const glm::dvec3> normals = {});
  void SetPose(const Pose& portal_from_model);
  void SetColour(const glm::dvec3& linear_rgb);
  void SetFrame(const LensFrame& frame);
  // Steel only: nothing is drawn farther than this behind the origin along z, m.
  void SetLength(double length);
  // Steel only: the probe's marks every 5 mm.
  void SetEtched(bool is_etched);
  // Draws the triangles in reverse order. Outlines are blended over what was drawn before, so the
  // part of a model that lies behind another one comes first.
  void SetReversed(bool is_reversed);
  // The surface as the camera's gain meters it in a light of this colour; valid until it changes.
  MeteredSurface Metered(const glm::dvec3& light_colour) const;

 private:
  // Composes the shaders.
  void Assemble();
  // Whether the distance between vertices follows from theirs.
  bool IsFine() const;
  bool IsPlate() const;
  void TakeGrain(const SurfaceMesh& surface, std::span<const std::uint8_t> fresh);
  void SetInFragments(const char* name, const glm::dvec3& value);
  void Set(const char* given_name, double value);
  void Set(const char* given_name, const glm::dvec3& value);
  // Hands the relief's texture to the program that is about to draw.
  void SetSamplers(vtkObject* caller, unsigned long event, void* program);

  Look look_;
  bool has_lens_ = false;  // not the equisolid lens
  ReliefContact contact_;
  bool is_closed_ = false, is_reversed_ = false;
  double longest_edge_ = 0;  // longest edge at rest, in its own frame; 0: there is no surface
  Pose pose_;
  glm::dvec3 colour_{1.0};
  simulation::TissueLook tissue_look_;
  TissueGrain grain_;
  void TakeTriangles();
  std::vector<std::array<int, 3>> triangles_;
  std::vector<glm::dvec3> normals_;
  vtkNew<vtkPoints> points_;
  vtkNew<vtkFloatArray> normal_array_, grain_array_, mark_array_;
  vtkNew<vtkPolyData> data_;
  vtkNew<vtkOpenGLPolyDataMapper> mapper_;
  vtkNew<vtkActor> actor_;
};

}  // namespace arthro::app
