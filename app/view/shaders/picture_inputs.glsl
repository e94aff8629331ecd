// Inputs of the passes over the finished picture (lens_pass.cpp). Distances in m, places in the
// window in its radii. Variants: BLUR, NEAR_BLUR, HAZE, FOG, OVEREXPOSED.
#include "distance.glsl"
uniform sampler2D depths;
steady float windowRadius;  // px
steady float lightReach;    // m
#include "light.glsl"

const float kLeastRim = 0.02;  // smallest vignetting factor that is divided by
const float kGamma = 2.2;      // approximates sRGB

// Returns the stored depth; 0 outside the window and under its mark, where nothing was drawn.
float storedAt(vec2 at) {
  float stored = textureLod(depths, at, 0.0).r;
  return stored < 1.0 ? stored : 0.0;
}
float distanceOf(float stored) {
  return kNearest / (1.0 - min(stored, 1.0) * (kFarthest - kNearest) / kFarthest);
}
