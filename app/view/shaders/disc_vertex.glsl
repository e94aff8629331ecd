// Polygon of kDiscCorners around the round window. Its triangles have the shortest edges within it:
// a software rasteriser shades each block of pixels that an edge crosses twice. A first row of
// triangles cuts off every second corner, the next one every second of those that are left.
#include "constants.inc"
uniform float reach;  // radius of the corners; 1 is the disc's rim
out vec2 texCoord;
const float kTurn = 6.283185307;  // rad
void main() {
  handOn();
  int triangle = gl_VertexID / 3, row = kDiscCorners / 2, step = 1;
  for (; triangle >= row; row /= 2, step *= 2) triangle -= row;
  int index = step * (2 * triangle + gl_VertexID % 3);
  float turn = kTurn / float(kDiscCorners) * (float(index) + 0.5);
  vec2 corner = reach * vec2(cos(turn), sin(turn));
  texCoord = 0.5 + 0.5 * corner;
  gl_Position = vec4(corner, 0.0, 1.0);
}
