// Fragment of a drifting bit: occlusion by the scene and the disturbances in front of it.
#include "picture_inputs.glsl"
#include "disturbed_light.glsl"
in vec2 within;
flat in vec4 bitPlace, bitLook;
const float kFadeDepth = 0.3e-3;  // m in front of the scene over which a bit fades
// Writes the bit. With `through` it shows the scene behind it, so the scene's distance counts.
void show(vec3 colour, float alpha, bool through) {
  vec2 at = gl_FragCoord.xy / (2.0 * windowRadius);
  float r = length(2.0 * at - 1.0);
  float rim = softRim(r), fog = 0.0;
#ifdef FOG
  fog = fogAt(at, r);
#endif
  float stored = storedAt(at);
  float scene = distanceOf(stored);
  float seen = stored > 0.0 ? alpha * clamp((scene - bitPlace.w) / kFadeDepth, 0.0, 1.0) : 0.0;
  float murky = through ? scene : bitPlace.w;
  gl_FragData[0] = vec4(disturbed(colour * rim, murky, at, rim, fog) * seen, seen);
}
