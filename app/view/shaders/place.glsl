// Directions and their places in the panorama. The gradients say how u and v (texture units) change
// with a point x at any distance.
// Needs: vec2 centre, scale (texture units).
const float kLeastLevel = 1e-8;  // squared distance from the poles' axis, radii^2
const float kLeastAhead = 1e-4;  // z of a direction in front of a gnomonic panorama
#ifdef EQUIRECTANGULAR
vec2 panoramaPlace(vec3 d) {
  return centre + scale * vec2(atan(d.x, d.z), atan(d.y, length(d.xz)));
}
void placeGradients(vec3 x, out vec3 u, out vec3 v) {
  float level = max(dot(x.xz, x.xz), kLeastLevel), across = sqrt(level);
  u = scale.x / level * vec3(x.z, 0.0, -x.x);
  v = scale.y / dot(x, x) * vec3(-x.x * x.y / across, across, -x.z * x.y / across);
}
// Returns an upper bound of the panorama's resolution at x over that at its centre.
float fineness(vec3 x, float far) { return inversesqrt(max(1.0 - x.y * x.y / far, kLeastAhead)); }
bool isBefore(vec3 d) { return true; }
#else
vec2 panoramaPlace(vec3 d) { return centre + scale * d.xy / max(d.z, kLeastAhead); }
void placeGradients(vec3 x, out vec3 u, out vec3 v) {
  float inverse = 1.0 / max(x.z, kLeastAhead);
  u = scale.x * inverse * vec3(1.0, 0.0, -x.x * inverse);
  v = scale.y * inverse * vec3(0.0, 1.0, -x.y * inverse);
}
float fineness(vec3 x, float far) { return far / max(x.z * x.z, kLeastAhead * far); }
bool isBefore(vec3 d) { return d.z > 0.0; }
#endif
bool isImaged(vec3 d, vec2 uv) {
#ifdef WRAPS
  return isBefore(d) && abs(uv.y - 0.5) <= 0.5;
#else
  return isBefore(d) && abs(uv.x - 0.5) <= 0.5 && abs(uv.y - 0.5) <= 0.5;
#endif
}
// Returns how far a place is beyond the edge of the panorama, texture units.
vec2 beyondEdge(vec2 uv) {
  vec2 beyond = max(abs(uv - 0.5) - 0.5, 0.0);
#ifdef WRAPS
  beyond.x = 0.0;
#endif
  return beyond;
}
