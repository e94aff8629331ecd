// Mean colour of each part of the picture, for the exposure of the camera. Variant: OCCLUDED.
#include "constants.inc"
#ifdef OCCLUDED
#include "occlusion_light.glsl"
#endif
in vec2 texCoord;
uniform sampler2D picture;
const float kPlaces = 4.0;  // samples per part and axis
void main() {
  vec3 sum = vec3(0.0);
  for (float j = 0.5; j < kPlaces; j += 1.0)
    for (float i = 0.5; i < kPlaces; i += 1.0)
      sum += textureLod(picture,
                        texCoord + (vec2(i, j) / kPlaces - 0.5) / float(kMeteredParts), 0.0)
                 .rgb;
#ifdef OCCLUDED
  sum *= occlusionLight(texCoord);
#endif
  gl_FragData[0] = vec4(sum / (kPlaces * kPlaces), 1.0);
}
