// GLSL that finds where a ray meets the relief. Lengths are in radii of the sphere; `tip`,
// `clearance` and the projection are those of backdrop_shader.h. A processor goes both ways of
// every if, but leaves a loop as soon as no pixel of a block is in it: what few pixels need stands
// in a loop.
#pragma once

namespace arthro::app {

// Directions and places in the panorama. The gradients say how u and v (texture units) change with
// a point x at any distance.
inline constexpr const char* kPanoramaPlace = R"(
#ifdef EQUIRECTANGULAR
vec2 panoramaPlace(vec3 d) {
  return centre + scale * vec2(atan(d.x, d.z), atan(d.y, length(d.xz)));
}
void placeGradients(vec3 x, out vec3 u, out vec3 v) {
  float level = max(dot(x.xz, x.xz), 1e-8), across = sqrt(level);
  u = scale.x / level * vec3(x.z, 0.0, -x.x);
  v = scale.y / dot(x, x) * vec3(-x.x * x.y / across, across, -x.z * x.y / across);
}
// How much finer the panorama is there than at its centre, at most.
float fineness(vec3 x, float far) { return inversesqrt(max(1.0 - x.y * x.y / far, 1e-4)); }
bool isBefore(vec3 d) { return true; }
#else
vec2 panoramaPlace(vec3 d) { return centre + scale * d.xy / max(d.z, 1e-4); }
void placeGradients(vec3 x, out vec3 u, out vec3 v) {
  float inverse = 1.0 / max(x.z, 1e-4);
  u = scale.x * inverse * vec3(1.0, 0.0, -x.x * inverse);
  v = scale.y * inverse * vec3(0.0, 1.0, -x.y * inverse);
}
float fineness(vec3 x, float far) { return far / max(x.z * x.z, 1e-4 * far); }
bool isBefore(vec3 d) { return d.z > 0.0; }
#endif
bool isImaged(vec3 d, vec2 uv) {
#ifdef WRAPS
  return isBefore(d) && abs(uv.y - 0.5) <= 0.5;
#else
  return isBefore(d) && abs(uv.x - 0.5) <= 0.5 && abs(uv.y - 0.5) <= 0.5;
#endif
}
)";

// The side of a step from what is near to what is far. Steep are all texels that it touches, which
// makes a stair of them; how far down it a place is goes as straight as its outline. So a place is
// held against the relief a little above it, below it and further up, which `looks` are.
inline constexpr const char* kReliefSides = R"(
// Texture units from a place to the one above it.
vec2 upwards(vec4 ground) {
  vec2 uphill = ground.gb / reliefTexels;
  return uphill * (2.2 * inversesqrt(max(dot(uphill, uphill), 1e-18))) / reliefTexels;
}
// Square of how steep a place is, but for what its projection stretches.
float steepness2(vec3 x, vec4 ground) {
  vec2 slope = ground.gb * scale;
  return dot(slope, slope) / dot(x, x);
}
const float kSide = 2.5;  // of a slope
)";

// Nothing lies nearer to the portal than the relief's highest place; from that sphere out to the
// bare one a ray passes a block of texels at once where the relief around does not reach it, and an
// eighth of one where it may. Where it has gone behind the relief the place is closed in on.
inline constexpr const char* kReliefSearch = R"(
// How far x is behind the relief.
float behind(vec3 x) {
  vec2 uv = panoramaPlace(x);
  return (isImaged(x, uv) ? textureLod(relief, uv, 0.0).r * perRadius : 0.0) - 1.0 + length(x);
}
// Nothing within a block is higher.
float ceilingAt(vec2 uv) {
  ivec2 block = ivec2(uv * reliefTexels / blockTexels);
  return texelFetch(reliefCeiling, clamp(block, ivec2(0), textureSize(reliefCeiling, 0) - 1), 0).r * perRadius;
}
// Texels that x passes a radius on its way, at most.
float texelsARadius(vec3 x, vec3 ray) {
  float far = dot(x, x);
  float turn = length(cross(x, ray)) / far;
  return max(turn * fineness(x, far) * max(abs(scale.x) * reliefTexels.x, abs(scale.y) * reliefTexels.y), 1.0);
}
// The first crossing from `near` to `far`; beyond `far` where there is none. Nothing stands before
// `near` if isClear, so that what is behind there has only just come to be (by rounding, where the
// relief is level at its highest).
float firstBehind(vec3 ray, float b, float near, float far, bool isClear) {
  float least = (far - near) / reliefSteps;
  float low = near, high = near, gapLow = behind(tip + near * ray), gapHigh = gapLow;
  bool isMet = isClear && gapLow >= 0.0;
  for (float i = 0.0; i < reliefSteps; i += 1.0) {
    low = high;
    gapLow = gapHigh;
    vec3 x = tip + low * ray;
    float pace = blockTexels / texelsARadius(x, ray);
    // To the end of the block, or to where the relief around begins.
    float ceiling = ceilingAt(panoramaPlace(x));
    float begins = sqrt(max(b * b + clearance + ceiling * (ceiling - 2.0), 0.0)) - b;
    float clear = ceiling < 1.0 - length(x) ? min(pace, begins - low) : 0.0;
    high = min(low + max(clear, max(0.125 * pace, least)), far);
    gapHigh = behind(tip + high * ray);
    if ((gapHigh >= 0.0 && gapLow < 0.0) || high >= far) break;
  }
  if (isMet) return near;
  if (!(gapHigh >= 0.0 && gapLow < 0.0)) return 2.0 * far;
  for (int k = 0; k < 5; ++k) {
    float at = mix(low, high, clamp(gapLow / (gapLow - gapHigh), 0.05, 0.95));
    float gap = behind(tip + at * ray);
    bool is = gap >= 0.0;
    high = is ? at : high, gapHigh = is ? gap : gapHigh;
    low = is ? low : at, gapLow = is ? gapLow : gap;
  }
  return mix(low, high, gapLow / (gapLow - gapHigh));
}
float meetRelief(vec3 ray, float b, float sphere) {
  float inside = clearance + highest * (highest - 2.0);  // (1 - highest)^2 - |tip|^2
  float begins = sqrt(max(b * b + inside, 0.0)) - b;
  // A lens among the relief looks from where it is.
  bool isClear = inside >= 0.0;
  return min(firstBehind(ray, b, isClear ? begins : 0.0, sphere, isClear), sphere);
}
)";

// First of two passes that save most of the search: rays through the corners of cells of cellPixels
// x cellPixels pixels.
inline constexpr const char* kCornersMain = R"(
void main() {
  vec3 ray = rayOf((floor(gl_FragCoord.xy) - 1.0) * cellPixels / windowRadius - 1.0);
  float b = dot(tip, ray);
  float sphere = sqrt(max(b * b + clearance, 0.0)) - b;
  float t = meetRelief(ray, b, sphere);
  vec3 x = tip + t * ray;
  gl_FragData[0] = vec4(t, steepness2(x, textureLod(relief, panoramaPlace(x), 0.0) * perRadius), 0.0, 1.0);
}
)";

// Second: where the relief runs smoothly through a cell, as it does on one side of it at least, and
// is no side of a step, its four corners' distances; elsewhere -1 and from where to where each of
// its pixels has to search.
inline constexpr const char* kCellsMain = R"(
float bendOf(float a, float b, float c, float d) {
  return min(abs(a - 2.0 * b + c), abs(b - 2.0 * c + d));
}
void main() {
  float t[16], steepest = 0.0;
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 4; ++i) {
      vec2 corner = texelFetch(corners, ivec2(gl_FragCoord.xy) + ivec2(i, j), 0).rg;
      t[4 * j + i] = corner.r;
      steepest = max(steepest, corner.g);
    }
  float bend = max(max(bendOf(t[4], t[5], t[6], t[7]), bendOf(t[8], t[9], t[10], t[11])),
                   max(bendOf(t[1], t[5], t[9], t[13]), bendOf(t[2], t[6], t[10], t[14])));
  float low = min(min(t[5], t[6]), min(t[9], t[10])), high = max(max(t[5], t[6]), max(t[9], t[10]));
  float margin = max(0.15 * (high - low), smoothBend * low);
  gl_FragData[0] = bend <= smoothBend * low && steepest < kSide * kSide ? vec4(t[5], t[6], t[9], t[10])
                                            : vec4(-1.0, max(low - margin, 0.0), high + margin, 0.0);
}
)";

// A pixel's own place, from its cell. What no corner's ray has seen, thinner than a cell, may be
// missed. One loop does all, and ends with what the last place has: most pixels go through it once,
// with the one look at the relief that they need anyway; those on the side of a step, three times
// more for the looks about it. (The break is at the end since a processor goes through a loop's
// body once more for a break at its beginning.)
inline constexpr const char* kReliefFromCells = R"(
float meetReliefByCells(vec3 ray, float sphere, out vec3 x, out vec2 uv, out bool imaged, out vec4 ground, out vec3 looks) {
  vec2 place = gl_FragCoord.xy / cellPixels;
  vec4 cell = texelFetch(cells, ivec2(place), 0);
  vec2 f = fract(place);
  bool searches = cell.x < 0.0;
  float t = searches ? cell.y : mix(mix(cell.x, cell.y, f.x), mix(cell.z, cell.w, f.x), f.y);
  float end = min(cell.z, sphere), range = end - cell.y;
  float pace = max(range / cellSteps, min(2.0 / texelsARadius(tip + t * ray, ray), 0.25 * range));
  float low = t, high = end, gapLow = -1e-3, gapHigh = 1e-3;
  float left = searches ? cellSteps + 6.0 : 0.0, closed = 0.0, asks = 0.0;
  vec2 up = vec2(0.0);
  looks = vec3(0.0);
  while (true) {
    bool isLook = asks > 0.0;
    x = tip + t * ray;
    vec2 there = panoramaPlace(x);
    vec4 found = textureLod(relief, there + (asks > 2.5 ? 1.0 : asks > 1.5 ? -1.0 : 2.0) * up, 0.0) * vec4(vec3(perRadius), 1.0);
    looks = isLook ? vec3(looks.yz, found.r) : looks;
    uv = there;
    ground = isLook ? ground : found;
    imaged = isImaged(x, uv);
    float gap = (imaged ? ground.r : 0.0) - 1.0 + length(x);
    bool is = gap >= 0.0;
    high = is ? t : high, gapHigh = is ? gap : gapHigh;
    low = is ? low : t, gapLow = is ? gapLow : gap;
    closed += is || closed > 0.0 ? 1.0 : 0.0;
    left = closed > 4.0 || (closed == 0.0 && t >= end) ? 0.0 : left - 1.0;
    bool isThere = isLook || left <= 0.0;
    asks = isLook ? asks - 1.0 : isThere && searches && steepness2(x, ground) > 0.8 * kSide * kSide ? 3.0 : 0.0;
    up = asks > 0.0 ? upwards(ground) : up;
    if (isThere && asks <= 0.0) break;
    t = isThere ? t : closed > 0.0 ? mix(low, high, clamp(gapLow / (gapLow - gapHigh), 0.05, 0.95)) : min(t + pace, end);
  }
  return t;
}
)";

}  // namespace arthro::app
