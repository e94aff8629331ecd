// GLSL of the backdrop: a pixel's ray to the sphere about the portal, or before it to the relief
// (relief_shader.h), and from there into the panorama [method.md, Oblique view]. Put together in
// backdrop_prop.cpp, with EQUIRECTANGULAR, RELIEF, CELLS defined or not: a processor goes both ways
// of every if.
#pragma once

namespace arthro::app {

inline constexpr const char* kBackdropHead = R"(//VTK::System::Dec
//VTK::Output::Dec
uniform sampler2D panorama;
uniform sampler2D relief;         // m, its slopes along u and v, how well inside the imaged part
uniform sampler2D reliefCeiling;  // m, of blocks of blockTexels
uniform sampler2D broadSlopes;    // m along u and v, smooth
uniform sampler2D corners, cells; // relief_cells.h
steady vec3 tip;               // in radii of the sphere
steady float clearance;        // 1 - |tip|^2, worked out in double
steady vec3 viewAxis, rightAxis;
steady float lensScale;        // sin(fov/4)
steady float windowRadius;     // px
steady vec2 centre, scale;     // of the projection, in texture units
steady vec2 texels, reliefTexels;
const float kSharpness = 0.7;

steady float samples;           // at most, a pixel
steady float radius, perRadius; // m, 1/m
steady float lightReach, gain, relit;
steady vec3 rodFrom, rodTo, headFrom, headTo;
steady float rodRadius, headRadius;
steady float highest;          // of the relief, in radii
steady float blockTexels;
steady float reliefSteps;      // at most, along a ray
steady float cellPixels, cellSteps, smoothBend;
steady vec2 notch;             // unit, image right and up
#define lampPlace (0.0011 * vec3(notch, 0.0))  // m, kLampAside
// Where nothing was imaged: neutral and dark, but not the black of the window's surround.
const vec3 endColour = vec3(0.105, 0.102, 0.1);
)";

// A place in the window, in its radii from its centre, right and up. Equisolid: |offset| lensScale
// = sin(theta/2).
inline constexpr const char* kLensUniforms = R"(
steady float lensInward[10], lensEnd;
steady vec2 lensAxis;
)";
inline constexpr const char* kLensRay = R"(
vec3 rayOf(vec2 offset) {
#ifdef LENS
  offset -= lensAxis;
  offset *= lensFactor(lensInward, lensEnd, dot(offset, offset));
#endif
  float s2 = min(dot(offset, offset) * lensScale * lensScale, 1.0);
  vec2 across = 2.0 * lensScale * sqrt(1.0 - s2) * offset;
  return (1.0 - 2.0 * s2) * viewAxis + across.x * rightAxis + across.y * cross(rightAxis, viewAxis);
}
)";

// A pixel's footprint in the panorama is an ellipse (texels a pixel: dx, dy), long and thin near
// the edge of a gnomonic picture and the poles of an equirectangular one. Samples are strung along
// its longer axis, each averaged over the shorter one; a single round average would blur fine lines
// together there (grid lines up to 1.8 px off instead of 0.3).
inline constexpr const char* kPanoramaFilter = R"(
vec3 panoramaColour(vec2 uv, vec2 dx, vec2 dy) {
  float a = dx.x * dx.x + dy.x * dy.x, b = dx.x * dx.y + dy.x * dy.y, c = dx.y * dx.y + dy.y * dy.y;
  float mean = 0.5 * (a + c), spread = sqrt(max(0.25 * (a - c) * (a - c) + b * b, 0.0));
  float longer = sqrt(mean + spread);
  float shorter = abs(dx.x * dy.y - dx.y * dy.x) / max(longer, 1e-6);
  vec2 axis = abs(b) > 1e-6 * mean ? normalize(vec2(mean + spread - c, b))
                                   : (a >= c ? vec2(1.0, 0.0) : vec2(0.0, 1.0));
  float count = clamp(ceil(longer / max(shorter, 1.0) - 0.4), 1.0, samples);
  float lod = log2(max(max(longer / count, shorter) * kSharpness, 1.0));
  // One level is half the work of two.
  if (samples <= 2.0) lod = floor(lod + 0.5);

  vec2 step = axis * longer / count / texels;
  vec2 start = uv - 0.5 * (count - 1.0) * step;
  vec3 sum = vec3(0.0);
  float i = 0.0;
  while (true) {
    sum += textureLod(panorama, start + i * step, lod).rgb;
    i += 1.0;
    if (i >= count) break;
  }
  return sum / count;
}
)";

inline constexpr const char* kBackdropMain = R"(
void main() {
  vec2 offset = gl_FragCoord.xy / windowRadius - 1.0;
  float r = length(offset);
  float coverage = rimCoverage(r, windowRadius);
  vec3 ray = rayOf(offset), upAxis = cross(rightAxis, viewAxis);

  // Ray -> sphere, or what stands before it.
  float b = dot(tip, ray);
  float sphere = sqrt(max(b * b + clearance, 0.0)) - b;
#ifdef CELLS
  vec3 x;
  vec2 uv;
  bool imaged;
  vec4 ground;  // there
  vec3 looks;
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
  // Once more towards it, by its slope there.
  vec3 outward = normalize(x) + (imaged ? ground.g * alongU + ground.b * alongV : vec3(0.0));
  float gap = (imaged ? ground.r : 0.0) - 1.0 + length(x);
  float nearer = clamp(gap / max(dot(outward, ray), 0.05), -0.03 * reach, 0.03 * reach);
  reach = min(reach - nearer, sphere);
  x -= nearer * ray;
  uv -= nearer * vec2(dot(alongU, ray), dot(alongV, ray));
#endif

  // A pixel's footprint: of the surface as it lies there, but at outlines, where a pixel's
  // neighbours are elsewhere, not much more than that of one that faces the lens.
  vec3 acrossX = dFdx(x), acrossY = dFdy(x);
#ifdef RELIEF
  float facing = reach * length(dFdx(ray));
  acrossX *= min(1.0, 4.0 * facing / max(length(acrossX), 1e-9));
  acrossY *= min(1.0, 4.0 * facing / max(length(acrossY), 1e-9));
#endif
  vec2 dx = vec2(dot(alongU, acrossX), dot(alongV, acrossX)),
       dy = vec2(dot(alongU, acrossY), dot(alongV, acrossY));
  
#ifdef RELIT
  vec2 broad = perRadius * textureLod(broadSlopes, uv, 0.0).rg;
#endif
  float wall = 0.0;
#if defined(RELIEF) && !defined(PLAIN)
  // What stands nearly along the way from the portal was hardly seen by the footage: what its texels
  // have is smeared along it. It is the side of what stands before it, so it is shown in that one's
  // mean colour, and dimly.
#ifndef CELLS
  vec2 up = upwards(ground);
  float here = ground.r;
  vec3 looks = perRadius * vec3(textureLod(relief, uv + up, 0.0).r, textureLod(relief, uv - up, 0.0).r,
                                textureLod(relief, uv + 2.0 * up, 0.0).r);
#endif
  float steep = imaged ? length(ground.g * alongU + ground.b * alongV) : 0.0;
  float side = smoothstep(kSide, 6.0, steep);
  float down = (looks.x - here) / max(looks.x - looks.y, 1e-6);
  float way = max(length(up / vec2(length(alongU), length(alongV))), 1e-6);
  // At its foot lies what is behind it.
  float top = max(looks.x, looks.z);
  float foot = step(0.95, (top - here) / max(top - looks.y, 1e-6));
  wall = max(side * smoothstep(0.1, 0.3, down), smoothstep(kSide, 6.0, (looks.z - looks.x) / way)) *
         (1.0 - foot);
  side *= 1.0 - foot;
  dx += side * 12.0 / texels * vec2(1.0, 0.0);
  dy += side * 12.0 / texels * vec2(0.0, 1.0);
  uv += side * 14.0 / 2.2 * reliefTexels / texels * up;
#endif
  vec3 colour = imaged ? panoramaColour(uv, dx * texels, dy * texels) : vec3(0.0);

#ifdef RELIEF
  float distance = radius * reach;
#else
  // Depth of the relief's point in the direction that the colour comes from.
  float distance = radius * dot((1.0 - (imaged ? ground.r : 0.0)) * x - tip, ray);
#endif
  distance = clamp(distance, 1.001 * nearest, farthest);
  float stored = storedDepth(distance);

#ifdef PLAIN
  vec3 shown = imaged ? colour : vec3(0.0);
#else
  // The panorama was lit when it was taken: what lies far fades, but nothing is lit a second time.
  // Squares and roots stand for sRGB and back.
  float light = min(lightAt(distance), 1.0);
  light *= 1.0 - 0.35 * wall;
#ifdef ROD
  float shade = rodShade(distance * vec3(dot(ray, rightAxis), dot(ray, upAxis), -dot(ray, viewAxis)));
  light *= shade;
#endif
#ifdef RELIT
  // A film of fluid over what the relief's slopes make of the surface.
  vec3 normal = -normalize(normalize(x) + (imaged ? broad.x * alongU + broad.y * alongV : vec3(0.0)));
  vec3 toLamp = normalize(tip + perRadius * (lampPlace.x * rightAxis + lampPlace.y * upAxis) - x);
  float faces = mix(max(dot(normal, toLamp), 0.0), 0.8, wall), shine = max(dot(normal, normalize(toLamp - ray)), 0.0);
  float lamp = lampAt(distance);
#ifdef ROD
  lamp *= shade;
#endif
  float shine4 = shine * shine * shine * shine, shine16 = shine4 * shine4 * shine4 * shine4;
  float shine64 = shine16 * shine16 * shine16 * shine16;
  float wet = lamp * (0.02 * shine16 + 0.30 * shine64 * shine64 * shine64);
  vec3 body = colour * colour * mix(light, lamp * (0.2 + 0.8 * faces) * (1.0 - 0.35 * wall), relit);
  vec3 lit = shoulder(sqrt(body + relit * wet));
#else
  vec3 lit = shoulder(colour * sqrt(light));
#endif
  vec3 shown = mix(endColour, lit, imaged ? smoothstep(0.0, 1.0, ground.a) : 0.0) * softRim(r);
  float along = dot(offset, notch) - 0.925;
  float beside = abs(offset.x * notch.y - offset.y * notch.x);
  float mark = clamp((0.5 * along - beside) * 0.9 * windowRadius + 0.5, 0.0, 1.0);
  shown *= 1.0 - mark;
  if (mark > 0.5) stored = 0.0;
#endif
  if (coverage <= 0.0) stored = 0.0;
  gl_FragDepth = stored;
  gl_FragData[0] = vec4(shown * coverage, 1.0);
}
)";

}  // namespace arthro::app
