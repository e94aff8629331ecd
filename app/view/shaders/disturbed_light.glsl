// Effects of the fluid, the dew and the camera on a colour, for the picture and the bits in it.
uniform sampler2D murk;  // murk_field.h
steady float hazeStrength, fogStrength, exposureGain;
steady vec3 hazeExtinction;  // 1/m

const float kNearLayer = 0.010;  // m, depth of the coarse clouds; finer ones behind
const vec3 kBloodGlow = vec3(0.33, 0.026, 0.018);  // linear colour that blood scatters back
const vec3 kDewColour = vec3(0.70, 0.67, 0.645);   // stored colour of fully scattered light
const float kDewMost = 0.9;                        // share of light that dew scatters at most
const float kDewEdgeWeak = 0.95, kDewEdgeStrong = -0.45;  // inner edge, window radii, by strength
const float kDewEdgeWidth = 0.75;                         // window radii
const float kDewUneven = 0.10;                            // window radii, by the texture of the dew
const float kDewOnset = 6.0;                              // per strength: full effect from 1/6
const float kLeastRimLight = 0.05;  // smallest vignetting factor that is divided by

// Linear light is approximated by the square of a stored colour.
vec3 hazed(vec3 colour, float distance, vec2 at, float rim) {
  vec2 density = 2.0 * textureLod(murk, at, 0.0).rg;
  float thickness =
      density.r * min(distance, kNearLayer) + density.g * max(distance - kNearLayer, 0.0);
  vec3 through = exp(-hazeStrength * thickness * hazeExtinction);
  // Blood that the lamp lights scatters mostly red back.
  vec3 veil = kBloodGlow * (1.0 - through) * rim * rim;
  return sqrt(colour * colour * through + veil);
}
// Returns the share of light that the dew scatters.
float fogAt(vec2 at, float r) {
  float uneven = textureLod(murk, at, 0.0).b - 0.5;
  float edge = mix(kDewEdgeWeak, kDewEdgeStrong, fogStrength);
  return kDewMost * smoothstep(edge, edge + kDewEdgeWidth, r + kDewUneven * uneven) *
         min(kDewOnset * fogStrength, 1.0);
}
vec3 fogged(vec3 colour, float fog, float rim) { return mix(colour, kDewColour * rim, fog); }
// Undoes the camera's response curve first, so that the gain applies to light.
vec3 exposed(vec3 colour, float rim) {
  vec3 c = unshoulder(colour / max(rim, kLeastRimLight));
  return shoulder(c * pow(exposureGain, 1.0 / kGamma)) * rim;
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
