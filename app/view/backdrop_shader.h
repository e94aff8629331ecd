// GLSL of the backdrop: a pixel's ray to the sphere about the portal, or before it to the relief,
// and from there into the panorama [design §4]. Put together in backdrop_prop.cpp, with
// EQUIRECTANGULAR and RELIEF defined or not: a processor goes both ways of every if.
#pragma once

namespace arthro::app {

inline constexpr const char* kBackdropHead = R"(//VTK::System::Dec
//VTK::Output::Dec
in vec2 texCoord;
uniform sampler2D panorama;
uniform sampler2D relief;       // m
uniform sampler2D reliefCeiling;  // m, of blocks of blockTexels
uniform sampler2D imagedShare;  // 1 well inside what was imaged
uniform vec3 tip;               // in radii of the sphere
uniform float clearance;        // 1 - |tip|^2, worked out in double
uniform vec3 viewAxis, upAxis, rightAxis;
uniform float lensScale;        // sin(fov/4)
uniform float windowRadius;     // px
uniform int wraps, plain;
uniform vec2 centre, scale;     // of the projection, in texture units
uniform vec2 texels;
const float kSharpness = 0.7;
uniform float samples;           // at most, a pixel
uniform float radius;           // m
uniform float nearest, farthest, lightReach;
uniform float highest;          // of the relief, in radii
uniform float blockTexels;
uniform float reliefSteps;      // at most, along a ray
uniform vec3 endColour;
uniform vec2 notch;             // unit, image right and up
)";

// A pixel's footprint in the panorama is an ellipse (texels a pixel: dx, dy), long and thin near
// the edge of a gnomonic picture and the poles of an equirectangular one. Samples are strung along
// its longer axis, each averaged over the shorter one; a single round average would blur fine lines
// together there (grid lines up to 1.8 px off instead of 0.3).
inline constexpr const char* kPanoramaFilter = R"(
vec3 panoramaColour(vec2 uv, vec2 dx, vec2 dy) {
  float a = dx.x * dx.x + dy.x * dy.x, b = dx.x * dx.y + dy.x * dy.y, c = dx.y * dx.y + dy.y * dy.y;
  float mean = 0.5 * (a + c), spread = sqrt(max(0.25 * (a - c) * (a - c) + b * b, 0.0));
  float longer = sqrt(mean + spread);
  float shorter = abs(dx.x * dy.y - dx.y * dy.x) / max(longer, 1e-6);
  vec2 axis = abs(b) > 1e-6 * mean ? normalize(vec2(mean + spread - c, b))
                                   : (a >= c ? vec2(1.0, 0.0) : vec2(0.0, 1.0));
  float count = clamp(ceil(longer / max(shorter, 1.0) - 0.4), 1.0, samples);
  float lod = log2(max(max(longer / count, shorter) * kSharpness, 1.0));
  vec2 step = axis * longer / count / texels;
  vec2 start = uv - 0.5 * (count - 1.0) * step;
  vec3 sum = vec3(0.0);
  for (float i = 0.0; i < count; i += 1.0) sum += textureLod(panorama, start + i * step, lod).rgb;
  return sum / count;
}
)";

// Where a ray first meets the relief, in radii along it. Nothing lies nearer to the portal than the
// relief's highest place; from that sphere out to the bare one a ray passes a block of texels at
// once where the relief around does not reach it, and an eighth of one where it may. Where it has
// gone behind the relief the place is closed in on.
inline constexpr const char* kReliefSearch = R"(
#ifdef EQUIRECTANGULAR
vec2 panoramaPlace(vec3 d) {
  return centre + scale * vec2(atan(d.x, d.z), atan(d.y, length(d.xz)));
}
// How much finer the panorama is there than at its centre, at most.
float fineness(vec3 x, float far) { return inversesqrt(max(1.0 - x.y * x.y / far, 1e-4)); }
bool isBefore(vec3 d) { return true; }
#else
vec2 panoramaPlace(vec3 d) { return centre + scale * d.xy / max(d.z, 1e-4); }
float fineness(vec3 x, float far) { return far / max(x.z * x.z, 1e-4 * far); }
bool isBefore(vec3 d) { return d.z > 0.0; }
#endif
bool isImaged(vec3 d, vec2 uv) {
  return isBefore(d) && (wraps != 0 || abs(uv.x - 0.5) <= 0.5) && abs(uv.y - 0.5) <= 0.5;
}
// How far x is behind the relief, in radii.
float behind(vec3 x) {
  vec2 uv = panoramaPlace(x);
  return (isImaged(x, uv) ? textureLod(relief, uv, 0.0).r / radius : 0.0) - 1.0 + length(x);
}
// In radii; nothing within a block is higher.
float ceilingAt(vec2 uv) {
  ivec2 block = ivec2(uv * texels / blockTexels);
  return texelFetch(reliefCeiling, clamp(block, ivec2(0), textureSize(reliefCeiling, 0) - 1), 0).r / radius;
}
// Texels that x passes a radius on its way, at most.
float texelsARadius(vec3 x, vec3 ray) {
  float far = dot(x, x);
  float turn = length(cross(x, ray)) / far;
  return max(turn * fineness(x, far) * max(abs(scale.x) * texels.x, abs(scale.y) * texels.y), 1.0);
}
// The first crossing from `near` to `far`; beyond `far` where there is none. What stands under an if
// is done for every pixel on a processor, so there is little.
float firstBehind(vec3 ray, float b, float near, float far) {
  float least = (far - near) / reliefSteps;
  float low = near, high = near, gapLow = behind(tip + near * ray), gapHigh = gapLow;
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
  return min(firstBehind(ray, b, inside >= 0.0 ? begins : 0.0, sphere), sphere);
}
)";

inline constexpr const char* kBackdropMain = R"(
void main() {
  // Pixel -> equisolid ray: |offset| lensScale = sin(theta/2).
  vec2 offset = 2.0 * texCoord - 1.0;
  float r = length(offset);
  float s2 = min(r * r * lensScale * lensScale, 1.0);
  vec2 across = 2.0 * lensScale * sqrt(1.0 - s2) * offset;
  vec3 ray = (1.0 - 2.0 * s2) * viewAxis + across.x * rightAxis + across.y * upAxis;

  // Ray -> sphere -> direction from the portal -> panorama.
  float b = dot(tip, ray);
  float sphere = sqrt(max(b * b + clearance, 0.0)) - b;
  vec3 d = normalize(tip + sphere * ray);
  vec2 uv = panoramaPlace(d);
  // Of the smooth sphere: at the relief's outlines a pixel's neighbours are elsewhere.
  vec2 dx = dFdx(uv), dy = dFdy(uv);
  float coverage = rimCoverage(r, windowRadius);
  if (wraps != 0) {
    dx.x -= round(dx.x);
    dy.x -= round(dy.x);
  }
#ifdef RELIEF
  float reach = meetRelief(ray, b, sphere);
  d = normalize(tip + reach * ray);
  uv = panoramaPlace(d);
  dx *= reach / sphere;
  dy *= reach / sphere;
#endif
  bool imaged = isImaged(d, uv);
  vec3 colour = imaged && coverage > 0.0 ? panoramaColour(uv, dx * texels, dy * texels) : vec3(0.0);
  float h = imaged ? texture(relief, uv).r / radius : 0.0;

  // Depth of the relief's point in the direction that the colour comes from.
  float distance = clamp(radius * dot((1.0 - h) * d - tip, ray), 1.001 * nearest, farthest);
  float stored = storedDepth(distance);

  vec3 shown;
  if (plain != 0) {
    shown = imaged ? colour : vec3(0.0);
  } else {
    // The panorama was lit when it was taken: what lies far fades, but nothing is lit a second time.
    vec3 lit = shoulder(colour * pow(min(lightAt(distance), 1.0), 1.0 / 2.2));
    shown = mix(endColour, lit, imaged ? smoothstep(0.0, 1.0, texture(imagedShare, uv).r) : 0.0) * softRim(r);
    float along = dot(offset, notch) - 0.925;
    float beside = abs(offset.x * notch.y - offset.y * notch.x);
    float mark = clamp((0.5 * along - beside) * 0.9 * windowRadius + 0.5, 0.0, 1.0);
    shown *= 1.0 - mark;
    if (mark > 0.5) stored = 0.0;
  }
  if (coverage <= 0.0) stored = 0.0;
  gl_FragDepth = stored;
  gl_FragData[0] = vec4(shown * coverage, 1.0);
}
)";

}  // namespace arthro::app
