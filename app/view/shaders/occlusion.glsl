// Short-range ambient occlusion: how far the ground rises around a pixel over the plane through it,
// from pairs of stored depths on opposite sides [method.md, Camera]. Reads the stored depths of
// the finished picture, and draws a smaller picture.
#include "distance.glsl"
in vec2 texCoord;
uniform sampler2D depths;
steady float shadeReach;   // m
steady float unitsOfAngle; // texture units per radian
steady float texel;        // side of a pixel of the depths, texture units

const float kStrength = 0.55;  // loss of light where all pairs rise by their distance or more
const float kFlat = 0.10;      // rise as a share of the distance that is noise of a relief
const float kFull = 0.75;      // rise as a share of the distance that blocks all light of a pair
const float kNearStart = 1.6, kNearEnd = 3.2;  // reaches above a pixel: a part in front, no ground
const float kMostPlace = 0.08;                 // texture units
const float kRimFrom = 0.78, kRimTo = 0.94;    // window radii; beyond, places lie outside the window
const int kPairs = 4;
// Half of two rings of four places, one at half the reach.
const vec2 kPair[kPairs] =
    vec2[](vec2(1.0, 0.0), vec2(0.0, 1.0), vec2(0.354, 0.354), vec2(-0.354, 0.354));

// Each of 4 x 4 neighbouring pixels turns and shrinks the rings in its own way, so that a thing in
// front has no copies of its outline around it; the mean over 4 x 4 pixels (occlusion_mean.glsl)
// leaves none of the pattern.
const float kTurns[16] = float[](0.0, 8.0, 2.0, 10.0, 12.0, 4.0, 14.0, 6.0, 3.0, 11.0, 1.0, 9.0,
                                 15.0, 7.0, 13.0, 5.0);
const float kTurn = 1.570796 / 16.0;  // rad; the rings repeat after 90 degrees
const float kLeastRing = 0.6;         // share of the reach

// Returns the inverse distance, which is linear in the stored depth and over a plane.
float inverseOf(float stored) {
  return (1.0 - stored * (kFarthest - kNearest) / kFarthest) / kNearest;
}
float storedAt(vec2 at) {
  float stored = textureLod(depths, at, 0.0).r;
  return stored < 1.0 ? stored : 0.0;
}

void main() {
  vec2 place = (floor(texCoord / texel + 0.25) + 0.5) * texel;  // middle of a pixel
  float stored = storedAt(place);
  float inverse = inverseOf(stored), squared = 1.0 / (inverse * inverse);
  float aside = min(shadeReach * inverse * unitsOfAngle, kMostPlace);
  float inside = 1.0 - smoothstep(kRimFrom, kRimTo, length(2.0 * texCoord - 1.0));
  ivec2 cell = ivec2(gl_FragCoord.xy) & 3;
  float order = kTurns[4 * cell.y + cell.x];
  float angle = kTurn * (order + 0.5), ring = mix(kLeastRing, 1.0, fract(0.618034 * order + 0.5));
  mat2 turned = ring * mat2(cos(angle), sin(angle), -sin(angle), cos(angle));
  float blocked = 0.0;
  for (int i = 0; i < kPairs; ++i) {
    vec2 to = aside * (turned * kPair[i]);
    float before = storedAt(place - to), after = storedAt(place + to);
    float away = shadeReach * ring * length(kPair[i]);
    float riseBefore = (inverseOf(before) - inverse) * squared,
          riseAfter = (inverseOf(after) - inverse) * squared;
    float rise = 0.5 * (riseBefore + riseAfter) / away;
    float ground = 1.0 - smoothstep(kNearStart, kNearEnd, max(riseBefore, riseAfter) / shadeReach);
    float share = clamp((rise - kFlat) / (kFull - kFlat), 0.0, 1.0) * ground;
    blocked += before > 0.0 && after > 0.0 ? share : 0.0;
  }
  float light = stored > 0.0 ? 1.0 - kStrength * inside * blocked / float(kPairs) : 1.0;
  gl_FragData[0] = vec4(vec3(light), 1.0);
}
