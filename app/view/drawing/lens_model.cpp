#include "app/view/drawing/lens_model.h"

#include <algorithm>
#include <cmath>
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

#include "app/view/drawing/lens_shader.h"
#include "app/view/drawing/srgb.h"
#include "app/view/drawing/steady_inputs.h"
#include "simulation/scene/vertex_normals.h"

namespace arthro::app {
namespace {

// After VTK's own: the point in the lens' frame (x right, y up, -z along the view) goes to the
// window. sin(theta/2) = sin(theta) / (2 cos(theta/2)), so no angle is needed; w is the distance,
// so that what is interpolated follows the surface.
constexpr const char* kWarp = R"(//VTK::PositionVC::Impl
  handOn();
  lensPoint = vertexVCVSOutput.xyz;
  modelPoint = vertexMC.xyz;
  float lensDistance = max(length(lensPoint), 1e-7);
  float halfCosine = sqrt(max(0.5 - 0.5 * lensPoint.z / lensDistance, 0.0025));
  vec2 lensPlace = lensPoint.xy / lensDistance / (2.0 * lensScale * halfCosine);
#ifdef LENS
  lensPlace = lensAxis + lensPlace * lensFactor(lensOutward, lensEnd, dot(lensPlace, lensPlace));
#endif
  float lensClip = 2.0 * farthest / (farthest - nearest) * (lensDistance - nearest) - lensDistance;
  gl_Position = vec4(lensDistance * lensPlace, lensClip, lensDistance);
)";

constexpr const char* kSteady = R"(
steady vec3 modelColour, lightColour, surround;
steady float lensScale, windowRadius, lightReach, gain, relit;
)";
constexpr const char* kLensSteady = R"(
steady float lensOutward[10], lensEnd;
steady vec2 lensAxis;
)";
constexpr const char* kTissueSteady = R"(
steady vec3 rodFrom, rodTo, headFrom, headTo;
steady float rodRadius, headRadius;
)";
constexpr const char* kSteelSteady = R"(
steady float rodLength, etchedRings;
)";

// A fragment whose own direction is outside the window, or elsewhere in it, belongs to a triangle
// that wraps round the back of the lens: it is dropped. Then rim, depth, light.
constexpr const char* kFragmentStart = R"(
  float lensDistance = length(lensPoint);
  vec2 lensOffset = (gl_FragCoord.xy - windowRadius) / windowRadius;
  float lensR = length(lensOffset);
  float halfCosine = sqrt(max(0.5 - 0.5 * lensPoint.z / lensDistance, 0.0025));
  vec2 lensPlace = lensPoint.xy / lensDistance / (2.0 * lensScale * halfCosine);
#ifdef LENS
  lensPlace = lensAxis + lensPlace * lensFactor(lensOutward, lensEnd, dot(lensPlace, lensPlace));
#endif
  float coverage = rimCoverage(lensR, windowRadius);
  bool behind = lensPoint.z > (2.42 * lensScale * lensScale - 1.0) * lensDistance;
  if (behind || distance(lensPlace, lensOffset) > 0.12 || coverage <= 0.0 || lensDistance < nearest)
    discard;
  gl_FragDepth = storedDepth(lensDistance);
  vec3 toLens = -lensPoint / lensDistance;
  // The fibres that give light end beside the lens, not in it.
  vec3 toLight = normalize(lampPlace - lensPoint);
  vec3 normal = normalVCVSOutput;
  vec3 halfway = normalize(toLight + toLens);
  float facing = max(dot(normal, toLight), 0.0);
  float seen = max(dot(normal, toLens), 0.0);
  float shine = max(dot(normal, halfway), 0.0);
  float light = mix(lightAt(lensDistance), lampAt(lensDistance), relit);
)";

// Value noise with its gradient: xyz slope, w value, about -1 to 1. An integer hash, so that every
// driver gives the same pattern.
constexpr const char* kNoise = R"(
float lattice(ivec3 p) {
  uint h = uint(p.x) * 0x8da6b343u + uint(p.y) * 0xd8163841u + uint(p.z) * 0xcb1ab31fu;
  h = (h ^ (h >> 15)) * 0x2c1b3c6du;
  h = (h ^ (h >> 12)) * 0x297a2d39u;
  return float(h >> 8) * (2.0 / 16777215.0) - 1.0;
}
vec4 noise(vec3 p) {
  vec3 cell = floor(p), f = p - cell;
  ivec3 i = ivec3(cell);
  vec3 u = f * f * (3.0 - 2.0 * f), du = 6.0 * f * (1.0 - f);
  float a = lattice(i), b = lattice(i + ivec3(1, 0, 0)), c = lattice(i + ivec3(0, 1, 0)),
        d = lattice(i + ivec3(1, 1, 0)), e = lattice(i + ivec3(0, 0, 1)),
        g = lattice(i + ivec3(1, 0, 1)), h = lattice(i + ivec3(0, 1, 1)),
        k = lattice(i + ivec3(1, 1, 1));
  float k1 = b - a, k2 = c - a, k3 = e - a, k4 = a - b - c + d, k5 = a - c - e + h,
        k6 = a - b - e + g, k7 = b + c + e - a - d - h - g + k;
  return vec4(du * vec3(k1 + k4 * u.y + k6 * u.z + k7 * u.y * u.z,
                        k2 + k5 * u.z + k4 * u.x + k7 * u.z * u.x,
                        k3 + k6 * u.x + k5 * u.y + k7 * u.x * u.y),
              a + k1 * u.x + k2 * u.y + k3 * u.z + k4 * u.x * u.y + k5 * u.y * u.z +
                  k6 * u.z * u.x + k7 * u.x * u.y * u.z);
}
)";

// normalMatrix is VTK's own uniform.
constexpr const char* kTissueLook = R"(
  // Uneven by nature: patches of some millimetres, and a surface that is not quite smooth.
  vec4 coarse = coarseNoise, fine = noise(modelPoint * 1100.0);
  mat3 lensFromModel = normalMatrix / length(normalMatrix[0]);
  normal = normalize(normal + 0.022 * (lensFromModel * fine.xyz) + 0.014 * coarse.xyz);
  facing = max(dot(normal, toLight), 0.0);
  shine = max(dot(normal, halfway), 0.0);
  vec3 own = modelColour * (1.0 + 0.04 * coarse.w + 0.02 * fine.w) *
             mix(vec3(1.0), vec3(1.0, 0.96, 0.92), 0.5 + 0.5 * coarse.w);
  // A cut face is paler than the skin, yellowish, and shows its fibres as fine streaks.
  own = mix(own, vec3(0.86, 0.80, 0.62) * (1.0 + 0.10 * fine.w), 0.75 * fresh);
  // Light that has gone through tissue comes out warmer and softer where it turns away.
  float wrapped = (facing + 0.3) / 1.3;
  vec3 scattered = mix(vec3(0.95, 0.70, 0.58), vec3(1.0), smoothstep(0.0, 0.75, facing));
  vec3 body = own * scattered * (0.12 + 0.88 * wrapped) * lightColour * light;
  float shine2 = shine * shine, shine4 = shine2 * shine2, shine8 = shine4 * shine4;
  float shine64 = shine8 * shine8;
  shine64 *= shine64 * shine64 * shine64;
  float glance = (1.0 - seen) * (1.0 - seen);
  // A film of fluid: a broad sheen, a small glint, and the surroundings at grazing angles.
  vec3 wet = lightColour * light * (0.05 * shine8 * shine4 * shine2 + 0.5 * shine64 * shine64 * shine64);
  vec3 mirrored = surround * (0.03 + 0.35 * glance * glance);
  vec3 linear = (body + wet) * rodShade(lensPoint) + mirrored;
)";

constexpr const char* kSteelLook = R"(
  if (-modelPoint.z > rodLength) discard;
  // Etched rings every 5 mm from the tip, four of them.
  float ring = -modelPoint.z / 0.005;
  float etched = etchedRings > 0.5 && ring > 0.9 && ring < 4.5 ? 1.0 - smoothstep(0.03, 0.045, abs(ring - round(ring))) : 0.0;
  vec3 steel = modelColour * (1.0 - 0.85 * etched);
  // Brushed: it mirrors the joint greyly and mostly at its edges, and the lamp as a streak.
  vec3 mirror = reflect(-toLens, normal);
  float lamp = max(dot(mirror, toLight), 0.0);
  vec3 grey = mix(surround, vec3(dot(surround, vec3(0.2126, 0.7152, 0.0722))), 0.75);
  float sky = 0.5 + 0.5 * dot(mirror, normalize(lampPlace));  // the joint's lit side
  vec3 linear = steel * (grey * (0.26 + 0.7 * sky * sky + 0.5 * pow(1.0 - seen, 3.0)) +
      lightColour * light * (0.24 * facing * facing + 0.36 * pow(lamp, 4.0) + 1.2 * pow(lamp, 40.0)));
)";

constexpr const char* kFragmentEnd = R"(
  // The power 1/2.2 to 0.002, by roots.
  vec3 root = sqrt(max(linear, vec3(0.0))), root2 = sqrt(root);
  vec3 shown = 0.585122381 * root + 0.783140355 * root2 - 0.368262736 * sqrt(root2);
  shown = shoulder(max(shown, vec3(0.0))) * softRim(lensR) * coverage;
  gl_FragData[0] = vec4(shown, 1.0);
)";

// Area vectors of a closed surface cancel; its volume is positive when they look outward.
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
  // Coordinates are metres within a joint: float holds them, and the shader wants them as they are.
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
  const bool is_tissue = look_ == Look::kTissue;
  const std::string define = has_lens_ ? "#define LENS\n" : "";
  const SteadyInputs inputs =
      TakeSteadyInputs(std::string(kSteady) + (is_tissue ? kTissueSteady : kSteelSteady) +
                       (has_lens_ ? kLensSteady : ""));
  const std::string shared = kDepthShader + std::string(has_lens_ ? kLensFactor : "");
  const auto ways = [&](const char* direction) {
    return direction + std::string(" vec3 lensPoint, modelPoint;\n") +
           (is_tissue ? direction + std::string(" float fresh;\n") + direction +
                            " vec4 coarseNoise;\n" + kNoise
                      : "");
  };
  vtkShaderProperty* shader = actor_->GetShaderProperty();
  shader->ClearAllShaderReplacements();
  shader->AddVertexShaderReplacement("//VTK::Normal::Dec", true,
                                     "//VTK::Normal::Dec\n" + define + shared + inputs.outputs +
                                         (is_tissue ? "in float freshMC;\n" : "") + ways("out"),
                                     false);
  shader->AddVertexShaderReplacement(
      "//VTK::PositionVC::Impl", true,
      std::string(kWarp) +
          (is_tissue
               ? "  fresh = freshMC;\n  coarseNoise = noise(modelPoint * 300.0);\n"
                 "  coarseNoise.xyz = normalMatrix * coarseNoise.xyz / length(normalMatrix[0]);\n"
               : ""),
      false);
  shader->AddFragmentShaderReplacement("//VTK::Light::Dec", true,
                                       "//VTK::Light::Dec\n" + define + inputs.fragment +
                                           ways("in") + shared + kLightShader + kLampShader +
                                           (is_tissue ? kRodShade : ""),
                                       false);
  shader->AddFragmentShaderReplacement(
      "//VTK::Light::Impl", true,
      std::string(kFragmentStart) + (is_tissue ? kTissueLook : kSteelLook) + kFragmentEnd, false);
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
  // Of a closed surface the inside is never seen, and half the work is saved.
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
  // No steady one: with a lens a tissue's inputs are 59 numbers, of 60 that every card must have.
  const float lamp[3] = {Float(frame.shade.lamp.x), Float(frame.shade.lamp.y), 0.0f};
  actor_->GetShaderProperty()->GetFragmentCustomUniforms()->SetUniform3f("lampPlace", lamp);
  if (look_ == Look::kTissue) {
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
