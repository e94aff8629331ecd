// Intersection of a ray with the relief. Lengths are in radii of the sphere. A software rasteriser
// executes both branches of every `if`, but leaves a loop as soon as no pixel of its block is in
// it: work that few pixels need therefore stands in a loop.
#include "panorama.glsl"

// Sides of steps from near to far relief. All texels that a step touches are steep, which gives a
// jagged region, while the relief along the slope varies as smoothly as the outline. A place is
// therefore compared with the relief a little above it, below it and further up (`looks`).
const float kSide = 2.5;        // slope from which a place counts as the side of a step
const float kLookTexels = 2.2;  // texels of the relief from a place to the one above it
const float kLeastSlope2 = 1e-18;

// Returns the offset from a place to the one above it, in texture units.
vec2 upwards(vec4 ground) {
  vec2 uphill = ground.gb / reliefTexels;
  return uphill * (kLookTexels * inversesqrt(max(dot(uphill, uphill), kLeastSlope2))) /
         reliefTexels;
}
// Returns the squared slope of a place, without the stretch of the projection.
float steepness2(vec3 x, vec4 ground) {
  vec2 slope = ground.gb * scale;
  return dot(slope, slope) / dot(x, x);
}

// Returns how far x is behind the relief. Beyond the panorama the relief of its edge goes on, so
// that the edge is no cliff.
float behind(vec3 x) {
  vec2 uv = panoramaPlace(x);
  return (isBefore(x) ? textureLod(relief, uv, 0.0).r * perRadius : 0.0) - 1.0 + length(x);
}
// Returns the maximum of the relief in the block around uv.
float ceilingAt(vec2 uv) {
  ivec2 block = ivec2(uv * reliefTexels / blockTexels);
  return texelFetch(reliefCeiling, clamp(block, ivec2(0), textureSize(reliefCeiling, 0) - 1), 0).r *
         perRadius;
}
// Returns an upper bound of the texels that x passes per radius of its way.
float texelsPerRadius(vec3 x, vec3 ray) {
  float far = dot(x, x);
  float turn = length(cross(x, ray)) / far;
  return max(
      turn * fineness(x, far) * max(abs(scale.x) * reliefTexels.x, abs(scale.y) * reliefTexels.y),
      1.0);
}

// Returns the first crossing between `near` and `far`, or a value beyond `far` when there is none.
// The search begins at the sphere of the relief's maximum. A step is a whole block of texels where
// the ray passes above the block's maximum, and kShortStep of it elsewhere. It is longer where the
// steps that remain would not reach `far`. Regula falsi refines the crossing. With isClear nothing
// stands before `near`, so a place behind the relief there has just been reached (by rounding, where
// the relief is level at its maximum).
const float kShortStep = 0.125;  // blocks
const int kRefinements = 5;
const float kLeastCut = 0.05, kMostCut = 0.95;  // share of the interval at which it is divided
float firstBehind(vec3 ray, float b, float near, float far, bool isClear) {
  float low = near, high = near, gapLow = behind(tip + near * ray), gapHigh = gapLow;
  bool isMet = isClear && gapLow >= 0.0;
  for (float i = 0.0; i < reliefSteps; i += 1.0) {
    low = high;
    gapLow = gapHigh;
    float least = (far - low) / (reliefSteps - i);
    vec3 x = tip + low * ray;
    float pace = blockTexels / texelsPerRadius(x, ray);
    // To the end of the block, or to the sphere of the block's maximum.
    float ceiling = ceilingAt(panoramaPlace(x));
    float begins = sqrt(max(b * b + clearance + ceiling * (ceiling - 2.0), 0.0)) - b;
    float clear = ceiling < 1.0 - length(x) ? min(pace, begins - low) : 0.0;
    high = min(low + max(clear, max(kShortStep * pace, least)), far);
    gapHigh = behind(tip + high * ray);
    if ((gapHigh >= 0.0 && gapLow < 0.0) || high >= far) break;
  }
  if (isMet) return near;
  if (!(gapHigh >= 0.0 && gapLow < 0.0)) return 2.0 * far;
  for (int k = 0; k < kRefinements; ++k) {
    float at = mix(low, high, clamp(gapLow / (gapLow - gapHigh), kLeastCut, kMostCut));
    float gap = behind(tip + at * ray);
    bool is = gap >= 0.0;
    high = is ? at : high, gapHigh = is ? gap : gapHigh;
    low = is ? low : at, gapLow = is ? gapLow : gap;
  }
  return mix(low, high, gapLow / (gapLow - gapHigh));
}
// Returns the distance along the ray to the relief; the sphere's where it meets none.
float meetRelief(vec3 ray, float b, float sphere) {
  float inside = clearance + highest * (highest - 2.0);  // (1 - highest)^2 - |tip|^2
  float begins = sqrt(max(b * b + inside, 0.0)) - b;
  // A lens within the relief searches from where it is.
  bool isClear = inside >= 0.0;
  return min(firstBehind(ray, b, isClear ? begins : 0.0, sphere, isClear), sphere);
}
