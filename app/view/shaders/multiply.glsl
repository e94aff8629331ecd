// Hands on the mean light (occlusion_mean.glsl), which the blending multiplies with what is drawn
// already. A texel of it stands for its upper right corner.
in vec2 texCoord;
uniform sampler2D factor;
void main() {
  gl_FragData[0] = textureLod(factor, texCoord - 0.5 / vec2(textureSize(factor, 0)), 0.0);
}
