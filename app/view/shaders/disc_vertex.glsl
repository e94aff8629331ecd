// Fan of kDiscCorners triangles over the round window.
#include "constants.inc"
uniform float reach;  // radius of the corners; 1 is the disc's rim
out vec2 texCoord;
const float kTurn = 6.283185307;  // rad
void main() {
  handOn();
  float turn = kTurn / float(kDiscCorners) * float(gl_VertexID);
  vec2 corner = gl_VertexID == 0 ? vec2(0.0) : reach * vec2(cos(turn), sin(turn));
  texCoord = 0.5 + 0.5 * corner;
  gl_Position = vec4(corner, 0.0, 1.0);
}
