// Filtered colour of the panorama.
#include "place.glsl"

// Returns the mean colour over a pixel's footprint, an ellipse (dx, dy in texels per pixel) that is
// long and thin near the edge of a gnomonic panorama and near the poles of an equirectangular one.
// Samples lie along the longer axis, each averaged over the shorter one: a single round average
// would blur fine lines together (grid lines up to 1.8 px off instead of 0.3 px).
const float kSharpness = 0.7;       // size of a sample over its distance from the next
const float kSampleRounding = 0.4;  // a further sample is taken above this fraction
const float kFewSamples = 2.0;      // up to here one mipmap level is read, half the work of two
const float kRound = 1e-6;          // below this share of the mean the ellipse counts as a circle
// `blur`, along u and v in texels, widens the ellipse in every direction of the picture alike.
// A place of more than 0 `asks` also gives `other`, the colour at another place and level: in the
// loop, so that blocks without such a place read one texel less.
vec3 panoramaColour(vec2 uv, vec2 dx, vec2 dy, vec2 blur, float asks, vec2 otherPlace,
                    float otherLevel, out vec3 other) {
  float a = dx.x * dx.x + dy.x * dy.x, b = dx.x * dx.y + dy.x * dy.y, c = dx.y * dx.y + dy.y * dy.y;
  float area = dx.x * dy.y - dx.y * dy.x;
  vec2 wider = blur * blur;
  float area2 = area * area + a * wider.y + c * wider.x + wider.x * wider.y;
  a += wider.x;
  c += wider.y;
  float mean = 0.5 * (a + c), spread = sqrt(max(0.25 * (a - c) * (a - c) + b * b, 0.0));
  float longer = sqrt(mean + spread);
  float shorter = sqrt(area2) / max(longer, 1e-6);
  vec2 axis = abs(b) > kRound * mean ? normalize(vec2(mean + spread - c, b))
                                     : (a >= c ? vec2(1.0, 0.0) : vec2(0.0, 1.0));
  float count = clamp(ceil(longer / max(shorter, 1.0) - kSampleRounding), 1.0, samples);
  float lod = log2(max(max(longer / count, shorter) * kSharpness, 1.0));
  if (samples <= kFewSamples) lod = floor(lod + 0.5);

  vec2 step = axis * longer / count / texels;
  vec2 start = uv - 0.5 * (count - 1.0) * step;
  vec3 sum = vec3(0.0);
  other = vec3(0.0);
  float i = 0.0, end = asks > 0.0 ? count + 1.0 : count;
  while (true) {
    bool isOther = i >= count;
    vec3 found = textureLod(panorama, isOther ? otherPlace : start + i * step,
                            isOther ? otherLevel : lod).rgb;
    sum += isOther ? vec3(0.0) : found;
    other = found;
    i += 1.0;
    if (i >= end) break;
  }
  return sum / count;
}
