// Drifting bits (drifting_bits.h), two triangles each. place: centre, radius, distance; look:
// angle, shape, opacity, softness.
#include "constants.inc"
uniform vec4 place[kMostFlakes];
uniform vec4 look[kMostFlakes];
out vec2 within;
flat out vec4 bitPlace, bitLook;
void main() {
  handOn();
  int bit = gl_VertexID / 6, corner = gl_VertexID % 6;
  vec2 at = vec2(corner == 1 || corner == 2 || corner == 4 ? 1.0 : -1.0,
                 corner == 2 || corner == 4 || corner == 5 ? 1.0 : -1.0);
  bitPlace = place[bit];
  bitLook = look[bit];
  within = at * (1.0 + bitLook.w);
  gl_Position = vec4(bitPlace.xy + bitPlace.z * within, 0.0, 1.0);
}
