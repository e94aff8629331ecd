// GLSL of the pass over the finished picture that disturbs it (lens_pass.cpp), after kDepthShader's
// distances and kLightShader's rim. Put together with BLUR, NEAR_BLUR, HAZE, FOG and OVEREXPOSED
// defined or not. Distances in m, places in the window in its radii.
#pragma once

namespace arthro::app {

inline constexpr const char* kLensPassHead = R"(
uniform sampler2D depths;
steady float windowRadius;  // px
steady float lightReach;
// Stored depth; 0 outside the window and under its mark, where nothing was drawn.
float storedAt(vec2 at) {
  float stored = textureLod(depths, at, 0.0).r;
  return stored < 1.0 ? stored : 0.0;
}
float distanceOf(float stored) {
  return nearest / (1.0 - min(stored, 1.0) * (farthest - nearest) / farthest);
}
)";

// The picture with its small copies (mipmaps), weighted by alpha, so that a blurred place takes
// nothing of what is sharp beside it, and nothing of the dark outside the window.
inline constexpr const char* kGatherMain = R"(
in vec2 texCoord;
uniform sampler2D picture;
#ifdef FAR_ONLY
steady float pixelsOfAngle;  // aperture, m, by px a radian
steady float farFocus;
#endif
void main() {
  float stored = storedAt(texCoord);
  float weight = stored > 0.0 ? 1.0 : 0.0;
#ifdef FAR_ONLY
  float blur = pixelsOfAngle * (1.0 / farFocus - 1.0 / distanceOf(stored));
  weight *= clamp(0.5 * blur, 0.04, 1.0);
#endif
  // The rim's shade is the lens', and comes back when the picture is put together.
  vec3 colour = textureLod(picture, texCoord, 0.0).rgb / max(softRim(length(2.0 * texCoord - 1.0)), 0.02);
  gl_FragData[0] = vec4(min(colour, vec3(1.0)) * weight, weight);
}
)";

// The near blur, at a quarter of the size: what is near spreads over what is behind it.
inline constexpr const char* kSpreadMain = R"(
in vec2 texCoord;
steady float pixelsOfAngle, nearFocus, mostBlur;  // mostBlur: px
float blurOf(vec2 at) {
  float stored = storedAt(at);
  float distance = distanceOf(max(stored, 1e-6));
  return stored > 0.0 ? pixelsOfAngle * max(1.0 / distance - 1.0 / nearFocus, 0.0) : 0.0;
}
void main() {
  vec2 texel = 0.5 / windowRadius * vec2(1.0, -1.0);
  float blur = max(max(blurOf(texCoord + texel.xx), blurOf(texCoord + texel.xy)),
                   max(blurOf(texCoord + texel.yx), blurOf(texCoord + texel.yy)));
  gl_FragData[0] = vec4(min(blur / mostBlur, 1.0));
}
)";

// Shared by the whole picture and the bits in it.
inline constexpr const char* kDisturbShader = R"(
uniform sampler2D murk;
steady float hazeStrength, fogStrength, exposureGain;
steady vec3 hazeExtinction;  // 1/m
// Linear light is near enough to the square of a stored colour here.
vec3 hazed(vec3 colour, float distance, vec2 at, float rim) {
  vec2 density = 2.0 * textureLod(murk, at, 0.0).rg;
  // Most of it is seen before the first centimetre ends; behind, finer clouds.
  float thickness = density.r * min(distance, 0.010) + density.g * max(distance - 0.010, 0.0);
  vec3 through = exp(-hazeStrength * thickness * hazeExtinction);
  // What the lamp lights of the blood itself: red comes back, the rest hardly.
  vec3 veil = vec3(0.33, 0.026, 0.018) * (1.0 - through) * rim * rim;
  return sqrt(colour * colour * through + veil);
}
// How much of the light the dew scatters.
float fogAt(vec2 at, float r) {
  float uneven = textureLod(murk, at, 0.0).b - 0.5;
  float edge = mix(0.95, -0.45, fogStrength);
  return 0.9 * smoothstep(edge, edge + 0.75, r + 0.10 * uneven) * min(6.0 * fogStrength, 1.0);
}
vec3 fogged(vec3 colour, float fog, float rim) {
  return mix(colour, vec3(0.70, 0.67, 0.645) * rim, fog);
}
// The camera's own curve is undone, so that the gain is one of light.
vec3 exposed(vec3 colour, float rim) {
  vec3 c = unshoulder(colour / max(rim, 0.05));
  return shoulder(c * pow(exposureGain, 1.0 / 2.2)) * rim;
}
vec3 disturbed(vec3 colour, float distance, vec2 at, float rim, float fog) {
#ifdef HAZE
  colour = hazed(colour, distance, at, rim);
#endif
#ifdef FOG
  colour = fogged(colour, fog, rim);
#endif
#ifdef OVEREXPOSED
  colour = exposed(colour, rim);
#endif
  return colour;
}
)";

inline constexpr const char* kDisturbMain = R"(
in vec2 texCoord;
uniform sampler2D picture;
#ifdef BLUR
uniform sampler2D gathered;
steady float pixelsOfAngle, farPixelsOfAngle, nearFocus, farFocus;  // see kGatherMain
steady float fogBlur;                         // px
// A disc's spread (its variance a sixteenth of the square of its diameter) from the middle and four
// places of a ring about it, in the copy whose own spread is the rest: a quarter of its texel's
// square.
vec3 blurred(vec3 sharp, float diameter) {
  float lod = floor(log2(max(0.33 * diameter, 1.0)) + 0.5), texel = exp2(lod);
  float rest = diameter * diameter / 16.0 - (lod > 0.0 ? 0.25 : 0.17) * texel * texel;
  vec2 ring = sqrt(max(rest, 0.0) * 2.5) / (2.0 * windowRadius) * vec2(0.9239, 0.3827);
  vec2 turned = vec2(-ring.y, ring.x);
  vec4 sum = textureLod(gathered, texCoord, lod);
  sum += textureLod(gathered, texCoord + ring, lod) + textureLod(gathered, texCoord - ring, lod);
  sum += textureLod(gathered, texCoord + turned, lod) + textureLod(gathered, texCoord - turned, lod);
  return sum.a > 0.05 ? sum.rgb / sum.a : sharp;
}
#endif
#ifdef NEAR_BLUR
uniform sampler2D spread;
steady float spreadLod, mostBlur;
#endif
void main() {
  float stored = storedAt(texCoord);
  float distance = distanceOf(stored);
  vec3 colour = textureLod(picture, texCoord, 0.0).rgb;
  vec3 before = colour;
  float r = length(2.0 * texCoord - 1.0);
  float rim = softRim(r), fog = 0.0;
#ifdef FOG
  fog = fogAt(texCoord, r);
#endif
#ifdef BLUR
  float inverse = 1.0 / distance;
  float diameter = farPixelsOfAngle * max(1.0 / farFocus - inverse, 0.0);
#ifdef NEAR_BLUR
  float own = pixelsOfAngle * max(inverse - 1.0 / nearFocus, 0.0);
  // Beside what is blurred the mean is of half of it.
  float mean = mostBlur * textureLod(spread, texCoord, spreadLod).r;
  mean *= 1.0 + 0.6 * clamp(1.0 - 2.0 * own / max(mean, 1e-3), 0.0, 1.0);
  diameter = max(diameter, max(own, mean));
#endif
  diameter = max(diameter, fogBlur * fog);
  colour = mix(colour, blurred(colour / max(rim, 0.02), diameter) * rim, smoothstep(0.3, 1.3, diameter));
#endif
  colour = disturbed(colour, distance, texCoord, rim, fog);
  // Nothing happens outside the window and on its mark.
  gl_FragData[0] = vec4(stored > 0.0 ? colour : before, 1.0);
}
)";

// One disc a bit, two triangles each: place (centre, radius, distance), look (angle, shape,
// opacity, softness).
inline constexpr const char* kBitVertex = R"(
uniform vec4 place[48];
uniform vec4 look[48];
out vec2 within;
flat out vec4 bitPlace, bitLook;
void main() {
  handOn();
  int bit = gl_VertexID / 6, corner = gl_VertexID % 6;
  vec2 at = vec2(corner == 1 || corner == 2 || corner == 4 ? 1.0 : -1.0,
                 corner == 2 || corner == 4 || corner == 5 ? 1.0 : -1.0);
  bitPlace = place[bit];
  bitLook = look[bit];
  within = at * (1.0 + bitLook.w);
  gl_Position = vec4(bitPlace.xy + bitPlace.z * within, 0.0, 1.0);
}
)";

inline constexpr const char* kBitHead = R"(
in vec2 within;
flat in vec4 bitPlace, bitLook;
// `through`: the scene is seen through the bit, not the bit itself.
void show(vec3 colour, float alpha, bool through) {
  vec2 at = gl_FragCoord.xy / (2.0 * windowRadius);
  float r = length(2.0 * at - 1.0);
  float rim = softRim(r), fog = 0.0;
#ifdef FOG
  fog = fogAt(at, r);
#endif
  // Nothing of it is seen behind what stands in the scene.
  float stored = storedAt(at);
  float scene = distanceOf(stored);
  float seen = stored > 0.0 ? alpha * clamp((scene - bitPlace.w) / 0.3e-3, 0.0, 1.0) : 0.0;
  float murky = through ? scene : bitPlace.w;
  gl_FragData[0] = vec4(disturbed(colour * rim, murky, at, rim, fog) * seen, seen);
}
)";

// Loose tissue: a flake with a ragged edge, or a bent fibre; whitish, lit by the lamp.
inline constexpr const char* kFlakeMain = R"(
void main() {
  float c = cos(bitLook.x), s = sin(bitLook.x), seed = 40.0 * bitLook.y, soft = bitLook.w;
  vec2 q = vec2(c * within.x + s * within.y, c * within.y - s * within.x);
  float cover;
  if (bitLook.y < fibreShare) {
    // Two strands of one shred, which thin to their ends and let light through.
    float bend = 0.35 * sin(1.7 * q.x + seed) + 0.10 * sin(4.1 * q.x + 3.0 * seed) - 0.35 * sin(seed);
    float split = 0.16 * sin(2.9 * q.x + 2.3 * seed);
    float thin = sqrt(max(1.0 - q.x * q.x, 0.0));
    float width = (0.05 + 0.06 * fract(3.7 * seed)) * thin * (0.8 + 0.3 * sin(9.0 * q.x + seed));
    float blur = 0.05 + 0.45 * soft;
    float first = 1.0 - smoothstep(0.2 * width, width + blur, abs(q.y - bend));
    float second = 1.0 - smoothstep(0.1 * width, 0.6 * width + blur, abs(q.y - bend - split));
    cover = max(0.62 * first, 0.42 * second) * smoothstep(0.0, 0.35, thin) *
            (0.75 + 0.25 * sin(13.0 * q.x + 5.0 * seed)) * width / (width + 0.3 * soft + 0.02);
  } else {
    float ragged = 0.17 * sin(3.1 * q.x + seed) * sin(2.7 * q.y + 1.9 * seed) +
                   0.12 * sin(7.0 * q.x + 2.1 * seed) * sin(6.1 * q.y + 3.7 * seed) +
                   0.06 * sin(15.0 * q.x + seed) * sin(17.0 * q.y + 2.9 * seed);
    float way = length(vec2(q.x, q.y * (1.0 + fract(5.1 * seed)))) + ragged;
    cover = 0.72 * (1.0 - smoothstep(0.22 - 0.2 * soft, 0.78 + 0.8 * soft, way));
  }
  vec3 own = mix(vec3(0.90, 0.84, 0.76), vec3(0.97, 0.95, 0.92), fract(7.3 * seed));
  show(own * pow(lightAt(bitPlace.w), 1.0 / 2.2) * 0.92, cover * bitLook.z, false);
}
)";

// Air in water: seen through its middle the scene is small and whole; beyond three quarters of its
// radius (sin of the critical angle, 1/1.33) all light is thrown back, and the rim is a bright ring
// with a dark line on either side. The lamp is beside the lens: it shines back from the middle of
// the front, and dimly, upside down, from the back.
inline constexpr const char* kBubbleMain = R"(
uniform sampler2D gathered;
vec3 sceneAt(vec2 offset, float lod) {
  vec2 at = 0.5 + 0.5 * (bitPlace.xy + bitPlace.z * offset);
  vec2 fromMiddle = 2.0 * at - 1.0;
  at = 0.5 + 0.5 * fromMiddle * min(1.0, 0.93 / max(length(fromMiddle), 1e-3));
  vec4 sum = textureLod(gathered, at, lod);
  return sum.rgb / max(sum.a, 0.05);
}
void main() {
  float rho = length(within), soft = bitLook.w;
  float px = bitPlace.z * windowRadius;
  float edge = max(1.2 / px, 0.9 * soft);
  float cover = 1.0 - smoothstep(1.0 - 0.6 * edge, 1.0 + 0.6 * edge, rho);
  float q = min(rho, 0.999);
  vec2 outward = within / max(rho, 1e-3);
  // Through it: the deflection grows without bound towards the critical angle.
  float passing = min(q, 0.72);
  float minified = 1.5 + 3.2 * passing * passing * passing * passing / max(1.0 - 1.7 * passing * passing, 0.12);
  float lod = log2(max(minified * (1.0 + 0.12 * px * soft), 1.0));
  vec3 through = sceneAt(outward * q * minified, lod);
  // Thrown back: what lies beside the bubble, then what lies behind the lens, dark.
  float grazing = clamp((q - 0.75) / 0.25, 0.0, 1.0);
  vec3 thrown = sceneAt(outward * (5.0 - 3.6 * grazing), log2(max(0.6 * px, 2.0)));
  float above = 0.5 + 0.5 * outward.y;
  thrown = thrown * (0.45 + 0.75 * above) + vec3(0.55, 0.55, 0.54) * above * above *
           exp(-24.0 * (grazing - 0.42) * (grazing - 0.42));
  float inner = smoothstep(0.66, 0.80, q);
  vec3 colour = mix(through * 0.96, thrown, inner);
  // Dark where neither passes nor returns much.
  float dark = exp(-pow((q - 0.735) / (0.035 + 0.2 * soft), 2.0));
  float last = smoothstep(0.90 - 0.25 * soft, 1.0, q);
  colour *= (1.0 - 0.55 * dark) * (1.0 - 0.72 * last);
  // The lamp.
  vec2 glint = within - vec2(0.10 * sin(9.0 * bitLook.y), 0.17);
  float spot = 0.055 + 0.35 * soft * 0.25 + 0.6 / px;
  colour += vec3(1.0, 0.99, 0.96) * exp(-dot(glint, glint) / (spot * spot));
  vec2 back = within + vec2(0.10 * sin(9.0 * bitLook.y), 0.46);
  colour += 0.35 * vec3(1.0, 0.97, 0.93) * exp(-dot(back, back) / (4.0 * spot * spot));
  show(shoulder(colour), cover * bitLook.z, true);
}
)";

}  // namespace arthro::app
