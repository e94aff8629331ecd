// Declarations of a model's shaders, after its inputs. VARYING is `out` for the vertices and `in`
// for the fragments, which also define FRAGMENT.
#include "distance.glsl"
VARYING vec3 contactPoint;  // m, in the portal frame
#include "contact.glsl"
#include "noise.glsl"
VARYING vec3 lensPoint;  // m, in the lens frame
#ifdef TISSUE
VARYING vec3 grain;  // m, coordinates of the pattern at rest (tissue_grain.h)
VARYING vec3 marks;  // rim, root, and 1 on the face of a cut
VARYING float coarseNoise;
#ifdef HYALINE
VARYING vec3 toPortal;  // m, in the lens frame: to the portal, where the footage had its lamp
#endif
#else
VARYING vec3 modelPoint;  // m, in the model's frame
#endif
#ifdef FRAGMENT
#include "light.glsl"
#include "lamp.glsl"
#include "model_looks.glsl"
#ifdef TISSUE
#include "tissue_pattern.glsl"
#endif
#elif defined(TISSUE)
in vec3 grainMC, marksMC;
const float kCoarseRate = 300.0;  // 1/m, of the coarse noise
#endif

const float kLeastHalfCosine2 = 0.0025;  // squared cosine of theta/2, keeps places behind finite
// Returns the window place of a point in the lens frame. sin(theta/2) = sin(theta) /
// (2 cos(theta/2)), so no angle is needed.
vec2 placeInWindow(vec3 point, float distance) {
  float halfCosine = sqrt(max(0.5 - 0.5 * point.z / distance, kLeastHalfCosine2));
  vec2 place = point.xy / distance / (2.0 * lensScale * halfCosine);
#ifdef LENS
  place = lensAxis + place * lensFactor(lensOutward, lensEnd, dot(place, place));
#endif
  return place;
}
