// Mean light of short-range occlusion (occlusion_mean.glsl) at a place of the picture. A texel of it
// stands for its upper right corner.
uniform sampler2D occlusion;
float occlusionLight(vec2 at) {
  return textureLod(occlusion, at - 0.5 / vec2(textureSize(occlusion, 0)), 0.0).r;
}
