// Air bubble in water. Through its middle the scene appears minified. Beyond kCritical of its
// radius (sine of the critical angle, 1/1.33) light is totally reflected: a bright ring with a dark
// line on either side. The lamp stands beside the lens: the front reflects it near the middle, the
// back reflects it dimly and upside down. Lengths are in radii of the bubble.
#include "bit.glsl"
uniform sampler2D gathered;

const float kMostPlace = 0.93;    // window radii, where the scene is still sampled
const float kCritical = 0.75;     // 1/1.33
const float kLastPassing = 0.72;  // radius up to which refraction is computed
// Minification: 1.5 in the middle, without bound towards the critical angle.
const float kMinified = 1.5, kMinifiedGain = 3.2, kMinifiedBend = 1.7, kMinifiedLeast = 0.12;
// Reflected scene: from far beside the bubble at the ring's inner edge to near it at the rim.
const float kReflectFar = 5.0, kReflectRange = 3.6, kReflectBlur = 0.6;
const float kReflectDim = 0.45, kReflectTop = 0.75;  // brightness below, and the gain above
const vec3 kRingLight = vec3(0.55, 0.55, 0.54);
const float kRingSharpness = 24.0, kRingPlace = 0.42;  // share of the way from ring to rim
const float kRingInner = 0.66, kRingOuter = 0.80;      // radii between which refraction ends
const float kTransmitted = 0.96;
const float kDarkLine = 0.735, kDarkWidth = 0.035, kDarkDepth = 0.55;
const float kRimDark = 0.72, kRimDarkStart = 0.90;
const float kGlintSide = 0.10, kGlintTurn = 9.0;     // sideways place, by the shape number
const float kFrontGlint = 0.17, kBackGlint = 0.46;   // height of either glint
const float kGlintSize = 0.055, kGlintPixels = 0.6;  // radius, and px at least
const vec3 kFrontColour = vec3(1.0, 0.99, 0.96), kBackColour = vec3(1.0, 0.97, 0.93);
const float kBackLight = 0.35;
const float kEdgePixels = 1.2, kEdgeSoft = 0.9;  // width of the edge: px, or by its softness

vec3 sceneAt(vec2 offset, float lod) {
  vec2 at = 0.5 + 0.5 * (bitPlace.xy + bitPlace.z * offset);
  vec2 fromMiddle = 2.0 * at - 1.0;
  at = 0.5 + 0.5 * fromMiddle * min(1.0, kMostPlace / max(length(fromMiddle), 1e-3));
  vec4 sum = textureLod(gathered, at, lod);
  return sum.rgb / max(sum.a, 0.05);
}
void main() {
  float rho = length(within), soft = bitLook.w;
  float px = bitPlace.z * windowRadius;
  float edge = max(kEdgePixels / px, kEdgeSoft * soft);
  float cover = 1.0 - smoothstep(1.0 - 0.6 * edge, 1.0 + 0.6 * edge, rho);
  float q = min(rho, 0.999);
  vec2 outward = within / max(rho, 1e-3);
  // Refracted light.
  float passing = min(q, kLastPassing);
  float minified = kMinified + kMinifiedGain * passing * passing * passing * passing /
                                   max(1.0 - kMinifiedBend * passing * passing, kMinifiedLeast);
  float lod = log2(max(minified * (1.0 + 0.12 * px * soft), 1.0));
  vec3 through = sceneAt(outward * q * minified, lod);
  // Reflected light: the scene beside the bubble, then the dark behind the lens.
  float grazing = clamp((q - kCritical) / (1.0 - kCritical), 0.0, 1.0);
  vec3 thrown =
      sceneAt(outward * (kReflectFar - kReflectRange * grazing), log2(max(kReflectBlur * px, 2.0)));
  float above = 0.5 + 0.5 * outward.y;
  thrown = thrown * (kReflectDim + kReflectTop * above) +
           kRingLight * above * above *
               exp(-kRingSharpness * (grazing - kRingPlace) * (grazing - kRingPlace));
  float inner = smoothstep(kRingInner, kRingOuter, q);
  vec3 colour = mix(through * kTransmitted, thrown, inner);
  // Dark where little light is either transmitted or reflected.
  float dark = exp(-pow((q - kDarkLine) / (kDarkWidth + 0.2 * soft), 2.0));
  float last = smoothstep(kRimDarkStart - 0.25 * soft, 1.0, q);
  colour *= (1.0 - kDarkDepth * dark) * (1.0 - kRimDark * last);
  // Images of the lamp.
  vec2 glint = within - vec2(kGlintSide * sin(kGlintTurn * bitLook.y), kFrontGlint);
  float spot = kGlintSize + 0.35 * soft * 0.25 + kGlintPixels / px;
  colour += kFrontColour * exp(-dot(glint, glint) / (spot * spot));
  vec2 back = within + vec2(kGlintSide * sin(kGlintTurn * bitLook.y), kBackGlint);
  colour += kBackLight * kBackColour * exp(-dot(back, back) / (4.0 * spot * spot));
  show(shoulder(colour), cover * bitLook.z, true);
}
