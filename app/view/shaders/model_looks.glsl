// Constants of how a model looks, and the diffuse light of a tissue.
const float kBackOfLens = 2.42;    // 2 * 1.1^2: directions beyond 1.1 window radii are not drawn
const float kMostOffPlace = 0.12;  // window radii
#ifdef TISSUE
const float kSoftBorder = 0.75;  // share of the plate's own normal at its border
const float kSoftColour = 0.2, kLeastSurround = 0.02;
const vec3 kScattered = vec3(0.95, 0.70, 0.58);    // light through tissue that faces away, warmer
// Returns the diffuse light of a tissue by its cosine to the lamp.
float diffuse(float facing) {
  return kAmbient + (1.0 - kAmbient) * (facing + kWrap) / (1.0 + kWrap);
}
// Film of fluid: a broad sheen, a small glint, and the surroundings at grazing angles.
const float kWetSheen = 0.05, kWetGlint = 0.5;
const float kMirrored = 0.03, kGrazing = 0.2;
#else
const float kRingDistance = 0.005;                 // m, between the etched rings
const float kFirstRing = 0.9, kLastRing = 4.5;     // rings from the tip, four of them
const float kRingHalf = 0.03, kRingHalfSoft = 0.045;  // half their width, in ring distances
const float kRingDark = 0.85;
// Steel mirrors the joint, half in grey, and the lamp as a streak with a clipped core.
const float kGoneAt = 0.0005, kSolidFrom = 0.002;  // m from the lens
const float kGrooveRate = 9000.0, kGrooveAround = 300.0;  // 1/m
const float kGrooveSlope = 0.022;
const float kGreyShare = 0.7, kLeastAround = 0.25;
// The outline of a rod with 20 sides is drawn as the circle inside it: the squared sine of half the
// angle of a side, and the px that this may cut off.
const float kFacet = 0.0245, kMostFacet = 2.5;
const float kLeastSlope = 1e-6;
// m: middle of the probe's bend (probe_mesh.cpp), and a ball that holds its inner side.
const vec2 kHollow = vec2(1.2e-3, -1.95e-3);
const float kHollowEnd = 1.2e-3, kHollowFades = 1.5e-3;
const float kDarkFrom = -0.55, kLitFrom = 0.75;  // part of the mirrored direction that points ahead
const float kDark = 0.10, kLit = 0.9;
const float kEdgeGain = 0.5, kEdgePower = 4.0;
const float kSteelDiffuse = 0.10;
const float kStreak = 0.34, kStreakPower = 9.0;
const float kSteelGlint = 1.5, kGlintPower = 60.0, kSteelClip = 5.0;
#endif
// The power 1/2.2, to 0.002, as a sum of the 2nd, 4th and 8th root.
const vec3 kGammaRoots = vec3(0.585122381, 0.783140355, -0.368262736);
