// Light of the footage, the rim of the round window, and the camera's response to bright light.
// Needs: float lightReach (m), the distance at which the footage's light is neutral.

// Returns the footage's light as a factor on linear light: 1 at lightReach, brighter when nearer
// (as an adapting camera leaves it), darker when farther.
const float kFootageFall = 0.25;  // share of the inverse-square term at lightReach
float lightAt(float distance) {
  float q = distance / lightReach;
  return (1.0 + kFootageFall) / (1.0 + kFootageFall * q * q);
}

// Returns the share of a pixel inside the window: r is its distance from the centre in window
// radii, rim the window's radius, px.
float rimCoverage(float r, float rim) { return clamp((1.0 - r) * rim + 0.5, 0.0, 1.0); }

// Returns the vignetting factor at r window radii: darker towards the rim, black at it.
const float kVignette = 0.22;       // loss of light at the rim
const float kVignetteStart = 0.55;  // window radii
float softRim(float r) {
  return (1.0 - kVignette * smoothstep(kVignetteStart, 1.0, r)) *
         (1.0 - smoothstep(kRimStart, 1.0, r));
}

// Compresses values above the knee exponentially, so that highlights do not clip to white. The
// inverse treats values near white as kMostOver of the range above the knee.
const float kKnee = 0.8, kAbove = 1.0 - kKnee;
const float kMostOver = 0.985;
vec3 shoulder(vec3 c) {
  vec3 over = max(c - kKnee, vec3(0.0));
  return min(c, vec3(kKnee)) + kAbove * (1.0 - exp(-over / kAbove));
}
vec3 unshoulder(vec3 c) {
  vec3 over = clamp((c - kKnee) / kAbove, 0.0, kMostOver);
  return min(c, vec3(kKnee)) - kAbove * log(1.0 - over);
}
