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
// Luma above the black level from which a part is lit, and the share of lit parts of a usual
// picture. Where the footage ends there is only the veil: ranks over the whole window would make
// half of a small lit part white.
constexpr float kLit = 0.08f;
constexpr double kUsuallyLit = 0.9;
constexpr double kMostGain = 2.0;
constexpr double kMostBlack = 0.3;     // a brighter veil stays grey
constexpr double kLeastCounted = 0.1;  // share of the parts

// At least one level counts: the last one from the rank 1 on.
double MeanOfRanks(const std::vector<float>& sorted, double from, double to) {
  const auto last = static_cast<double>(sorted.size());
  const auto begin = std::min(static_cast<std::size_t>(from * last), sorted.size() - 1);
  const auto end = std::max(begin + 1, static_cast<std::size_t>(to * last));
  double sum = 0;
  for (std::size_t i = begin; i < end; ++i) sum += sorted[i];
  return sum / static_cast<double>(end - begin);
}

}  // namespace

CameraExposure ExposureOf(std::span<const MeteredPart> parts) {
  std::vector<float> dark, bright;
  for (const MeteredPart& part : parts) {
    if (!part.counts) continue;
    const float luma = static_cast<float>(kLumaRed) * part.rgb.r +
                       static_cast<float>(kLumaGreen) * part.rgb.g +
                       static_cast<float>(kLumaBlue) * part.rgb.b;
    dark.push_back(luma);
    bright.push_back(glm::mix(luma, std::max({part.rgb.r, part.rgb.g, part.rgb.b}), kChannelShare));
  }
  if (static_cast<double>(dark.size()) < kLeastCounted * static_cast<double>(parts.size()) ||
      dark.empty())
    return {};
  std::sort(dark.begin(), dark.end());
  std::sort(bright.begin(), bright.end());
  const double black = std::min(MeanOfRanks(dark, kBlackFrom, kBlackTo), kMostBlack);
  double lit = 0;
  for (const float luma : dark)
    lit += static_cast<double>(glm::smoothstep(0.0f, kLit, luma - static_cast<float>(black)));
  // Fewer of the brightest parts count, in proportion to those that are lit.
  const double share = std::min(lit / (kUsuallyLit * static_cast<double>(dark.size())), 1.0);
  const double white =
      MeanOfRanks(bright, 1 - share * (1 - kWhiteFrom), 1 - share * (1 - kWhiteTo));
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
