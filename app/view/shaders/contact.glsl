// Height of a model over the relief: where a model meets the relief it fades over a third of a
// millimetre, and little light gets between the two. Lengths in m.
#ifndef FRAGMENT
// Returns a point of the lens frame in the portal frame. VTK declares given_contactTip, -Right, -Up
// and -Ahead.
vec3 inPortal(vec3 point) {
  return given_contactTip + point.x * given_contactRight + point.y * given_contactUp -
         point.z * given_contactAhead;
}
#else
// VTK declares contactRadius, of the backdrop (0: there is no relief), and contactCentre and
// contactScale (texture units).
uniform sampler2D contactRelief;  // weight of the imaged part in its fourth channel
#define centre contactCentre
#define scale contactScale
#include "place.glsl"
// kContactFade: over the relief, from nothing to the whole model; kContactLight: light that is left
// at the relief.
#ifdef HYALINE
// A plate lies on the relief like a skin and sinks into it at its rim: nothing shades it there.
const float kContactFade = 0.05e-3, kContactLight = 1.0;
#else
const float kContactFade = 0.3e-3, kContactLight = 0.55;
#endif
const float kContactReach = 1.2e-3;  // reach of the shade between model and relief

// Returns the height of a point of the portal frame over the relief, along its direction from the
// portal; more than kContactReach where there is no relief.
float heightOverRelief(vec3 point) {
  vec2 uv = panoramaPlace(point);
  vec4 ground = textureLod(contactRelief, uv, 0.0);
  bool isThere = contactRadius > 0.0 && isImaged(point, uv) && ground.a > 0.0;
  return isThere ? contactRadius - ground.r - length(point) : 2.0 * kContactReach;
}
// Returns the share of a model that is seen, and the light that reaches it beside the relief.
float contactShare(float height) { return smoothstep(0.0, kContactFade, height); }
float contactLight(float height) {
  float away = clamp(height / kContactReach, 0.0, 1.0);
  return mix(kContactLight, 1.0, away * (2.0 - away));
}
#endif
