// Constants of how a model looks.
const float kBackOfLens = 2.42;    // 2 * 1.1^2: directions beyond 1.1 window radii are not drawn
const float kMostOffPlace = 0.12;  // window radii
#ifdef TISSUE
const float kFineRate = 1100.0;                    // 1/m, of the fine noise
const float kFineSlope = 0.022, kCoarseSlope = 0.014;  // tilts of the normal
const float kFineTint = 0.02, kCoarseTint = 0.04;  // shares of the colour
const vec3 kPatchTint = vec3(1.0, 0.96, 0.92);     // colour factor of the warmest patches
const vec3 kCutColour = vec3(0.86, 0.80, 0.62);    // cut face: paler than the skin, yellowish
const float kCutStreaks = 0.10, kCutShare = 0.75;
const vec3 kScattered = vec3(0.95, 0.70, 0.58);    // light through tissue that faces away, warmer
// Film of fluid: a broad sheen, a small glint, and the surroundings at grazing angles.
const float kWetSheen = 0.05, kWetGlint = 0.5;
const float kMirrored = 0.03, kGrazing = 0.35;
#else
const float kRingDistance = 0.005;                 // m, between the etched rings
const float kFirstRing = 0.9, kLastRing = 4.5;     // rings from the tip, four of them
const float kRingHalf = 0.03, kRingHalfSoft = 0.045;  // half their width, in ring distances
const float kRingDark = 0.85;
// Brushed steel mirrors the joint in grey, mostly at its edges, and the lamp as a streak.
const float kGreyShare = 0.75;
const float kSkyLeast = 0.26, kSkyGain = 0.7, kEdgeGain = 0.5, kEdgePower = 3.0;
const float kSteelDiffuse = 0.24;
const float kStreak = 0.36, kStreakPower = 4.0, kSteelGlint = 1.2, kGlintPower = 40.0;
#endif
// The power 1/2.2, to 0.002, as a sum of the 2nd, 4th and 8th root.
const vec3 kGammaRoots = vec3(0.585122381, 0.783140355, -0.368262736);
