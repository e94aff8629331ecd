// Distances from the lens, m, as they are stored in the depth buffer, and the radial term of a lens
// that is not equisolid (simulation/scope/window_lens.h).
#include "constants.inc"

// Returns f/(f-n) - f n/((f-n) d): 0 at the nearest distance n, 1 at the farthest f.
float storedDepth(float distance) {
  return kFarthest / (kFarthest - kNearest) * (1.0 - kNearest / distance);
}

#ifdef LENS
// Returns the ratio of the image radius to that of an equisolid lens, at a squared image radius.
float lensFactor(float terms[10], float end, float squared) {
  float s = min(squared, end), sum = terms[9];
  for (int k = 8; k >= 0; --k) sum = sum * s + terms[k];
  return sum;
}
#endif
