// A pixel's intersection with the relief, from its cell (relief_cells.glsl). Relief thinner than a
// cell that no corner's ray meets may be missed. One loop does all, and ends with the values at the
// last place. Most pixels run it once, with the one texture read that they need anyway; pixels on
// the side of a step run it three times more, for the relief around them. The break stands at the
// end because a software rasteriser runs the body once more for a break at the beginning.
const float kPaceTexels = 2.0;  // texels of the relief per step, at least
const float kMostPace = 0.25;   // share of the search range
const float kStartGap = 1e-3;   // behind the relief at either end, until it is computed
const float kCloseSteps = 12.0; // steps that remain to refine a crossing
// Refinements at most, and the gap to the relief at which they end. The side of a step is so steep
// that four of them left a pixel anywhere on it: its outline was a comb of light and dark pixels.
const float kMostClosed = 9.0;
const float kCloseGap = 2e-5;
const float kSideShare = 0.8;   // times kSide^2; from here on the relief around is read
float meetReliefByCells(vec3 ray, float sphere, out vec3 x, out vec2 uv, out bool imaged,
                        out vec4 ground, out vec3 looks) {
  vec2 place = gl_FragCoord.xy / cellPixels;
  vec4 cell = texelFetch(cells, ivec2(place), 0);
  vec2 f = fract(place);
  bool searches = cell.x < 0.0;
  float t = searches ? cell.y : mix(mix(cell.x, cell.y, f.x), mix(cell.z, cell.w, f.x), f.y);
  float end = min(cell.z, sphere), range = end - cell.y;
  float pace = max(range / cellSteps,
                   min(kPaceTexels / texelsPerRadius(tip + t * ray, ray), kMostPace * range));
  float low = t, high = end, gapLow = -kStartGap, gapHigh = kStartGap;
  float left = searches ? cellSteps + kCloseSteps : 0.0, closed = 0.0;
  float asks = 0.0;  // reads of the relief around that remain: further up, below, above
  vec2 up = vec2(0.0);
  looks = vec3(0.0);
  while (true) {
    bool isLook = asks > 0.0;
    x = tip + t * ray;
    vec2 there = panoramaPlace(x);
    vec4 found = textureLod(relief,
                            there + (asks > 2.5   ? 1.0
                                     : asks > 1.5 ? -1.0
                                                  : 2.0) *
                                        up,
                            0.0) *
                 vec4(vec3(perRadius), 1.0);
    looks = isLook ? vec3(looks.yz, found.r) : looks;
    uv = there;
    ground = isLook ? ground : found;
    imaged = isImaged(x, uv);
    float gap = (isBefore(x) ? ground.r : 0.0) - 1.0 + length(x);
    bool is = gap >= 0.0;
    high = is ? t : high, gapHigh = is ? gap : gapHigh;
    low = is ? low : t, gapLow = is ? gapLow : gap;
    closed += is || closed > 0.0 ? 1.0 : 0.0;
    bool isClose = closed > kMostClosed || (closed > 0.0 && abs(gap) < kCloseGap);
    left = isClose || (closed == 0.0 && t >= end) ? 0.0 : left - 1.0;
    bool isThere = isLook || left <= 0.0;
    asks = isLook                                                                      ? asks - 1.0
           : isThere && searches && steepness2(x, ground) > kSideShare * kSide * kSide ? 3.0
                                                                                       : 0.0;
    up = asks > 0.0 ? upwards(ground) : up;
    if (isThere && asks <= 0.0) break;
    t = isThere        ? t
        : closed > 0.0 ? mix(low, high, clamp(gapLow / (gapLow - gapHigh), kLeastCut, kMostCut))
                       : min(t + pace, end);
  }
  return t;
}
