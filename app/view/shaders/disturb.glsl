// Second pass over the finished picture: blur, haze, dew and overexposure.
#include "picture_inputs.glsl"
#include "disturbed_light.glsl"
in vec2 texCoord;
uniform sampler2D picture;
#ifdef BLUR
uniform sampler2D gathered;  // gather.glsl
steady float pixelsOfAngle, farPixelsOfAngle, nearFocus, farFocus;
steady float fogBlur;  // px

const float kLodShare = 0.33;       // texel of the mipmap level over the diameter
const float kDiscVariance = 16.0;   // diameter^2 over the variance of a disc
const float kTexelVariance = 0.25;  // variance of a mipmap's texel, over the square of its side
const float kFirstVariance = 0.17;  // the same for the picture itself
const float kRingGain = 2.5;        // squared radius of the four samples over the variance
const vec2 kRingTurn = vec2(0.9239, 0.3827);  // 22.5 deg, so that no axis is preferred
const float kLeastAlpha = 0.05;
const float kBlurStart = 0.3, kBlurFull = 1.3;  // px of diameter, from sharp to blurred
const float kEdgeSpread = 0.6;                  // gain of the mean beside a blurred part

// Approximates a disc's average by five samples, its centre and four on a ring, of the mipmap level
// with the remaining variance.
vec3 blurred(vec3 sharp, float diameter) {
  float lod = floor(log2(max(kLodShare * diameter, 1.0)) + 0.5), texel = exp2(lod);
  float rest = diameter * diameter / kDiscVariance -
               (lod > 0.0 ? kTexelVariance : kFirstVariance) * texel * texel;
  vec2 ring = sqrt(max(rest, 0.0) * kRingGain) / (2.0 * windowRadius) * kRingTurn;
  vec2 turned = vec2(-ring.y, ring.x);
  vec4 sum = textureLod(gathered, texCoord, lod);
  sum += textureLod(gathered, texCoord + ring, lod) + textureLod(gathered, texCoord - ring, lod);
  sum +=
      textureLod(gathered, texCoord + turned, lod) + textureLod(gathered, texCoord - turned, lod);
  return sum.a > kLeastAlpha ? sum.rgb / sum.a : sharp;
}
#endif
#ifdef NEAR_BLUR
uniform sampler2D spread;  // spread.glsl
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
  // Beside a blurred part only half of the averaged area is blurred, so the mean is raised.
  float mean = mostBlur * textureLod(spread, texCoord, spreadLod).r;
  mean *= 1.0 + kEdgeSpread * clamp(1.0 - 2.0 * own / max(mean, 1e-3), 0.0, 1.0);
  diameter = max(diameter, max(own, mean));
#endif
  diameter = max(diameter, fogBlur * fog);
  colour = mix(colour, blurred(colour / max(rim, kLeastRim), diameter) * rim,
               smoothstep(kBlurStart, kBlurFull, diameter));
#endif
  colour = disturbed(colour, distance, texCoord, rim, fog);
  // The surround of the window and its mark stay unchanged.
  gl_FragData[0] = vec4(stored > 0.0 ? colour : before, 1.0);
}
