#include "app/view/exposure/camera_exposure.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <glm/common.hpp>

#include "app/view/shaders/constants.h"

namespace arthro::app {
namespace {

// Ranks whose mean is the black and the white level.
constexpr double kBlackFrom = 0.005, kBlackTo = 0.03;
constexpr double kWhiteFrom = 0.955, kWhiteTo = 0.985;
// Levels before toe and shoulder at which black and white are shown.
constexpr double kBlackShown = 0.05, kWhiteShown = 1.03;
constexpr float kChannelShare = 0.85f;  // largest channel in the white level; the rest is luma
// Luma above the black level from which a part counts fully in the white level: where the footage
// ends there is only the veil, and a small lit part beside it would be white.
constexpr float kLit = 0.08f;
constexpr double kMostGain = 2.0;
constexpr double kMostBlack = 0.3;     // a brighter veil stays grey
constexpr double kLeastCounted = 0.1;  // share of the parts

struct Level {
  float level = 0, weight = 1;
};

// Mean over a range of ranks, each level as wide as its weight. At least one part's width counts.
double MeanOfRanks(std::vector<Level>& levels, double from, double to) {
  std::ranges::sort(levels, {}, &Level::level);
  double all = 0;
  for (const Level& one : levels) all += one.weight;
  const double begin = from * all, end = std::max(to * all, begin + 1.0);
  double rank = 0, sum = 0, share = 0;
  for (const Level& one : levels) {
    const double within = std::min(rank + one.weight, end) - std::max(rank, begin);
    if (within > 0) sum += within * one.level, share += within;
    rank += one.weight;
  }
  return share > 0 ? sum / share : static_cast<double>(levels.back().level);
}

}  // namespace

CameraExposure ExposureOf(std::span<const MeteredPart> parts) {
  std::vector<Level> dark, bright;
  for (const MeteredPart& part : parts) {
    if (!part.counts) continue;
    const float luma = static_cast<float>(kLumaRed) * part.rgb.r +
                       static_cast<float>(kLumaGreen) * part.rgb.g +
                       static_cast<float>(kLumaBlue) * part.rgb.b;
    dark.push_back({luma});
    bright.push_back(
        {glm::mix(luma, std::max({part.rgb.r, part.rgb.g, part.rgb.b}), kChannelShare), luma});
  }
  if (static_cast<double>(dark.size()) < kLeastCounted * static_cast<double>(parts.size()) ||
      dark.empty())
    return {};
  const double black = std::min(MeanOfRanks(dark, kBlackFrom, kBlackTo), kMostBlack);
  for (Level& one : bright)
    one.weight = glm::smoothstep(0.0f, kLit, one.weight - static_cast<float>(black));
  const double white = MeanOfRanks(bright, kWhiteFrom, kWhiteTo);
  // Neither raises black nor dims a picture that is bright already.
  const double shown = std::min(black, kBlackShown);
  const double gain =
      std::clamp((kWhiteShown - shown) / std::max(white - black, 1e-3), 1.0, kMostGain);
  return {gain, shown - gain * black};
}

double CameraResponse(const CameraExposure& exposure, double stored) {
  double level = exposure.gain * stored + exposure.offset;
  const double below = std::clamp(kToe - level, 0.0, 2 * kToe);
  const double above = std::clamp(level - kShoulder, 0.0, 2 * (1 - kShoulder));
  level += below * below / (4 * kToe) - above * above / (4 * (1 - kShoulder));
  return std::clamp(level, 0.0, 1.0) * std::min(stored / kDarkEnd, 1.0);
}

}  // namespace arthro::app
