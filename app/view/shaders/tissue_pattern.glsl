// Structure of a tissue in its own coordinates at rest: `grain` along the fibres, across them and
// through the tissue. Every part fades before it is finer than a pixel, so that nothing crawls.
// FIBRES: a crescent of circumferential fibres. HYALINE: a smooth plate.
// Needs uniforms, which VTK declares (lens_model.cpp): vec3 tint, cutTint, edgeTint, rimTint,
// rootTint, vesselColour; lookShares: vessels, fibres, fibrillation; lookMeasures: width of a fibre
// bundle in m, factor of the gloss; grainAxis: the plate's normal in the model's frame.

struct Pattern {
  vec3 tint;     // factor of the colour
  float height;  // m
  float vessel;  // share of a capillary
  float gloss;
};

// Returns the share that is left of a noise in these coordinates: none where a pixel spans a cell.
float visible(vec3 cells) {
  vec3 step = fwidth(cells);
  return 1.0 - smoothstep(0.35, 0.95, max(step.x, max(step.y, step.z)));
}

// Tilts a normal by the slope of a height over the picture [Mikkelsen 2010].
vec3 tilted(vec3 normal, float height) {
  vec3 right = dFdx(lensPoint), up = dFdy(lensPoint);
  vec3 byRight = cross(up, normal), byUp = cross(normal, right);
  float area = dot(right, byRight);
  vec3 slope = sign(area) * (dFdx(height) * byRight + dFdy(height) * byUp);
  return normalize(abs(area) * normal - slope);
}

const float kPatch = 0.05;               // share of the colour of patches of some millimetres
const float kFineRate = 1100.0;          // 1/m
const float kFineHeight = 7e-6;          // m
const float kFineTint = 0.025;

#ifdef FIBRES
const float kAlong = 9.0;                // length of a bundle in its widths
const float kBundleHeight = 0.145, kBundleTint = 0.16;  // in its widths; share of the colour
const float kEdge = 0.30;                // share of the width that the free edge is pale
const float kRedFrom = 0.38, kRedTo = 0.85;
const float kRedUneven = 0.16;
const float kStemApart = 2.6e-3;         // m along the rim from one capillary to the next
const float kVesselHalf = 46e-6;         // m, half the largest width of a capillary
const float kTaper = 0.25;               // share of its width at an end
const float kWanderRate = 650.0, kWander = 5e-4;  // 1/m; m to the side
const float kFork = 1.2e-3, kForkSlope = 0.25;    // m to the side at the end; slope of a branch
const float kCutHeight = 0.3, kCutTint = 0.34;           // bundles that a cut opens
const float kFibril = 3.3, kFibrilTint = 0.14;           // fibrils per bundle; share of the colour
#endif

#ifdef FIBRES
// Returns the share of capillaries: stems that enter at the rim, wander, taper and fork twice.
// `inwards` is 0 at the rim and 1 where the red zone ends; `pixel` in m.
float capillaries(float inwards, float pixel) {
  float share = 0.0;
  int here = int(floor(grain.x / kStemApart));
  for (int i = here - 1; i <= here + 1; ++i) {
    float size = lattice(ivec3(i, 0, 0));
    if (size < -0.35) continue;
    float stem = kStemApart * (float(i) + 0.5 + 0.42 * lattice(ivec3(i, 1, 0)));
    vec4 wander = noise(vec3(17.3 * float(i), kWanderRate * grain.yz));
    float bend = kWander * kWanderRate * length(wander.yz);
    for (int branch = 0; branch < 3; ++branch) {
      float chance = 0.5 + 0.5 * lattice(ivec3(i, 2, branch));
      float begin = branch == 0 ? -1.0 : 0.1 + 0.35 * chance;
      float end = branch == 0 ? 0.6 + 0.4 * chance : begin + 0.3 + 0.25 * chance;
      if (inwards < begin || inwards > end) continue;
      float side = branch == 0 ? 0.0 : branch == 1 ? 1.0 : -1.0;
      float gone = side * max(inwards - begin, 0.0);
      float aside = kFork * gone * (1.6 - abs(gone));
      float away = abs(grain.x - stem - kWander * wander.w - aside) /
                   length(vec3(1.0, bend, side * kForkSlope));
      float left = min((end - inwards) / (end - max(begin, 0.0)), 1.0);
      float halfWidth = kVesselHalf * (branch == 0 ? 1.0 : 0.6) * (0.75 + 0.25 * size) *
                        mix(kTaper, 1.0, left);
      float line = 1.0 - smoothstep(0.4 * halfWidth, 1.4 * halfWidth + pixel, away);
      share = max(share, line * smoothstep(0.0, 0.35, left));
    }
  }
  return share;
}
#endif

#ifdef HYALINE
// Clouds of a millimetre and of less than half of one, as in the cartilage of a phantom.
const float kCloudRate = 770.0, kMottleRate = 2300.0;  // 1/m
const float kCloudTint = 0.035, kMottleTint = 0.064;
#endif

Pattern patternAt(vec3 normal) {
  Pattern p;
  float fresh = step(0.5, marks.z);
  vec3 cells = grain * kFineRate;
  float seen = visible(cells);
  float fine = seen > 0.0 ? noise(cells).w * seen : 0.0;
  p.tint = tint * (1.0 + kPatch * coarseNoise + kFineTint * fine);
  p.height = kFineHeight * fine;
  p.vessel = 0.0;
  p.gloss = lookMeasures.y;
#ifdef FIBRES
  float rim = marks.x, root = marks.y;
  // Bundles bend by a bundle's width over some millimetres, and their strength comes and goes.
  vec3 waved = grain + lookMeasures.x * vec3(0.0, 2.0, 1.0) * coarseNoise;
  vec3 bundle = waved / lookMeasures.x * vec3(1.0 / kAlong, 1.0, 1.0);
  float bundleSeen = visible(bundle);
  float strand = bundleSeen > 0.0 ? noise(bundle).w * bundleSeen : 0.0;
  vec3 broad = waved / lookMeasures.x * vec3(0.3 / kAlong, 0.31, 0.31);
  float sheaf = noise(broad).w * visible(broad);
  float strength = lookShares.y * (0.55 + 0.45 * coarseNoise);
  float groove = mix(strand + 0.7 * sheaf, 1.0 - 2.0 * abs(strand), 0.6 * fresh);
  p.tint *= 1.0 + lookShares.y * mix(kBundleTint * strength, kCutTint, fresh) * groove;
  p.height += lookMeasures.x * bundleSeen *
              mix(kBundleHeight * strength, kCutHeight * lookShares.y, fresh) * groove;
  // The ends of torn fibrils on the face of a cut.
  vec3 fibrils = bundle * vec3(1.0, kFibril, kFibril);
  float torn = fresh > 0.0 ? fresh * lookShares.y * noise(fibrils).w * visible(fibrils) : 0.0;
  p.tint *= 1.0 + kFibrilTint * torn;
  p.height += 0.05 * lookMeasures.x * torn;
  // Free edge, vascular rim and roots.
  p.tint *= mix(edgeTint, vec3(1.0), smoothstep(0.0, kEdge, rim + 0.05 * sheaf));
  float red = lookShares.x *
              smoothstep(kRedFrom, kRedTo, rim + kRedUneven * coarseNoise + 0.05 * sheaf);
  p.tint *= mix(vec3(1.0), rimTint, red);
  p.tint *= mix(vec3(1.0), rootTint, root);
  if (red > 0.02) {
    float pixel = length(fwidth(grain));
    p.vessel = red * capillaries((1.0 - rim) / (1.0 - kRedFrom), pixel) *
               (1.0 - smoothstep(40e-6, 160e-6, pixel));
  }
  p.gloss *= 1.0 - 0.5 * fresh;
#elif defined(HYALINE)
  float border = marks.x, side = marks.y;
  vec3 cloud = grain * kCloudRate, mottle = grain * kMottleRate;
  float cloudSeen = visible(cloud), mottleSeen = visible(mottle);
  p.tint *= 1.0 + (cloudSeen > 0.0 ? kCloudTint * cloudSeen * noise(cloud).w : 0.0) +
            (mottleSeen > 0.0 ? kMottleTint * mottleSeen * noise(mottle).w : 0.0);
  p.tint *= mix(vec3(1.0), edgeTint, border * border);
  p.tint *= mix(vec3(1.0), rootTint, side);
  if (lookShares.z > 0.0) {
    vec3 velvet = grain * vec3(2600.0, 5200.0, 5200.0);
    float velvetSeen = visible(velvet);
    float fray = velvetSeen > 0.0 ? noise(velvet + 2.0 * coarseNoise).w * velvetSeen : 0.0;
    float worn = lookShares.z * smoothstep(-0.2, 0.5, coarseNoise);
    p.height += 45e-6 * worn * fray;
    p.tint *= 1.0 + 0.16 * worn * fray;
    p.gloss *= 1.0 - 0.6 * worn;
  }
#endif
  p.tint *= mix(vec3(1.0), cutTint, fresh);
  return p;
}
