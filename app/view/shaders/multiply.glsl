// Hands on a texture that the blending multiplies with what is drawn already.
in vec2 texCoord;
uniform sampler2D factor;
void main() { gl_FragData[0] = textureLod(factor, texCoord, 0.0); }
