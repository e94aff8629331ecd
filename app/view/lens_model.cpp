#include "app/view/lens_model.h"

#include <cmath>
#include <string>

#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <vtkMatrix4x4.h>
#include <vtkOpenGLVertexBufferObject.h>
#include <vtkPointData.h>
#include <vtkProperty.h>
#include <vtkShaderProperty.h>
#include <vtkUniforms.h>

#include "app/view/lens_shader.h"
#include "app/view/vertex_normals.h"

namespace arthro::app {
namespace {

// After VTK's own: the point in the lens' frame (x right, y up, -z along the view) goes to the
// equisolid window. sin(theta/2) = sin(theta) / (2 cos(theta/2)), so no angle is needed; w is the
// distance, so that what is interpolated follows the surface.
constexpr const char* kWarp = R"(//VTK::PositionVC::Impl
  lensPoint = vertexVCVSOutput.xyz;
  modelPoint = vertexMC.xyz;
  float lensDistance = max(length(lensPoint), 1e-7);
  float halfCosine = sqrt(max(0.5 - 0.5 * lensPoint.z / lensDistance, 0.0025));
  vec2 lensPlace = lensPoint.xy / (2.0 * lensScaleV * halfCosine);
  float lensClip = 2.0 * farthestV / (farthestV - nearestV) * (lensDistance - nearestV) - lensDistance;
  gl_Position = vec4(lensPlace, lensClip, lensDistance);
)";

constexpr const char* kFragmentHead = R"(//VTK::Normal::Dec
in vec3 lensPoint;
in vec3 modelPoint;
)";

// A fragment whose own direction lies elsewhere belongs to a triangle that wraps round the back of
// the lens: it is dropped. Then rim, depth, light.
constexpr const char* kFragmentStart = R"(
  float lensDistance = length(lensPoint);
  vec2 lensOffset = (gl_FragCoord.xy - windowRadius) / windowRadius;
  float lensR = length(lensOffset);
  float halfCosine = sqrt(max(0.5 - 0.5 * lensPoint.z / lensDistance, 0.0025));
  vec2 lensPlace = lensPoint.xy / lensDistance / (2.0 * lensScale * halfCosine);
  float coverage = rimCoverage(lensR, windowRadius);
  if (distance(lensPlace, lensOffset) > 0.12 || coverage <= 0.0 || lensDistance < nearest) discard;
  gl_FragDepth = storedDepth(lensDistance);
  vec3 toLens = -lensPoint / lensDistance;
  // The fibres that give light end beside the lens, not in it.
  vec3 toLight = normalize(vec3(0.0, 0.0011, 0.0) - lensPoint);
  vec3 normal = normalVCVSOutput;
  vec3 halfway = normalize(toLight + toLens);
  float facing = max(dot(normal, toLight), 0.0);
  float seen = max(dot(normal, toLens), 0.0);
  float shine = max(dot(normal, halfway), 0.0);
  float light = lightAt(lensDistance);
)";

constexpr const char* kTissueLook = R"(
  // Light that has gone through tissue comes out warmer and softer where it turns away.
  float wrapped = (facing + 0.22) / 1.22;
  vec3 scattered = mix(vec3(1.0, 0.80, 0.70), vec3(1.0), smoothstep(0.0, 0.7, facing));
  vec3 body = modelColour * scattered * (0.10 + 0.90 * pow(wrapped, 1.15)) * lightColour * light;
  // A film of fluid: a broad sheen, a small glint, and the surroundings at grazing angles.
  vec3 wet = lightColour * light * (0.07 * pow(shine, 14.0) + 0.45 * pow(shine, 160.0));
  vec3 mirrored = surround * (0.03 + 0.45 * pow(1.0 - seen, 4.0));
  vec3 linear = body + wet + mirrored;
)";

constexpr const char* kSteelLook = R"(
  if (-modelPoint.z > rodLength) discard;
  // Etched rings every 5 mm from the tip, four of them.
  float ring = -modelPoint.z / 0.005;
  float etched = ring > 0.9 && ring < 4.5 ? 1.0 - smoothstep(0.03, 0.045, abs(ring - round(ring))) : 0.0;
  vec3 steel = modelColour * (1.0 - 0.85 * etched);
  vec3 mirror = reflect(-toLens, normal);
  float lamp = max(dot(mirror, toLight), 0.0);
  vec3 linear = steel * (surround * (0.35 + 0.9 * pow(1.0 - seen, 2.0)) +
      lightColour * light * (0.10 * facing + 0.35 * pow(lamp, 3.0) + 0.9 * pow(lamp, 30.0)));
)";

constexpr const char* kFragmentEnd = R"(
  vec3 shown = shoulder(pow(max(linear, vec3(0.0)), vec3(1.0 / 2.2))) * softRim(lensR) * coverage;
  gl_FragData[0] = vec4(shown, 1.0);
)";

float Float(double value) { return static_cast<float>(value); }

}  // namespace

LensModel::LensModel(Look look) {
  points_->SetDataTypeToFloat();
  normal_array_->SetName("Normals");
  normal_array_->SetNumberOfComponents(3);
  data_->SetPoints(points_);
  data_->GetPointData()->SetNormals(normal_array_);
  mapper_->SetInputData(data_);
  mapper_->ScalarVisibilityOff();
  // Coordinates are metres within a joint: float holds them, and the shader wants them as they are.
  mapper_->SetVBOShiftScaleMethod(vtkOpenGLVertexBufferObject::DISABLE_SHIFT_SCALE);
  actor_->SetMapper(mapper_);
  actor_->ForceOpaqueOn();

  vtkShaderProperty* shader = actor_->GetShaderProperty();
  shader->AddVertexShaderReplacement(
      "//VTK::Normal::Dec", true, "//VTK::Normal::Dec\nout vec3 lensPoint;\nout vec3 modelPoint;\n",
      false);
  shader->AddVertexShaderReplacement("//VTK::PositionVC::Impl", true, kWarp, false);
  shader->AddFragmentShaderReplacement(
      "//VTK::Light::Dec", true, std::string("//VTK::Light::Dec\n") + kDepthShader + kLightShader,
      false);
  shader->AddFragmentShaderReplacement("//VTK::Normal::Dec", true, kFragmentHead, false);
  shader->AddFragmentShaderReplacement("//VTK::Light::Impl", true,
                                       std::string(kFragmentStart) +
                                           (look == Look::kTissue ? kTissueLook : kSteelLook) +
                                           kFragmentEnd,
                                       false);
  vtkUniforms* vertex = shader->GetVertexCustomUniforms();
  vertex->SetUniformf("nearestV", Float(kNearest));
  vertex->SetUniformf("farthestV", Float(kFarthest));
  vtkUniforms* fragment = shader->GetFragmentCustomUniforms();
  fragment->SetUniformf("nearest", Float(kNearest));
  fragment->SetUniformf("farthest", Float(kFarthest));
  if (look == Look::kSteel) SetLength(1.0);
  SetColour(glm::dvec3(1.0));
  SetFrame({});
}

void LensModel::SetSurface(const SurfaceMesh& surface) {
  triangles_ = surface.triangles;
  vtkNew<vtkCellArray> polys;
  for (const auto& triangle : triangles_)
    polys->InsertNextCell({triangle[0], triangle[1], triangle[2]});
  data_->SetPolys(polys);
  points_->SetNumberOfPoints(static_cast<vtkIdType>(surface.vertices.size()));
  normal_array_->SetNumberOfTuples(static_cast<vtkIdType>(surface.vertices.size()));
  SetVertices(surface.vertices);
}

void LensModel::SetVertices(std::span<const glm::dvec3> vertices) {
  ComputeVertexNormals(vertices, triangles_, normals_);
  auto* points = static_cast<float*>(points_->GetVoidPointer(0));
  float* normals = normal_array_->GetPointer(0);
  for (std::size_t i = 0; i < vertices.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      points[i * 3 + static_cast<std::size_t>(c)] = Float(vertices[i][c]);
      normals[i * 3 + static_cast<std::size_t>(c)] = Float(normals_[i][c]);
    }
  points_->Modified();
  normal_array_->Modified();
  data_->Modified();
}

void LensModel::SetPose(const Pose& pose) {
  const glm::dmat3 rotation = glm::mat3_cast(pose.quaternion);
  vtkNew<vtkMatrix4x4> matrix;
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) matrix->SetElement(r, c, pose.scale * rotation[c][r]);
    matrix->SetElement(r, 3, pose.position[r]);
  }
  actor_->SetUserMatrix(matrix);
}

void LensModel::SetColour(const glm::dvec3& linear_rgb) {
  const float colour[3] = {Float(linear_rgb.x), Float(linear_rgb.y), Float(linear_rgb.z)};
  actor_->GetShaderProperty()->GetFragmentCustomUniforms()->SetUniform3f("modelColour", colour);
}

void LensModel::SetLength(double length) {
  actor_->GetShaderProperty()->GetFragmentCustomUniforms()->SetUniformf("rodLength", Float(length));
}

void LensModel::SetFrame(const LensFrame& frame) {
  const float scale = Float(std::sin(frame.field_of_view / 4.0));
  vtkShaderProperty* shader = actor_->GetShaderProperty();
  shader->GetVertexCustomUniforms()->SetUniformf("lensScaleV", scale);
  vtkUniforms* uniforms = shader->GetFragmentCustomUniforms();
  const float light[3] = {Float(frame.light_colour.x), Float(frame.light_colour.y),
                          Float(frame.light_colour.z)};
  const float surround[3] = {Float(frame.surround.x), Float(frame.surround.y),
                             Float(frame.surround.z)};
  uniforms->SetUniformf("lensScale", scale);
  uniforms->SetUniformf("windowRadius", Float(frame.window_radius));
  uniforms->SetUniformf("lightReach", Float(frame.light_reach));
  uniforms->SetUniform3f("lightColour", light);
  uniforms->SetUniform3f("surround", surround);
}

}  // namespace arthro::app
