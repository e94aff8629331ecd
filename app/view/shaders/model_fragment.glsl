// Body that replaces VTK's lighting. A fragment whose own direction is outside the window, or
// elsewhere in it, belongs to a triangle that wraps around the back of the lens: it is discarded.
// FINE: the depth between vertices is that of OpenGL, which tests it before it shades.
  float lensDistance = length(lensPoint);
  vec2 lensOffset = (gl_FragCoord.xy - windowRadius) / windowRadius;
  float lensR = length(lensOffset);
  vec2 lensPlace = placeInWindow(lensPoint, lensDistance);
  float coverage = rimCoverage(lensR, windowRadius);
  bool behind = lensPoint.z > (kBackOfLens * lensScale * lensScale - 1.0) * lensDistance;
  if (behind || distance(lensPlace, lensOffset) > kMostOffPlace || coverage <= 0.0 ||
      lensDistance < kNearest)
    discard;
#ifndef FINE
  gl_FragDepth = storedDepth(lensDistance);
#endif
  vec3 toLens = -lensPoint / lensDistance;
  // The fibres that give light end beside the lens, not in it.
  vec3 toLight = normalize(lampPlace - lensPoint);
  vec3 normal = normalVCVSOutput;
  vec3 halfway = normalize(toLight + toLens);
  float facing = max(dot(normal, toLight), 0.0);
  float seen = max(dot(normal, toLens), 0.0);
  float shine = max(dot(normal, halfway), 0.0);
  float light = mix(lightAt(lensDistance), lampAt(lensDistance), relit);
#ifdef TISSUE
#ifdef HYALINE
  // The border of a plate is drawn like its face: it passes into the bone without an edge.
  vec3 face = normalize(normalMatrix * grainAxis);
  normal = normalize(mix(normal, dot(face, toLens) < 0.0 ? -face : face, kSoftBorder * marks.x));
#endif
  Pattern pattern = patternAt(normal);
  vec3 own = modelColour * pattern.tint;
  own = mix(own, vesselColour, pattern.vessel);
#ifdef HYALINE
  // Towards the border the plate takes the colour of what surrounds it.
  const vec3 kLuma = vec3(kLumaRed, kLumaGreen, kLumaBlue);
  vec3 around = surround * dot(own, kLuma) / max(dot(surround, kLuma), kLeastSurround);
  own = mix(own, around / max(lightColour, vec3(kLeastSurround)) * dot(lightColour, kLuma),
            kSoftColour * marks.x * marks.x);
#endif
  normal = tilted(normal, pattern.height);
  facing = max(dot(normal, toLight), 0.0);
  shine = max(dot(normal, halfway), 0.0);
#ifdef HYALINE
  // A plate is lit like the backdrop that it lies on: in part by the footage's lamp at the portal.
  float baked = diffuse(max(dot(normal, normalize(toPortal)), 0.0));
  float lit = mix(min(lightAt(lensDistance), 1.0) * baked,
                  lampAt(lensDistance) * (kRelitAmbient + (1.0 - kRelitAmbient) * facing), relit);
#else
  vec3 scattered = mix(kScattered, vec3(1.0), smoothstep(0.0, kWhiteFacing, facing));
  vec3 lit = scattered * diffuse(facing) * light;
#endif
  vec3 body = own * lightColour * lit;
  float shine2 = shine * shine, shine4 = shine2 * shine2, shine8 = shine4 * shine4;
  float shine64 = shine8 * shine8;
  shine64 *= shine64 * shine64 * shine64;
  float glance = (1.0 - seen) * (1.0 - seen);
  vec3 wet = lightColour * light * pattern.gloss * (kWetSheen * shine8 * shine4 * shine2 +
                                    kWetGlint * shine64 * shine64 * shine64);
#ifdef HYALINE
  glance *= 1.0 - marks.x;
#endif
  vec3 mirrored = surround * (kMirrored + kGrazing * glance * glance);
  vec3 linear = (body + mirroredShare * wet) * rodShade(lensPoint) + mirroredShare * mirrored;
#else
  // Towards the outline of a round part the squared cosine falls by 2 / radius per length, which
  // gives the share of the pixel. A flat part, and the hollow of the hook, is whole up to its
  // outline.
  float cosine = dot(normal, toLens);
  vec3 acrossX = dFdx(lensPoint), acrossY = dFdy(lensPoint);
  float roundness = max(dot(dFdx(normal), acrossX) / dot(acrossX, acrossX),
                        dot(dFdy(normal), acrossY) / dot(acrossY, acrossY));
  roundness *= max(smoothstep(kHollowEnd, kHollowFades, distance(modelPoint.yz, kHollow)),
                   1.0 - etchedRings);
  float slope =
      max(4.0 * lensScale / windowRadius * lensDistance * roundness, kLeastSlope);
  float outline = cosine * abs(cosine) / slope - min(kFacet / slope, kMostFacet);
  if (-modelPoint.z > rodLength || outline <= 0.0) discard;
  float ring = -modelPoint.z / kRingDistance;
  float etched = etchedRings > 0.5 && ring > kFirstRing && ring < kLastRing
                     ? 1.0 - smoothstep(kRingHalf, kRingHalfSoft, abs(ring - round(ring)))
                     : 0.0;
  vec3 steel = modelColour * (1.0 - kRingDark * etched);
  // Turned steel: fine grooves around the shaft spread what it mirrors along it.
  vec3 turned = vec3(modelPoint.xy * kGrooveAround, modelPoint.z * kGrooveRate);
  vec3 footprint = fwidth(turned);
  float grooves = noise(turned).w * (1.0 - smoothstep(0.35, 0.95, footprint.z));
  vec3 mirror = reflect(
      -toLens, normalize(normal + kGrooveSlope * grooves * normalize(normalMatrix[2])));
  float lamp = max(dot(mirror, toLight), 0.0);
  // The surroundings, blurred. Only what lies ahead of the lens is lit; behind it is the dark
  // cavity.
  vec3 around = max(surround + mirror.x * slopeRight + mirror.y * slopeUp + mirror.z * slopeBack,
                    kLeastAround * surround);
  vec3 grey = mix(around, vec3(dot(around, vec3(kLumaRed, kLumaGreen, kLumaBlue))), kGreyShare);
  float ahead = smoothstep(kDarkFrom, kLitFrom, -mirror.z);
  float grazing = pow(1.0 - seen, kEdgePower);
  float glint = pow(lamp, kGlintPower);
  vec3 linear =
      steel * (grey * (mix(kDark, kLit, ahead) + kEdgeGain * grazing) +
               lightColour * light *
                   (kSteelDiffuse * facing * facing + kStreak * pow(lamp, kStreakPower) +
                    kSteelGlint * glint + kSteelClip * glint * glint * glint * glint));
#endif
  float height = heightOverRelief(contactPoint);
  linear *= contactLight(height);
  vec3 root = sqrt(max(linear, vec3(0.0))), root2 = sqrt(root);
  vec3 shown = kGammaRoots.x * root + kGammaRoots.y * root2 + kGammaRoots.z * sqrt(root2);
  shown = shoulder(max(shown, vec3(0.0))) * softRim(lensR) * coverage;
#ifdef TISSUE
  gl_FragData[0] = vec4(shown, contactShare(height));
#else
  // Steel beside the lens is far out of focus: it passes into what is behind it.
  gl_FragData[0] = vec4(shown, contactShare(height) * min(outline, 1.0) *
                                   smoothstep(kGoneAt, kSolidFrom, lensDistance));
#endif
