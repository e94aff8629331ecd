// Two triangles over the whole target.
out vec2 texCoord;
void main() {
  handOn();
  texCoord = vec2(gl_VertexID & 1, gl_VertexID >> 1);
  gl_Position = vec4(2.0 * texCoord - 1.0, 0.0, 1.0);
}
