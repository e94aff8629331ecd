// GLSL that the backdrop and the models share, so that one depth, one light and one rim hold for
// both. Distances are from the lens, in m.
#pragma once

namespace arthro::app {

// Nearest and farthest drawn distance. Depth is stored as 1/distance in 32-bit float: 3 µm fine at
// 0.1 m.
inline constexpr double kNearest = 0.2e-3, kFarthest = 1.0;  // and in kDepthShader

// Stored depth of a distance: f/(f−n) − f n/((f−n) d), 0 at the nearest, 1 at the farthest.
inline constexpr double StoredDepth(double distance) {
  return kFarthest / (kFarthest - kNearest) * (1.0 - kNearest / distance);
}
inline constexpr double DistanceFromStored(double depth) {
  return kNearest / (1.0 - depth * (kFarthest - kNearest) / kFarthest);
}

// How much further out than with an equisolid lens, or nearer (simulation/scope/window_lens.h).
inline constexpr const char* kLensFactor = R"(
float lensFactor(float terms[10], float end, float squared) {
  float s = min(squared, end), sum = terms[9];
  for (int k = 8; k >= 0; --k) sum = sum * s + terms[k];
  return sum;
}
)";

inline constexpr const char* kDepthShader = R"(
const float nearest = 0.2e-3, farthest = 1.0;
float storedDepth(float distance) {
  return farthest / (farthest - nearest) * (1.0 - nearest / distance);
}
)";

// The footage's light, a factor on linear light: 1 at `lightReach`, brighter nearer (as a camera
// that adapts leaves it), fading beyond. And how a colour ends at the window's rim: `r` is the
// distance from the window's centre in its radii, `rim` the window's radius in pixels. Needs:
// uniform float lightReach.
inline constexpr const char* kLightShader = R"(
float lightAt(float distance) {
  float q = distance / lightReach;
  return 1.25 / (1.0 + 0.25 * q * q);
}
float rimCoverage(float r, float rim) { return clamp((1.0 - r) * rim + 0.5, 0.0, 1.0); }
float softRim(float r) {
  return (1.0 - 0.22 * smoothstep(0.55, 1.0, r)) * (1.0 - smoothstep(0.975, 1.0, r));
}
// Keeps bright parts from flattening to white; nothing below the knee changes. And back: what is
// all but white counts as four times as far above the knee as white is.
const float kKnee = 0.8, kAbove = 1.0 - kKnee;
vec3 shoulder(vec3 c) {
  vec3 over = max(c - kKnee, vec3(0.0));
  return min(c, vec3(kKnee)) + kAbove * (1.0 - exp(-over / kAbove));
}
vec3 unshoulder(vec3 c) {
  vec3 over = clamp((c - kKnee) / kAbove, 0.0, 0.985);
  return min(c, vec3(kKnee)) - kAbove * log(1.0 - over);
}
)";

// The lamp's own light: inverse square from a ring of fibres, under the camera's gain. Needs:
// uniform float lightReach, gain.
inline constexpr const char* kLampShader = R"(
float lampAt(float distance) {
  return gain * lightReach * lightReach / (distance * distance + 0.000016);  // kLampRadius²
}
)";

// What the instrument leaves of the lamp's light at a point (m, in the lens' frame: x right, y up,
// -z along the view): its shadow, since the fibres that give light end beside the lens, with a half
// shadow as wide as they are, and the dimness where it nearly touches. Of a rod, which tapers to
// half its radius, and of what stands away from it. Needs: vec3 lampPlace, rodFrom, rodTo,
// headFrom, headTo; float rodRadius, headRadius (0: there is none).
inline constexpr const char* kRodShade = R"(
float shadeOf(vec3 point, vec3 from, vec3 to, float radius, float taper) {
  // Nearest places of the way to the lamp and of the rod [Ericson 2005, 5.1.9].
  vec3 way = lampPlace - point, rod = to - from, between = point - from;
  float ways = dot(way, way), rods = max(dot(rod, rod), 1e-12), across = dot(way, rod);
  float c = dot(way, between), f = dot(rod, between);
  float s = clamp((across * f - c * rods) / max(ways * rods - across * across, 1e-12 * ways * rods), 0.0, 1.0);
  float t = clamp((across * s + f) / rods, 0.0, 1.0);
  s = clamp((across * t - c) / ways, 0.0, 1.0);
  float thick = radius * (1.0 - taper + taper * smoothstep(0.0, 0.006, (1.0 - t) * sqrt(rods)));
  float gap = length(between + s * way - t * rod) - thick;
  float half_shadow = 0.0014 * s + 0.00005;
  float lamp = smoothstep(-half_shadow, half_shadow, gap);
  float beside = length(between - clamp(f / rods, 0.0, 1.0) * rod);
  float near = thick / max(beside, thick);
  return radius > 0.0 ? mix(0.4, 1.0, lamp) * (1.0 - 0.5 * near * near) : 1.0;
}
float rodShade(vec3 point) {
  return min(shadeOf(point, rodFrom, rodTo, rodRadius, 0.5),
             shadeOf(point, headFrom, headTo, headRadius, 0.0));
}
)";

}  // namespace arthro::app
