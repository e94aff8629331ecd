// The camera behind the scope, over the finished picture: lateral colour, sharpness, exposure and
// grain [method.md, Camera]. Reads a picture of the same size, or of twice the size and averages
// four pixels by the filter of the texture. Variants: SAME_SIZE, OCCLUDED, MARKS, EDGES,
// FRINGE, NEAR_FRINGE, DETAIL and GRAIN. OCCLUDED multiplies the picture by the light of its
// occlusion. NEAR_FRINGE, with DETAIL, moves colours by less than a pixel. MARKS draws all pixels
// without smoothing and writes the depth 1 at edges, 0 elsewhere; EDGES then draws the pixels at
// edges alone, by a depth test.
#include "constants.inc"
#ifdef OCCLUDED
#include "occlusion_light.glsl"
#endif
in vec2 texCoord;
uniform sampler2D picture;
steady float pixel;         // side of a pixel, texture units
steady float gain, offset;  // camera_exposure.h
steady float fringe, sharpening, rimBlur, grain;
#ifdef GRAIN
uniform int seed;
#endif

const vec3 kLuma = vec3(kLumaRed, kLumaGreen, kLumaBlue);
// The gain raises the saturation of stored colours; a part of it is taken back, and more of bright
// parts, as the wells of a sensor fill.
const float kLessColour = 0.1, kBleached = 0.7, kBleachStart = 0.7;
const float kLeastEdge = 0.1;  // smallest fade that is divided by
// Gain of a usual camera on detail. Detail up to the coring level is noise for it: it is smoothed.
const float kDetailGain = 3.6;
const float kCoring = 0.7 / 255.0;  // stored level
const float kMostDetail = 14.0 / 255.0;  // limit of what is enhanced
// Limit beside an edge, against halos: 3.6 times that is the 18 levels by which a real camera draws
// the foot of an edge of 100 levels too dark.
const float kMostHalo = 5.0 / 255.0;
float lumaAt(vec2 at) { return dot(textureLod(picture, at, 0.0).rgb, kLuma); }

// Returns the colour of the pixel that lies (x, y) pixels aside. SAME_SIZE: reads one texel.
vec3 colourAside(int x, int y) {
#ifdef SAME_SIZE
  ivec2 at = ivec2(gl_FragCoord.xy) + ivec2(x, y);
  return texelFetch(picture, clamp(at, ivec2(0), textureSize(picture, 0) - 1), 0).rgb;
#else
  return textureLod(picture, texCoord + pixel * vec2(x, y), 0.0).rgb;
#endif
}

#ifdef DETAIL
// Returns how far a pixel lies above both its neighbours, or below both: beside an edge it is 0. A
// height of twice the limit is a stair of an edge, and no detail either.
float ridge(float before, float after) {
  float height = before * after > 0.0 ? min(abs(before), abs(after)) : 0.0;
  return max(min(height, 2.0 * kMostDetail - height), 0.0);
}
#endif

#if defined(MARKS) || defined(EDGES)
const float kLeastContrast = 0.05;  // stored level
const float kLeastShare = 0.12;     // share of the brighter part
// Returns the range of the luma of a pixel and its neighbours, and the least range of an edge.
vec2 contrast(float middle, float n, float s, float e, float w) {
  float most = max(middle, max(max(n, s), max(e, w)));
  float range = most - min(middle, min(min(n, s), min(e, w)));
  return vec2(range, max(kLeastContrast, kLeastShare * most));
}
#endif

#ifdef EDGES
// Smooths a stair where two parts meet: moves the pixel's sample towards the part beside it by its
// place along the stair [Lottes 2009, FXAA].
const float kSameEdge = 0.25;  // share of the step up to which a place belongs to the edge
const float kMostWay = 5.0;    // px along the edge, on either side
const float kAlone = 0.75;     // px, for a single pixel
vec3 withoutStairs(float middle, float n, float s, float e, float w) {
  bool isLevel = abs(n + s - 2.0 * middle) >= abs(e + w - 2.0 * middle);
  float before = isLevel ? s : w, after = isLevel ? n : e;
  float riseBefore = abs(before - middle), riseAfter = abs(after - middle);
  float side = riseBefore >= riseAfter ? -1.0 : 1.0;
  float rise = max(riseBefore, riseAfter);
  vec2 across = (isLevel ? vec2(0.0, pixel) : vec2(pixel, 0.0)) * side;
  vec2 along = isLevel ? vec2(pixel, 0.0) : vec2(0.0, pixel);
  float mean = 0.5 * (middle + (side < 0.0 ? before : after));
  vec2 place = texCoord + 0.5 * across;
  // Way to either end of the stair; the ends are where the mean of both sides changes.
  float back = 0.0, ahead = 0.0, endBack = 0.0, endAhead = 0.0;
  bool goesBack = true, goesAhead = true;
  for (float i = 1.0; i <= kMostWay; i += 1.0) {
    if (goesBack) {
      back = i;
      endBack = lumaAt(place - i * along) - mean;
      goesBack = abs(endBack) < kSameEdge * rise;
    }
    if (goesAhead) {
      ahead = i;
      endAhead = lumaAt(place + i * along) - mean;
      goesAhead = abs(endAhead) < kSameEdge * rise;
    }
    if (!goesBack && !goesAhead) break;
  }
  float nearer = min(back, ahead);
  float end = back < ahead ? endBack : endAhead;
  bool leansOver = (end < 0.0) != (middle - mean < 0.0);
  float amount = leansOver ? max(0.5 - nearer / (back + ahead), 0.0) : 0.0;
  // Single pixels and corners.
  float alone = smoothstep(0.0, 1.0, abs(0.25 * (n + s + e + w) - middle) /
                                            contrast(middle, n, s, e, w).x);
  amount = max(amount, kAlone * alone * alone);
  return textureLod(picture, texCoord + amount * across, 0.0).rgb;
}
#endif

#ifdef GRAIN
// Two uniform values from an integer hash, which is the same with every driver.
float grainAt(ivec2 at) {
  uint h = uint(at.x) * 0x8da6b343u + uint(at.y) * 0xd8163841u + uint(seed) * 0xcb1ab31fu;
  h = (h ^ (h >> 15)) * 0x2c1b3c6du;
  h = (h ^ (h >> 12)) * 0x297a2d39u;
  h ^= h >> 15;
  return (float(h & 0xffffu) + float(h >> 16)) / 65535.0 - 1.0;
}
#endif

void main() {
  vec3 drawn = colourAside(0, 0), colour = drawn;
  vec2 offCentre = texCoord - 0.5;
  float r2 = 4.0 * dot(offCentre, offCentre);
  float brightest = max(drawn.r, max(drawn.g, drawn.b));
#if defined(DETAIL) || defined(MARKS) || defined(EDGES)
  vec3 above = colourAside(0, 1), below = colourAside(0, -1), right = colourAside(1, 0),
       left = colourAside(-1, 0);
  float n = dot(above, kLuma), s = dot(below, kLuma), e = dot(right, kLuma), w = dot(left, kLuma),
        middle = dot(drawn, kLuma);
  float detail = middle - 0.25 * (n + s + e + w);
#endif
#ifdef MARKS
  vec2 range = contrast(middle, n, s, e, w);
  gl_FragDepth = range.x > range.y ? 1.0 : 0.0;
#endif
#ifdef EDGES
  colour = withoutStairs(middle, n, s, e, w);
  detail += dot(colour - drawn, kLuma);
#endif
#ifdef FRINGE
  vec2 away = fringe * r2 * offCentre;
#ifdef NEAR_FRINGE
  // Takes the plane through the pixel and its neighbours on that side, which are read already.
  vec2 share = abs(away) / pixel;
  bool isRight = away.x > 0.0, isAbove = away.y > 0.0;
  colour.r += share.x * ((isRight ? left : right).r - drawn.r) +
              share.y * ((isAbove ? below : above).r - drawn.r);
  colour.b += share.x * ((isRight ? right : left).b - drawn.b) +
              share.y * ((isAbove ? above : below).b - drawn.b);
#else
  colour.r += textureLod(picture, texCoord - away, 0.0).r - drawn.r;
  colour.b += textureLod(picture, texCoord + away, 0.0).b - drawn.b;
#endif
#endif
#ifdef DETAIL
  float fine = clamp(detail, -kCoring, kCoring);
  float most = min(kMostHalo + max(ridge(middle - n, middle - s), ridge(middle - e, middle - w)),
                   kMostDetail);
  float clear = clamp(detail - fine, -most, most);
  float centre = kDetailGain * sharpening * clear - min(sharpening, 1.0) * fine;
  colour += mix(centre, -rimBlur * detail, min(r2 * r2, 1.0));
#endif
#ifdef OCCLUDED
  float light = occlusionLight(texCoord);
  colour *= light;
  brightest *= light;
#endif
  float dark = min(brightest / kDarkEnd, 1.0);
  // The fade to the rim is no dark tissue: the response leaves it out.
  float edge = max(1.0 - smoothstep(kRimStart, 1.0, sqrt(r2)), kLeastEdge);
  vec3 level = gain / edge * colour + offset;
  float luma = dot(level, kLuma);
  level = mix(level, vec3(luma), mix(kLessColour, kBleached, smoothstep(kBleachStart, 1.0, luma)));
  vec3 inToe = clamp(kToe - level, 0.0, 2.0 * kToe),
       inShoulder = clamp(level - kShoulder, 0.0, 2.0 * (1.0 - kShoulder));
  level +=
      inToe * inToe / (4.0 * kToe) - inShoulder * inShoulder / (4.0 * (1.0 - kShoulder));
#ifdef GRAIN
  level += grain / 255.0 * grainAt(ivec2(gl_FragCoord.xy));
#endif
  gl_FragData[0] = vec4(clamp(level, 0.0, 1.0) * (edge * dark), 1.0);
}
