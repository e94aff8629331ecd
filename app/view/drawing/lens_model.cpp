#include "app/view/drawing/lens_model.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <vtkCommand.h>
#include <vtkDataObject.h>
#include <vtkMatrix4x4.h>
#include <vtkOpenGLVertexBufferObject.h>
#include <vtkPointData.h>
#include <vtkProperty.h>
#include <vtkShaderProgram.h>
#include <vtkShaderProperty.h>
#include <vtkUniforms.h>

#include "app/view/drawing/passes/shader_text.h"
#include "app/view/drawing/passes/steady_inputs.h"
#include "app/view/drawing/srgb.h"
#include "app/view/drawing/uniform_float.h"
#include "simulation/scene/mesh/vertex_normals.h"

namespace arthro::app {
namespace {

// Area vectors of a closed surface cancel; its volume is positive when they face outwards. The skin
// of a cut tissue is open by a hundredth of a millimetre along the lips of the cut.
constexpr double kOpenShare = 1e-3;  // share of the area
bool IsClosedAndOutward(const SurfaceMesh& surface) {
  glm::dvec3 sum{0.0};
  double area = 0.0, volume = 0.0;
  for (const auto& t : surface.triangles) {
    const glm::dvec3 &a = surface.vertices[static_cast<std::size_t>(t[0])],
                     &b = surface.vertices[static_cast<std::size_t>(t[1])],
                     &c = surface.vertices[static_cast<std::size_t>(t[2])];
    const glm::dvec3 twice = glm::cross(b - a, c - a);
    sum += twice;
    area += glm::length(twice);
    volume += glm::dot(a, twice);
  }
  return volume > 0.0 && glm::length(sum) < kOpenShare * area;
}

// Longest edge of a tissue whose distances OpenGL interpolates, which lets it leave out hidden
// fragments before they are shaded. The inverse distance is interpolated, so that the middle of an
// edge of length L at a distance d counts as L²/(8 d) too far: 13 um at 10 mm, 0.06 mm at 2 mm.
constexpr double kFineEdge = 1e-3;  // m

double LongestEdge(const SurfaceMesh& surface) {
  double longest = 0;
  for (const auto& t : surface.triangles)
    for (std::size_t i = 0; i < 3; ++i)
      longest = std::max(longest,
                         glm::distance(surface.vertices[static_cast<std::size_t>(t[i])],
                                       surface.vertices[static_cast<std::size_t>(t[(i + 1) % 3])]));
  return longest;
}

}  // namespace

LensModel::LensModel(Look look) : look_(look) {
  points_->SetDataTypeToFloat();
  normal_array_->SetName("Normals");
  normal_array_->SetNumberOfComponents(3);
  data_->SetPoints(points_);
  data_->GetPointData()->SetNormals(normal_array_);
  if (look == Look::kTissue) {
    for (const auto& [array, name, input] : {std::tuple{grain_array_.Get(), "Grain", "grainMC"},
                                             {mark_array_.Get(), "Marks", "marksMC"}}) {
      array->SetName(name);
      array->SetNumberOfComponents(3);
      data_->GetPointData()->AddArray(array);
      mapper_->MapDataArrayToVertexAttribute(input, name, vtkDataObject::FIELD_ASSOCIATION_POINTS,
                                             -1);
    }
  }
  mapper_->SetInputData(data_);
  mapper_->ScalarVisibilityOff();
  // Coordinates are metres within a joint: float holds them, and the shader takes them unscaled.
  mapper_->SetVBOShiftScaleMethod(vtkOpenGLVertexBufferObject::DISABLE_SHIFT_SCALE);
  mapper_->AddObserver(vtkCommand::UpdateShaderEvent, this, &LensModel::SetSamplers);
  actor_->SetMapper(mapper_);
  actor_->ForceOpaqueOn();

  Assemble();
  if (look == Look::kSteel) {
    SetLength(1.0);
    SetEtched(true);
  }
  if (look == Look::kTissue) SetLook({}, {});
  SetColour(glm::dvec3(1.0));
  SetFrame({});
}

bool LensModel::IsFine() const {
  return longest_edge_ > 0 && pose_.scale * longest_edge_ <= kFineEdge;
}

bool LensModel::IsPlate() const {
  return look_ == Look::kTissue && tissue_look_.structure == simulation::TissueStructure::kHyaline;
}

void LensModel::Assemble() {
  std::vector<std::string> defines;
  std::vector<std::string> structure;
  if (look_ == Look::kTissue) {
    defines.push_back("TISSUE");
    if (tissue_look_.structure == simulation::TissueStructure::kFibres)
      structure.push_back("FIBRES");
    if (IsPlate()) structure.push_back("HYALINE");
    if (IsFine()) structure.push_back("FINE");
  }
  if (has_lens_) defines.push_back("LENS");
  const SteadyInputs inputs = TakeSteadyInputs(ShaderText("model_inputs.glsl", defines));
  const auto common = [&](std::vector<std::string> stage) {
    stage.insert(stage.end(), structure.begin(), structure.end());
    if (contact_.is_equirectangular) stage.push_back("EQUIRECTANGULAR");
    if (contact_.wraps) stage.push_back("WRAPS");
    return ShaderText("model_common.glsl", stage);
  };
  vtkShaderProperty* shader = actor_->GetShaderProperty();
  shader->ClearAllShaderReplacements();
  shader->AddVertexShaderReplacement(
      "//VTK::Normal::Dec", true, "//VTK::Normal::Dec\n" + inputs.outputs + common({"VARYING out"}),
      false);
  shader->AddVertexShaderReplacement("//VTK::PositionVC::Impl", true,
                                     "//VTK::PositionVC::Impl\n" + ShaderText("model_vertex.glsl"),
                                     false);
  shader->AddFragmentShaderReplacement(
      "//VTK::Light::Dec", true,
      "//VTK::Light::Dec\n" + inputs.fragment + common({"VARYING in", "FRAGMENT"}), false);
  shader->AddFragmentShaderReplacement("//VTK::Light::Impl", true,
                                       ShaderText("model_fragment.glsl"), false);
}

void LensModel::SetSurface(const SurfaceMesh& surface, std::span<const std::uint8_t> fresh) {
  triangles_ = surface.triangles;
  const auto count = static_cast<vtkIdType>(surface.vertices.size());
  TakeTriangles();
  points_->SetNumberOfPoints(count);
  normal_array_->SetNumberOfTuples(count);
  SetShape(surface.vertices);
  if (look_ == Look::kTissue) TakeGrain(surface, fresh);
  points_->Modified();
  data_->Modified();
  // The inside of a closed surface is never seen; culling saves half the work.
  is_closed_ = IsClosedAndOutward(surface);
  actor_->GetProperty()->SetBackfaceCulling(is_closed_ ? 1 : 0);
}

void LensModel::TakeTriangles() {
  vtkNew<vtkCellArray> polys;
  const auto count = triangles_.size();
  for (std::size_t i = 0; i < count; ++i) {
    const auto& triangle = triangles_[is_reversed_ ? count - 1 - i : i];
    polys->InsertNextCell({triangle[0], triangle[1], triangle[2]});
  }
  data_->SetPolys(polys);
}

void LensModel::SetReversed(bool is_reversed) {
  if (is_reversed == is_reversed_) return;
  is_reversed_ = is_reversed;
  TakeTriangles();
  data_->Modified();
}

void LensModel::SetLook(const simulation::TissueLook& look, const SurfaceMesh& whole) {
  tissue_look_ = look;
  grain_ = TissueGrain(whole, look.structure);
  longest_edge_ = LongestEdge(whole);
  Assemble();
  SetInFragments("tint", look.tint);
  SetInFragments("cutTint", look.cut_tint);
  SetInFragments("grainAxis", grain_.axis());
  SetInFragments("edgeTint", look.edge_tint);
  SetInFragments("rimTint", look.rim_tint);
  SetInFragments("rootTint", look.root_tint);
  SetInFragments("vesselColour", look.vessel_colour);
  SetInFragments("lookShares", {look.vessels, look.fibres, look.fibrillation});
  SetInFragments("lookMeasures", {look.fibre_width, look.gloss, 0.0});
}

// Pattern coordinates and marks of the vertices at rest.
void LensModel::TakeGrain(const SurfaceMesh& surface, std::span<const std::uint8_t> fresh) {
  const auto count = static_cast<vtkIdType>(surface.vertices.size());
  grain_array_->SetNumberOfTuples(count);
  mark_array_->SetNumberOfTuples(count);
  for (vtkIdType i = 0; i < count; ++i) {
    const auto v = static_cast<std::size_t>(i);
    const GrainPoint point = grain_.At(surface.vertices[v], normals_[v]);
    const bool is_fresh = !fresh.empty() && fresh[v] != 0;
    grain_array_->SetTuple3(i, point.place.x, point.place.y, point.place.z);
    mark_array_->SetTuple3(i, point.rim, point.root, is_fresh ? 1.0 : 0.0);
  }
  grain_array_->Modified();
  mark_array_->Modified();
}

bool LensModel::SetShape(std::span<const glm::dvec3> positions,
                         std::span<const glm::dvec3> normals) {
  if (normals.empty()) {
    normals_.resize(positions.size());
    ComputeVertexNormals(positions, triangles_, normals_);
    normals = normals_;
  }
  auto* point = static_cast<float*>(points_->GetVoidPointer(0));
  float* normal = normal_array_->GetPointer(0);
  bool has_moved = false;
  for (std::size_t i = 0; i < positions.size(); ++i)
    for (int c = 0; c < 3; ++c, ++point, ++normal) {
      const float x = Float(positions[i][c]), n = Float(normals[i][c]);
      has_moved = has_moved || x != *point || n != *normal;
      *point = x;
      *normal = n;
    }
  if (!has_moved) return false;
  points_->Modified();
  normal_array_->Modified();
  data_->Modified();
  return true;
}

void LensModel::SetPose(const Pose& pose) {
  const bool was_fine = IsFine();
  pose_ = pose;
  if (IsFine() != was_fine) Assemble();
  const glm::dmat3 rotation = glm::mat3_cast(pose.quaternion);
  vtkNew<vtkMatrix4x4> matrix;
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) matrix->SetElement(r, c, pose.scale * rotation[c][r]);
    matrix->SetElement(r, 3, pose.position[r]);
  }
  actor_->SetUserMatrix(matrix);
}

void LensModel::Set(const char* given_name, double value) {
  actor_->GetShaderProperty()->GetVertexCustomUniforms()->SetUniformf(given_name, Float(value));
}

void LensModel::SetSamplers(vtkObject*, unsigned long, void* program) {
  if (program != nullptr && contact_.texture_unit >= 0)
    static_cast<vtkShaderProgram*>(program)->SetUniformi("contactRelief", contact_.texture_unit);
}

void LensModel::Set(const char* given_name, const glm::dvec3& value) {
  const float v[3] = {Float(value.x), Float(value.y), Float(value.z)};
  actor_->GetShaderProperty()->GetVertexCustomUniforms()->SetUniform3f(given_name, v);
}

void LensModel::SetInFragments(const char* name, const glm::dvec3& value) {
  const float v[3] = {Float(value.x), Float(value.y), Float(value.z)};
  actor_->GetShaderProperty()->GetFragmentCustomUniforms()->SetUniform3f(name, v);
}

void LensModel::SetColour(const glm::dvec3& linear_rgb) {
  colour_ = linear_rgb;
  Set("given_modelColour", linear_rgb);
}

void LensModel::SetLength(double length) { Set("given_rodLength", length); }

void LensModel::SetEtched(bool is_etched) { Set("given_etchedRings", is_etched ? 1.0 : 0.0); }

MeteredSurface LensModel::Metered(const glm::dvec3& light_colour) const {
  const auto count = static_cast<std::size_t>(3 * points_->GetNumberOfPoints());
  return {{static_cast<const float*>(points_->GetVoidPointer(0)), count},
          triangles_,
          is_closed_,
          pose_,
          Luma(colour_ * light_colour),
          IsPlate()};
}

void LensModel::SetFrame(const LensFrame& frame) {
  const bool has_lens = !simulation::IsEquisolid(frame.lens);
  const bool is_other = has_lens != has_lens_ ||
                        frame.contact.is_equirectangular != contact_.is_equirectangular ||
                        frame.contact.wraps != contact_.wraps;
  has_lens_ = has_lens;
  contact_ = frame.contact;
  if (is_other) Assemble();
  Set("given_contactTip", contact_.tip);
  Set("given_contactRight", contact_.right);
  Set("given_contactUp", contact_.up);
  Set("given_contactAhead", contact_.ahead);
  vtkUniforms* of_fragments = actor_->GetShaderProperty()->GetFragmentCustomUniforms();
  of_fragments->SetUniformf("contactRadius",
                            contact_.texture_unit >= 0 ? Float(contact_.radius) : 0.0f);
  const float centre[2] = {Float(contact_.centre.x), Float(contact_.centre.y)},
              scale[2] = {Float(contact_.scale.x), Float(contact_.scale.y)};
  of_fragments->SetUniform2f("contactCentre", centre);
  of_fragments->SetUniform2f("contactScale", scale);
  Set("given_lensScale", std::sin(frame.field_of_view / 4.0));
  Set("given_windowRadius", frame.window_radius);
  Set("given_lightReach", frame.light_reach);
  Set("given_gain", frame.gain);
  Set("given_relit", frame.relit);
  Set("given_lightColour", frame.light_colour);
  Set("given_surround", frame.surround);
  // Not a steady input: with a lens a tissue's inputs are 57 numbers, and OpenGL guarantees
  // only 60.
  SetInFragments("lampPlace", {frame.shade.lamp.x, frame.shade.lamp.y, 0.0});
  if (look_ == Look::kSteel) {
    SetInFragments("slopeRight", frame.slope[0]);
    SetInFragments("slopeUp", frame.slope[1]);
    SetInFragments("slopeBack", frame.slope[2]);
  }
  if (look_ == Look::kTissue) {
    actor_->GetShaderProperty()->GetFragmentCustomUniforms()->SetUniformf(
        "mirroredShare", Float(frame.mirrored_share));
    Set("given_rodFrom", frame.shade.rod.from);
    Set("given_rodTo", frame.shade.rod.to);
    Set("given_rodRadius", frame.shade.rod.radius);
    Set("given_headFrom", frame.shade.head.from);
    Set("given_headTo", frame.shade.head.to);
    Set("given_headRadius", frame.shade.head.radius);
  }
  if (has_lens_) {
    float outward[simulation::WindowLens::kTerms];
    std::transform(frame.lens.outward.begin(), frame.lens.outward.end(), outward, Float);
    const float axis[2] = {Float(frame.lens.axis.x), Float(frame.lens.axis.y)};
    vtkUniforms* uniforms = actor_->GetShaderProperty()->GetVertexCustomUniforms();
    uniforms->SetUniform1fv("given_lensOutward", simulation::WindowLens::kTerms, outward);
    uniforms->SetUniform2f("given_lensAxis", axis);
    Set("given_lensEnd", frame.lens.end);
  }
}

}  // namespace arthro::app
