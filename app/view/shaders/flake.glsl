// Loose tissue: a flake with a ragged edge, or a bent fibre; whitish, lit by the lamp. The shapes
// are sums of sines (frequencies in rad per radius), with phases from the shape number. Lengths are
// in radii of the bit.
#include "bit.glsl"

const float kSeedRange = 40.0;  // rad, spreads the shape number over the phases
// Fibre: two strands of one shred, thinner towards their ends and translucent.
const vec2 kBendSize = vec2(0.35, 0.10), kBendRate = vec2(1.7, 4.1);
const float kSplitSize = 0.16, kSplitRate = 2.9, kSplitPhase = 2.3;
const float kStrandWidth = 0.05, kWidthRange = 0.06;
const float kSharpEdge = 0.05, kSoftEdge = 0.45;      // blur of an edge, and more when out of focus
const float kFirstCover = 0.62, kSecondCover = 0.42;  // opacity of the strands
// Flake: a disc with a ragged edge in three octaves.
const vec3 kRagSize = vec3(0.17, 0.12, 0.06);
const float kSmoothed = 3.0;  // loss of the ragged edge out of focus
const float kFlakeCover = 0.72;
const float kFlakeInner = 0.22, kFlakeOuter = 0.78;  // radii between which it fades
const vec3 kYellowish = vec3(0.90, 0.84, 0.76), kWhitish = vec3(0.97, 0.95, 0.92);
const float kFlakeLight = 0.92;

void main() {
  float c = cos(bitLook.x), s = sin(bitLook.x), seed = kSeedRange * bitLook.y, soft = bitLook.w;
  vec2 q = vec2(c * within.x + s * within.y, c * within.y - s * within.x);
  float cover;
  if (bitLook.y < kFibreShare) {
    float bend = kBendSize.x * sin(kBendRate.x * q.x + seed) +
                 kBendSize.y * sin(kBendRate.y * q.x + 3.0 * seed) - kBendSize.x * sin(seed);
    float split = kSplitSize * sin(kSplitRate * q.x + kSplitPhase * seed);
    float thin = sqrt(max(1.0 - q.x * q.x, 0.0));
    float width = (kStrandWidth + kWidthRange * fract(3.7 * seed)) * thin *
                  (0.8 + 0.3 * sin(9.0 * q.x + seed));
    float blur = kSharpEdge + kSoftEdge * soft;
    float first = 1.0 - smoothstep(0.2 * width, width + blur, abs(q.y - bend));
    float second = 1.0 - smoothstep(0.1 * width, 0.6 * width + blur, abs(q.y - bend - split));
    cover = max(kFirstCover * first, kSecondCover * second) * smoothstep(0.0, 0.35, thin) *
            (0.75 + 0.25 * sin(13.0 * q.x + 5.0 * seed)) * width / (width + 0.3 * soft + 0.02);
  } else {
    float ragged = kRagSize.x * sin(3.1 * q.x + seed) * sin(2.7 * q.y + 1.9 * seed) +
                   kRagSize.y * sin(7.0 * q.x + 2.1 * seed) * sin(6.1 * q.y + 3.7 * seed) +
                   kRagSize.z * sin(15.0 * q.x + seed) * sin(17.0 * q.y + 2.9 * seed);
    float way = length(vec2(q.x, q.y * (1.0 + fract(5.1 * seed)))) + ragged / (1.0 + kSmoothed * soft);
    cover =
        kFlakeCover * (1.0 - smoothstep(kFlakeInner - 0.2 * soft, kFlakeOuter + 0.8 * soft, way));
  }
  vec3 own = mix(kYellowish, kWhitish, fract(7.3 * seed));
  show(own * pow(lightAt(bitPlace.w), 1.0 / kGamma) * kFlakeLight, cover * bitLook.z, false);
}
