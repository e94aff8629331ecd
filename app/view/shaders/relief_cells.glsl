// Second pass: writes the four corner distances of a cell where the relief is smooth through the
// cell and on at least one side of it, and where it is no side of a step. Elsewhere writes -1 and
// the range of distances that each of its pixels has to search.
#include "backdrop_inputs.glsl"
#include "relief.glsl"
const float kSearchMargin = 0.15;  // share of the corners' range, on either side
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
  float margin = max(kSearchMargin * (high - low), smoothBend * low);
  gl_FragData[0] = bend <= smoothBend * low && steepest < kSide * kSide
                       ? vec4(t[5], t[6], t[9], t[10])
                       : vec4(-1.0, max(low - margin, 0.0), high + margin, 0.0);
}
