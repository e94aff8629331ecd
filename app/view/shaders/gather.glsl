// Copies the picture for its mipmaps, weighted by alpha, so that a blurred pixel takes nothing from
// sharp parts beside it, and nothing from the dark surround of the window.
#include "picture_inputs.glsl"
in vec2 texCoord;
uniform sampler2D picture;
#ifdef FAR_ONLY
steady float pixelsOfAngle;       // aperture (m) times pixels per radian
steady float farFocus;            // m
const float kLeastWeight = 0.04;  // weight of a sharp pixel
#endif
void main() {
  float stored = storedAt(texCoord);
  float weight = stored > 0.0 ? 1.0 : 0.0;
#ifdef FAR_ONLY
  float blur = pixelsOfAngle * (1.0 / farFocus - 1.0 / distanceOf(stored));
  weight *= clamp(0.5 * blur, kLeastWeight, 1.0);
#endif
  // The vignetting is removed here, and applied again when the picture is composed.
  vec3 colour = textureLod(picture, texCoord, 0.0).rgb /
                max(softRim(length(2.0 * texCoord - 1.0)), kLeastRim);
  gl_FragData[0] = vec4(min(colour, vec3(1.0)) * weight, weight);
}
