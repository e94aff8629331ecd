// Body that replaces VTK's lighting. A fragment whose own direction is outside the window, or
// elsewhere in it, belongs to a triangle that wraps around the back of the lens: it is discarded.
  float lensDistance = length(lensPoint);
  vec2 lensOffset = (gl_FragCoord.xy - windowRadius) / windowRadius;
  float lensR = length(lensOffset);
  vec2 lensPlace = placeInWindow(lensPoint, lensDistance);
  float coverage = rimCoverage(lensR, windowRadius);
  bool behind = lensPoint.z > (kBackOfLens * lensScale * lensScale - 1.0) * lensDistance;
  if (behind || distance(lensPlace, lensOffset) > kMostOffPlace || coverage <= 0.0 ||
      lensDistance < kNearest)
    discard;
  gl_FragDepth = storedDepth(lensDistance);
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
  // Natural unevenness: patches of some millimetres, and a surface that is not quite smooth.
  // normalMatrix is VTK's own uniform.
  vec4 coarse = coarseNoise, fine = noise(modelPoint * kFineRate);
  mat3 lensFromModel = normalMatrix / length(normalMatrix[0]);
  normal = normalize(normal + kFineSlope * (lensFromModel * fine.xyz) + kCoarseSlope * coarse.xyz);
  facing = max(dot(normal, toLight), 0.0);
  shine = max(dot(normal, halfway), 0.0);
  vec3 own = modelColour * (1.0 + kCoarseTint * coarse.w + kFineTint * fine.w) *
             mix(vec3(1.0), kPatchTint, 0.5 + 0.5 * coarse.w);
  own = mix(own, kCutColour * (1.0 + kCutStreaks * fine.w), kCutShare * fresh);
  float wrapped = (facing + kWrap) / (1.0 + kWrap);
  vec3 scattered = mix(kScattered, vec3(1.0), smoothstep(0.0, kWhiteFacing, facing));
  vec3 body = own * scattered * (kAmbient + (1.0 - kAmbient) * wrapped) * lightColour * light;
  float shine2 = shine * shine, shine4 = shine2 * shine2, shine8 = shine4 * shine4;
  float shine64 = shine8 * shine8;
  shine64 *= shine64 * shine64 * shine64;
  float glance = (1.0 - seen) * (1.0 - seen);
  vec3 wet = lightColour * light * (kWetSheen * shine8 * shine4 * shine2 +
                                    kWetGlint * shine64 * shine64 * shine64);
  vec3 mirrored = surround * (kMirrored + kGrazing * glance * glance);
  vec3 linear = (body + mirroredShare * wet) * rodShade(lensPoint) + mirroredShare * mirrored;
#else
  if (-modelPoint.z > rodLength) discard;
  float ring = -modelPoint.z / kRingDistance;
  float etched = etchedRings > 0.5 && ring > kFirstRing && ring < kLastRing
                     ? 1.0 - smoothstep(kRingHalf, kRingHalfSoft, abs(ring - round(ring)))
                     : 0.0;
  vec3 steel = modelColour * (1.0 - kRingDark * etched);
  vec3 mirror = reflect(-toLens, normal);
  float lamp = max(dot(mirror, toLight), 0.0);
  vec3 grey = mix(surround, vec3(dot(surround, vec3(kLumaRed, kLumaGreen, kLumaBlue))),
                  kGreyShare);
  float sky = 0.5 + 0.5 * dot(mirror, normalize(lampPlace));  // the joint's lit side
  vec3 linear =
      steel *
      (grey * (kSkyLeast + kSkyGain * sky * sky + kEdgeGain * pow(1.0 - seen, kEdgePower)) +
       lightColour * light *
           (kSteelDiffuse * facing * facing + kStreak * pow(lamp, kStreakPower) +
            kSteelGlint * pow(lamp, kGlintPower)));
#endif
  vec3 root = sqrt(max(linear, vec3(0.0))), root2 = sqrt(root);
  vec3 shown = kGammaRoots.x * root + kGammaRoots.y * root2 + kGammaRoots.z * sqrt(root2);
  shown = shoulder(max(shown, vec3(0.0))) * softRim(lensR) * coverage;
  gl_FragData[0] = vec4(shown, 1.0);
