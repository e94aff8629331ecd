#include "app/view/drawing/lens_model.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <string>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <vtkDataObject.h>
#include <vtkMatrix4x4.h>
#include <vtkOpenGLVertexBufferObject.h>
#include <vtkPointData.h>
#include <vtkProperty.h>
#include <vtkShaderProperty.h>
#include <vtkUniforms.h>

#include "app/view/drawing/shader_text.h"
#include "app/view/drawing/srgb.h"
#include "app/view/drawing/steady_inputs.h"
#include "simulation/scene/vertex_normals.h"

namespace arthro::app {
namespace {

// Area vectors of a closed surface cancel; its volume is positive when they face outwards.
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
  return volume > 0.0 && glm::length(sum) < 1e-6 * area;
}

float Float(double value) { return static_cast<float>(value); }

}  // namespace

LensModel::LensModel(Look look) : look_(look) {
  points_->SetDataTypeToFloat();
  normal_array_->SetName("Normals");
  normal_array_->SetNumberOfComponents(3);
  data_->SetPoints(points_);
  data_->GetPointData()->SetNormals(normal_array_);
  if (look == Look::kTissue) {
    fresh_array_->SetName("Fresh");
    data_->GetPointData()->AddArray(fresh_array_);
    mapper_->MapDataArrayToVertexAttribute("freshMC", "Fresh",
                                           vtkDataObject::FIELD_ASSOCIATION_POINTS, -1);
  }
  mapper_->SetInputData(data_);
  mapper_->ScalarVisibilityOff();
  // Coordinates are metres within a joint: float holds them, and the shader takes them unscaled.
  mapper_->SetVBOShiftScaleMethod(vtkOpenGLVertexBufferObject::DISABLE_SHIFT_SCALE);
  actor_->SetMapper(mapper_);
  actor_->ForceOpaqueOn();

  Assemble();
  if (look == Look::kSteel) {
    SetLength(1.0);
    SetEtched(true);
  }
  SetColour(glm::dvec3(1.0));
  SetFrame({});
}

void LensModel::Assemble() {
  std::vector<std::string> defines;
  if (look_ == Look::kTissue) defines.push_back("TISSUE");
  if (has_lens_) defines.push_back("LENS");
  const SteadyInputs inputs = TakeSteadyInputs(ShaderText("model_inputs.glsl", defines));
  const auto common = [](std::initializer_list<std::string> stage) {
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
  vtkNew<vtkCellArray> polys;
  for (const auto& triangle : triangles_)
    polys->InsertNextCell({triangle[0], triangle[1], triangle[2]});
  data_->SetPolys(polys);
  points_->SetNumberOfPoints(count);
  normal_array_->SetNumberOfTuples(count);
  fresh_array_->SetNumberOfTuples(count);
  for (vtkIdType i = 0; i < count; ++i)
    fresh_array_->SetValue(i, !fresh.empty() && fresh[static_cast<std::size_t>(i)] ? 1.0f : 0.0f);
  fresh_array_->Modified();
  SetShape(surface.vertices);
  points_->Modified();
  data_->Modified();
  // The inside of a closed surface is never seen; culling saves half the work.
  is_closed_ = IsClosedAndOutward(surface);
  actor_->GetProperty()->SetBackfaceCulling(is_closed_ ? 1 : 0);
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
  pose_ = pose;
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

void LensModel::Set(const char* given_name, const glm::dvec3& value) {
  const float v[3] = {Float(value.x), Float(value.y), Float(value.z)};
  actor_->GetShaderProperty()->GetVertexCustomUniforms()->SetUniform3f(given_name, v);
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
          Luma(colour_ * light_colour)};
}

void LensModel::SetFrame(const LensFrame& frame) {
  if (has_lens_ == simulation::IsEquisolid(frame.lens)) {
    has_lens_ = !has_lens_;
    Assemble();
  }
  Set("given_lensScale", std::sin(frame.field_of_view / 4.0));
  Set("given_windowRadius", frame.window_radius);
  Set("given_lightReach", frame.light_reach);
  Set("given_gain", frame.gain);
  Set("given_relit", frame.relit);
  Set("given_lightColour", frame.light_colour);
  Set("given_surround", frame.surround);
  // Not a steady input: with a lens a tissue's inputs are 59 numbers, and OpenGL guarantees
  // only 60.
  const float lamp[3] = {Float(frame.shade.lamp.x), Float(frame.shade.lamp.y), 0.0f};
  actor_->GetShaderProperty()->GetFragmentCustomUniforms()->SetUniform3f("lampPlace", lamp);
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
