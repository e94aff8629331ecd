// First of two passes that save most of the search: rays through the corners of cells of
// cellPixels x cellPixels pixels. Writes distance and squared slope.
#include "backdrop_inputs.glsl"
#include "relief.glsl"
void main() {
  vec3 ray = rayOf((floor(gl_FragCoord.xy) - 1.0) * cellPixels / windowRadius - 1.0);
  float b = dot(tip, ray);
  float sphere = sqrt(max(b * b + clearance, 0.0)) - b;
  float t = meetRelief(ray, b, sphere);
  vec3 x = tip + t * ray;
  gl_FragData[0] =
      vec4(t, steepness2(x, textureLod(relief, panoramaPlace(x), 0.0) * perRadius), 0.0, 1.0);
}
