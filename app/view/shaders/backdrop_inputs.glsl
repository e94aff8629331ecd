// Inputs of all shaders of the backdrop, and a pixel's ray [method.md, Oblique view]. Lengths are
// in radii of the sphere around the portal unless a unit is given.
#include "distance.glsl"
uniform sampler2D panorama;
uniform sampler2D relief;          // m; its slopes along u and v; weight of the imaged part, -1 to 1
uniform sampler2D reliefCeiling;   // m, maximum of each block of blockTexels x blockTexels
uniform sampler2D broadSlopes;     // m along u and v, low-pass filtered; 1, or 0 near steps
uniform sampler2D corners, cells;  // relief_cells.h
steady vec3 tip;
steady float clearance;            // 1 - |tip|^2, computed in double precision
steady vec3 viewAxis, rightAxis;
steady float lensScale;            // sin(fov/4)
steady float windowRadius;         // px
steady vec2 centre, scale;         // projection, texture units
steady vec2 texels, reliefTexels;
steady float endTexels;            // texels of the panorama beyond its edge in which it fades

steady float samples;              // at most, per pixel
steady float radius, perRadius;    // m, 1/m
steady float lightReach, gain, relit;
steady vec2 glints;                // sharp and broad glint of the fluid film
steady float mirroredShare;        // ratio by medium (simulation/scene/medium.h)
steady vec3 rodFrom, rodTo, headFrom, headTo;
steady float rodRadius, headRadius;
steady float leastSide;            // height of the lowest step that has a side, above 0
steady float highest;              // maximum of the relief
steady float blockTexels;
steady float reliefSteps;          // at most, along a ray
steady float cellPixels, cellSteps, smoothBend;
steady vec2 notch;                 // unit vector, image right and up
#define lampPlace (kLampAside * vec3(notch, 0.0))
#ifdef LENS
steady float lensInward[10], lensEnd;
steady vec2 lensAxis;
#endif

// Returns the ray through a place of the window, given from its centre, right and up, in window
// radii. Equisolid projection: |offset| lensScale = sin(theta/2).
vec3 rayOf(vec2 offset) {
#ifdef LENS
  offset -= lensAxis;
  offset *= lensFactor(lensInward, lensEnd, dot(offset, offset));
#endif
  float s2 = min(dot(offset, offset) * lensScale * lensScale, 1.0);
  vec2 across = 2.0 * lensScale * sqrt(1.0 - s2) * offset;
  return (1.0 - 2.0 * s2) * viewAxis + across.x * rightAxis + across.y * cross(rightAxis, viewAxis);
}
