// Mean of a texture over 4 x 4 texels, around the upper right corner of the texel that is drawn.
// Each of four samples lies on a corner of texels and so is the mean of 2 x 2; a pattern that
// repeats after 4 texels leaves no trace.
in vec2 texCoord;
uniform sampler2D light;

void main() {
  vec2 size = vec2(textureSize(light, 0));
  vec2 corner = floor(texCoord * size) + 1.0;
  vec4 sum = vec4(0.0);
  for (int y = -1; y <= 1; y += 2)
    for (int x = -1; x <= 1; x += 2)
      sum += textureLod(light, (corner + vec2(float(x), float(y))) / size, 0.0);
  gl_FragData[0] = 0.25 * sum;
}
