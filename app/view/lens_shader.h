// GLSL that the backdrop and the models share, so that one depth, one light and one rim hold for
// both. Distances are from the lens, in m.
#pragma once

namespace arthro::app {

// Nearest and farthest drawn distance. Depth is stored as 1/distance in 32-bit float: 3 µm fine at
// 0.1 m.
inline constexpr double kNearest = 0.2e-3, kFarthest = 1.0;

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

// Needs: uniform float nearest, farthest.
inline constexpr const char* kDepthShader = R"(
float storedDepth(float distance) {
  return farthest / (farthest - nearest) * (1.0 - nearest / distance);
}
)";

// Light from the lens: 1 at `lightReach`, brighter nearer (as a camera that adapts leaves it),
// fading beyond; a factor on linear light. And how a colour ends at the window's rim: `r` is the
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
// Keeps bright parts from flattening to white; nothing below 0.8 changes.
vec3 shoulder(vec3 c) {
  vec3 over = max(c - 0.8, vec3(0.0));
  return min(c, vec3(0.8)) + 0.2 * (1.0 - exp(-over / 0.2));
}
)";

}  // namespace arthro::app
