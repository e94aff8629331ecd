// Body that follows VTK's own vertex shader: maps the point from the lens frame (x right, y up, -z
// along the view) to the window. w is the distance, so that interpolation follows the surface.
  handOn();
  lensPoint = vertexVCVSOutput.xyz;
#ifdef TISSUE
  grain = grainMC;
  marks = marksMC;
  coarseNoise = noise(grain * kCoarseRate).w;
#else
  modelPoint = vertexMC.xyz;
#endif
  contactPoint = inPortal(lensPoint);
#ifdef HYALINE
  toPortal = vec3(dot(contactPoint, -given_contactRight), dot(contactPoint, -given_contactUp),
                  dot(contactPoint, given_contactAhead));
#endif
  float lensDistance = max(length(lensPoint), 1e-7);
  vec2 lensPlace = placeInWindow(lensPoint, lensDistance);
  float lensClip =
      2.0 * kFarthest / (kFarthest - kNearest) * (lensDistance - kNearest) - lensDistance;
  gl_Position = vec4(lensDistance * lensPlace, lensClip, lensDistance);
