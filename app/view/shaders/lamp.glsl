// Light of the scope's own lamp, and the shadow of the instrument in it. Points are in the lens
// frame, m: x right, y up, -z along the view.
// Needs: float lightReach (m), gain; with ROD also vec3 lampPlace, rodFrom, rodTo, headFrom, headTo
// and float rodRadius, headRadius (m; 0: no such part).
#include "constants.inc"

// Returns inverse-square light from the ring of fibres, under the camera's gain.
float lampAt(float distance) {
  return gain * lightReach * lightReach / (distance * distance + kLampRadiusSquared);
}

#ifdef ROD
const float kTaperLength = 0.006;  // m
const float kPenumbra =
    0.0014;  // m, half width of the penumbra at the lamp, which is that of its fibres
const float kLeastPenumbra = 0.00005;  // m
const float kInShadow = 0.4;           // light that is left in the full shadow
const float kContactShade = 0.5;       // loss of light where the instrument touches
const float kLeastSquare = 1e-12;      // m^2, keeps divisions finite

// Returns the share of the lamp's light that a capsule leaves at a point: its shadow with a
// penumbra, and ambient occlusion near contact.
float shadeOf(vec3 point, vec3 from, vec3 to, float radius, float taper) {
  // Closest points of the segments point-lamp and from-to [Ericson 2005, 5.1.9].
  vec3 way = lampPlace - point, rod = to - from, between = point - from;
  float ways = dot(way, way), rods = max(dot(rod, rod), kLeastSquare), across = dot(way, rod);
  float c = dot(way, between), f = dot(rod, between);
  float s = clamp(
      (across * f - c * rods) / max(ways * rods - across * across, kLeastSquare * ways * rods), 0.0,
      1.0);
  float t = clamp((across * s + f) / rods, 0.0, 1.0);
  s = clamp((across * t - c) / ways, 0.0, 1.0);
  float thick =
      radius * (1.0 - taper + taper * smoothstep(0.0, kTaperLength, (1.0 - t) * sqrt(rods)));
  float gap = length(between + s * way - t * rod) - thick;
  float half_shadow = kPenumbra * s + kLeastPenumbra;
  float lamp = smoothstep(-half_shadow, half_shadow, gap);
  float beside = length(between - clamp(f / rods, 0.0, 1.0) * rod);
  float near = thick / max(beside, thick);
  return radius > 0.0 ? mix(kInShadow, 1.0, lamp) * (1.0 - kContactShade * near * near) : 1.0;
}
float rodShade(vec3 point) {
  return min(shadeOf(point, rodFrom, rodTo, rodRadius, kRodTaper),
             shadeOf(point, headFrom, headTo, headRadius, 0.0));
}
#endif
