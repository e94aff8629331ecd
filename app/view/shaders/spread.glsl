// Diameter of the near blur at a quarter of the resolution; its mipmaps spread near parts over what
// is behind them.
#include "picture_inputs.glsl"
in vec2 texCoord;
steady float pixelsOfAngle, nearFocus, mostBlur;  // px m, m, px
const float kLeastStored = 1e-6;                  // keeps the distance finite
float blurOf(vec2 at) {
  float stored = storedAt(at);
  float distance = distanceOf(max(stored, kLeastStored));
  return stored > 0.0 ? pixelsOfAngle * max(1.0 / distance - 1.0 / nearFocus, 0.0) : 0.0;
}
void main() {
  vec2 texel = 0.5 / windowRadius * vec2(1.0, -1.0);
  float blur = max(max(blurOf(texCoord + texel.xx), blurOf(texCoord + texel.xy)),
                   max(blurOf(texCoord + texel.yx), blurOf(texCoord + texel.yy)));
  gl_FragData[0] = vec4(min(blur / mostBlur, 1.0));
}
