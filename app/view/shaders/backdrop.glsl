// Backdrop: follows a pixel's ray to the sphere around the portal, or to the relief in front of it,
// and from there into the panorama [method.md, Oblique view]. Variants: EQUIRECTANGULAR, WRAPS,
// LENS, RELIEF, CELLS, PLAIN, RELIT and ROD, because a software rasteriser executes both branches
// of every `if`.
#include "backdrop_inputs.glsl"
#include "light.glsl"
#include "lamp.glsl"
#include "panorama.glsl"
#ifdef RELIEF
#include "relief.glsl"
#endif
#ifdef CELLS
#include "relief_by_cells.glsl"
#endif

// Linear colour where nothing was imaged: neutral and dark, brighter than the black surround.
const vec3 endColour = vec3(0.105, 0.102, 0.1);
// Beyond the imaged part the last colours go on, ever more blurred, and fade into it.
const float kEndBlur = 1.0;      // texels per texel beyond the edge
const float kWholeColour = 0.8;  // weight of the imaged part from which colours have not faded

// Refinement by the slope after a search by cells.
const float kLeastDescent = 0.05;    // cosine between ray and surface normal
const float kMostCorrection = 0.03;  // share of the distance
// Footprints at outlines, where neighbouring pixels lie elsewhere.
const float kMostFootprint = 4.0;  // times that of a surface that faces the lens
// Sides of steps.
const float kFullSide = 6.0;                 // slope of a certain side
const float kTopStart = 0.1, kTopEnd = 0.3;  // share of the step below its upper edge
const float kFoot = 0.95;                    // share of the step from which its foot begins
// Near the outline of a rounded part, slopes grow as one over the root of the distance from it. The
// place itself is nearer to it than the two looks above, as 1 to 3: so steeper by root 3.
const float kRounded = 1.73;
const float kSideBlur = 12.0;                // texels of the panorama
const float kSideShift = 14.0;               // texels towards the upper edge
// A side is no brighter than the surface between it and the place of its colour: at this share of
// the shift, at this level of detail.
const float kEdgeShare = 0.55, kEdgeLevel = 3.0;
const vec3 kLuma = vec3(kLumaRed, kLumaGreen, kLumaBlue);
const float kLeastLuma = 0.01;    // smallest luma that is divided by
const float kNoisySide = 0.2e-3;  // m, lowest step with a side in a relief that counts as noisy
const float kWallShade = 0.35;               // loss of light on a side
const float kWallFacing = 0.8;               // cosine to the lamp that a side counts as
// Fluid film under the lamp.
const float kSheen = 0.02;
// Orientation mark at the rim: a triangle that points outwards.
const float kMarkTip = 0.925;     // window radii
const float kMarkSlope = 0.5;     // half its width over its length
const float kMarkEdge = 0.9;      // cosine of its sides, softens the edge by 1 px
const float kLeastDepth = 1.001;  // times kNearest

void main() {
  vec2 offset = gl_FragCoord.xy / windowRadius - 1.0;
  float r = length(offset);
  float coverage = rimCoverage(r, windowRadius);
  vec3 ray = rayOf(offset), upAxis = cross(rightAxis, viewAxis);

  // Intersection with the sphere, or with the relief in front of it.
  float b = dot(tip, ray);
  float sphere = sqrt(max(b * b + clearance, 0.0)) - b;
#ifdef CELLS
  vec3 x;
  vec2 uv;
  bool imaged;
  vec4 ground;  // relief there
  vec3 looks;   // relief above, below and further up
  float reach = meetReliefByCells(ray, sphere, x, uv, imaged, ground, looks);
  vec2 up = upwards(ground);
  float here = ground.r;
#else
#ifdef RELIEF
  float reach = meetRelief(ray, b, sphere);
#else
  float reach = sphere;
#endif
  vec3 x = tip + reach * ray;
  vec2 uv = panoramaPlace(x);
  bool imaged = isImaged(x, uv);
  vec4 ground = textureLod(relief, uv, 0.0) * vec4(vec3(perRadius), 1.0);
#endif
  vec3 alongU, alongV;
  placeGradients(x, alongU, alongV);
#ifdef CELLS
  // One Newton step along the ray, by the slope there.
  vec3 outward = normalize(x) + (imaged ? ground.g * alongU + ground.b * alongV : vec3(0.0));
  float gap = (isBefore(x) ? ground.r : 0.0) - 1.0 + length(x);
  float nearer = clamp(gap / max(dot(outward, ray), kLeastDescent), -kMostCorrection * reach,
                       kMostCorrection * reach);
  reach = min(reach - nearer, sphere);
  x -= nearer * ray;
  uv -= nearer * vec2(dot(alongU, ray), dot(alongV, ray));
#endif

  // Footprint of a pixel on the surface. At outlines it is limited to a multiple of that of a
  // surface that faces the lens.
  vec3 acrossX = dFdx(x), acrossY = dFdy(x);
#ifdef RELIEF
  float facing = reach * length(dFdx(ray));
  acrossX *= min(1.0, kMostFootprint * facing / max(length(acrossX), 1e-9));
  acrossY *= min(1.0, kMostFootprint * facing / max(length(acrossY), 1e-9));
#endif
  vec2 dx = vec2(dot(alongU, acrossX), dot(alongV, acrossX)),
       dy = vec2(dot(alongU, acrossY), dot(alongV, acrossY));

#ifndef PLAIN
  float beyond = length(beyondEdge(uv) * texels) / endTexels;
  float end = isBefore(x) ? clamp(ground.a - 2.0 * beyond, -1.0, 1.0) : -1.0;
  // Slopes end sooner than colours: those along the edge would grow towards a pole.
  float slopes = isBefore(x) ? clamp(1.0 - 2.0 * beyond + min(ground.a, 0.0), 0.0, 1.0) : 0.0;
  // The same angle in all directions: a turn about a pole has ever fewer places.
  vec2 blur = kEndBlur * endTexels * clamp(max(beyond, -ground.a), 0.0, 1.0) * length(x) *
              vec2(length(alongU), length(alongV)) / abs(scale);
  blur = min(blur, texels);
#else
  vec2 blur = vec2(0.0);
#endif
#ifdef RELIT
  vec3 broad = textureLod(broadSlopes, uv, 0.0).rgb * vec3(perRadius, perRadius, 1.0);
#endif
  float wall = 0.0;
#if defined(RELIEF) && !defined(PLAIN)
  // The footage hardly saw surfaces that are nearly parallel to the direction from the portal:
  // their texels are smeared. They are sides of a nearer part, so they get its mean colour, dimmed.
#ifndef CELLS
  vec2 up = upwards(ground);
  float here = ground.r;
  vec3 looks =
      perRadius * vec3(textureLod(relief, uv + up, 0.0).r, textureLod(relief, uv - up, 0.0).r,
                       textureLod(relief, uv + 2.0 * up, 0.0).r);
#endif
  float steep = slopes * length(ground.g * alongU + ground.b * alongV);
  float side = smoothstep(kSide, kFullSide, steep);
  float down = (looks.x - here) / max(looks.x - looks.y, 1e-6);
  float way = max(length(up / vec2(length(alongU), length(alongV))), 1e-6);
  // The foot of a step shows the surface behind it. Slopes that the noise of the relief explains are
  // no steps.
  float top = max(looks.x, looks.z);
  float isStep = smoothstep(leastSide, 2.0 * leastSide, top - looks.y);
  side *= isStep;
  float below = smoothstep(kTopStart, kTopEnd, down);
  float foot = step(kFoot, (top - here) / max(top - looks.y, 1e-6));
  float above = (looks.z - looks.x) / way;
  above = max(above, min(steep, kRounded * above));
  wall = max(side * below, isStep * smoothstep(kSide, kFullSide, above)) *
         (1.0 - foot);
  // A noisy relief is footage, whose own blur is wider than the smear: near the upper edge its
  // texels are at the right place. They are blurred there all the same: a texel across the edge
  // would be a stripe down the side.
  side *= 1.0 - foot;
  blur += side * kSideBlur;
  side *= mix(1.0, below, step(kNoisySide, radius * leastSide));
  vec2 shift = kSideShift / kLookTexels * reliefTexels / texels * up;
  vec2 edgePlace = uv + kEdgeShare * shift;
  uv += side * shift;
#else
  float side = 0.0;
  vec2 edgePlace = uv;
#endif
  vec3 edge;
  vec3 colour =
      panoramaColour(uv, dx * texels, dy * texels, blur, side, edgePlace, kEdgeLevel, edge);
#if defined(RELIEF) && !defined(PLAIN)
  colour *= mix(1.0, min(dot(edge, kLuma) / max(dot(colour, kLuma), kLeastLuma), 1.0), side);
#endif

#ifdef RELIEF
  float distance = radius * reach;
#else
  // Depth of the relief's point in the direction that the colour comes from.
  float distance = radius * dot((1.0 - (imaged ? ground.r : 0.0)) * x - tip, ray);
#endif
  distance = clamp(distance, kLeastDepth * kNearest, kFarthest);
  float stored = storedDepth(distance);

#ifdef PLAIN
  vec3 shown = imaged && ground.a > 0.0 ? colour : vec3(0.0);
#else
  // The panorama holds the light of its footage: far parts are darkened, none is brightened again.
  // Squares and square roots approximate sRGB and its inverse.
  float light = min(lightAt(distance), 1.0);
  light *= 1.0 - kWallShade * wall;
#ifdef ROD
  float shade =
      rodShade(distance * vec3(dot(ray, rightAxis), dot(ray, upAxis), -dot(ray, viewAxis)));
  light *= shade;
#endif
#ifdef RELIT
  // Diffuse shading by low-pass filtered normals, and a film of fluid over them.
  vec3 normal =
      -normalize(normalize(x) + slopes * (broad.x * alongU + broad.y * alongV));
  vec3 toLamp = normalize(tip + perRadius * (lampPlace.x * rightAxis + lampPlace.y * upAxis) - x);
  float faces = mix(max(dot(normal, toLamp), 0.0), kWallFacing, wall),
        shine = max(dot(normal, normalize(toLamp - ray)), 0.0);
  float lamp = lampAt(distance);
#ifdef ROD
  lamp *= shade;
#endif
  float shine4 = shine * shine * shine * shine, shine16 = shine4 * shine4 * shine4 * shine4;
  float shine64 = shine16 * shine16 * shine16 * shine16;
  float glint = glints.x * shine64 * shine64 * shine64 + glints.y * shine64;
  float wet = mirroredShare * lamp * (kSheen * shine16 + glint) * broad.z;
  vec3 body =
      colour * colour *
      mix(light, lamp * (kRelitAmbient + (1.0 - kRelitAmbient) * faces) * (1.0 - kWallShade * wall),
          relit);
  vec3 lit = shoulder(sqrt(body + relit * wet));
#else
  vec3 lit = shoulder(colour * sqrt(light));
#endif
  vec3 shown = mix(endColour, lit, smoothstep(-1.0, kWholeColour, end)) * softRim(r);
  float along = dot(offset, notch) - kMarkTip;
  float beside = abs(offset.x * notch.y - offset.y * notch.x);
  float mark = clamp((kMarkSlope * along - beside) * kMarkEdge * windowRadius + 0.5, 0.0, 1.0);
  shown *= 1.0 - mark;
  if (mark > 0.5) stored = 0.0;
#endif
  if (coverage <= 0.0) stored = 0.0;
  gl_FragDepth = stored;
  gl_FragData[0] = vec4(shown * coverage, 1.0);
}
