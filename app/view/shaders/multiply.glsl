// Hands on the mean light, which the blending multiplies with what is drawn already.
#include "occlusion_light.glsl"
in vec2 texCoord;
void main() { gl_FragData[0] = vec4(vec3(occlusionLight(texCoord)), 1.0); }
