#include "app/view/backdrop/colour_outlines.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace arthro::app {
namespace {

constexpr float kLeastStep = 10.0f;    // levels of luma between neighbouring texels
constexpr float kLeastCrease = 8e-5f;  // m, second difference of the relief
// Standard errors of a texel that a crease has to exceed. The error of a second difference is 2.4
// of them, and noise exceeds four times that in one of ten thousand texels.
constexpr float kCreasesOfError = 10.0f;
constexpr int kBeside = 2;   // texels beside a crease that are averaged too
constexpr int kWindow = 4;   // texels on either side in which the direction is found
constexpr int kReach = 8;    // texels along the crease, on either side
constexpr float kFade = 32;  // twice the variance of the weights along it, texels²
// Share of the change of the luma that lies across the crease, from which there is a direction.
constexpr float kLeastCoherence = 0.6f;

class Smoother {
 public:
  Smoother(const ColourImage& panorama, const DepthMap& depth, bool whole_turn,
           const DepthMap& sigma)
      : from_(panorama), depth_(depth), sigma_(sigma), whole_turn_(whole_turn) {}

  // Texels beside a crease, in the order of the rows.
  std::vector<std::uint8_t> Marks() const {
    std::vector<std::uint8_t> marks(depth_.relief.size(), 0);
    for (int y = 1; y + 1 < depth_.height; ++y)
      for (int x = whole_turn_ ? 0 : 1; x < depth_.width - (whole_turn_ ? 0 : 1); ++x)
        if (IsCrease(x, y, 1, 0) || IsCrease(x, y, 0, 1))
          for (int j = -kBeside; j <= kBeside; ++j)
            for (int i = -kBeside; i <= kBeside; ++i)
              if (y + j >= 0 && y + j < depth_.height && (whole_turn_ || IsColumn(x + i)))
                marks[Texel(x + i, y + j)] = 1;
    return marks;
  }

  // Returns whether the luma has a direction there, and the mean colour along it.
  bool MeanAlong(int x, int y, std::array<float, 3>& mean) const {
    float xx = 0, xy = 0, yy = 0;
    for (int j = -kWindow; j <= kWindow; ++j)
      for (int i = -kWindow; i <= kWindow; ++i) {
        const float u = Luma(x + i + 1, y + j) - Luma(x + i - 1, y + j),
                    v = Luma(x + i, y + j + 1) - Luma(x + i, y + j - 1);
        const float weight = std::exp(-static_cast<float>(i * i + j * j) / (kWindow * kWindow));
        xx += weight * u * u, xy += weight * u * v, yy += weight * v * v;
      }
    const float spread = std::hypot(xx - yy, 2 * xy);
    if (!(spread > kLeastCoherence * (xx + yy))) return false;
    const float across = 0.5f * std::atan2(2 * xy, xx - yy);
    const float du = -std::sin(across), dv = std::cos(across);
    mean = {};
    float sum = 0;
    for (int k = -kReach; k <= kReach; ++k) {
      const auto way = static_cast<float>(k);
      const float weight = std::exp(-way * way / kFade);
      AddBilinear(static_cast<float>(x) + way * du, static_cast<float>(y) + way * dv, weight, mean);
      sum += weight;
    }
    for (float& channel : mean) channel /= sum;
    return true;
  }

 private:
  bool IsColumn(int x) const { return x >= 0 && x < depth_.width; }
  // Columns wrap or are clamped; rows are clamped.
  std::size_t Texel(int x, int y) const {
    const int width = depth_.width;
    const int column = whole_turn_ ? ((x % width) + width) % width : std::clamp(x, 0, width - 1);
    return static_cast<std::size_t>(std::clamp(y, 0, depth_.height - 1)) *
               static_cast<std::size_t>(width) +
           static_cast<std::size_t>(column);
  }
  float Luma(int x, int y) const {
    const std::uint8_t* rgb = &from_.rgb[3 * Texel(x, y)];
    return 0.299f * rgb[0] + 0.587f * rgb[1] + 0.114f * rgb[2];
  }
  bool IsCrease(int x, int y, int i, int j) const {
    const std::size_t here = Texel(x, y);
    const float bend = std::abs(depth_.relief[Texel(x - i, y - j)] - 2 * depth_.relief[here] +
                                depth_.relief[Texel(x + i, y + j)]);
    // Comparisons with an unknown depth (NaN) are false.
    if (!(bend >= kLeastCrease)) return false;
    if (!sigma_.empty() && !(bend >= kCreasesOfError * sigma_.relief[here])) return false;
    const float luma = Luma(x, y);
    return std::max(std::abs(Luma(x - i, y - j) - luma), std::abs(Luma(x + i, y + j) - luma)) >=
           kLeastStep;
  }
  void AddBilinear(float x, float y, float weight, std::array<float, 3>& sum) const {
    const float left = std::floor(x), top = std::floor(y);
    const int i = static_cast<int>(left), j = static_cast<int>(top);
    const float f = x - left, g = y - top;
    for (const int v : {0, 1})
      for (const int u : {0, 1}) {
        const std::uint8_t* rgb = &from_.rgb[3 * Texel(i + u, j + v)];
        const float share = weight * (u == 1 ? f : 1 - f) * (v == 1 ? g : 1 - g);
        for (std::size_t c = 0; c < 3; ++c) sum[c] += share * rgb[c];
      }
  }

  const ColourImage& from_;
  const DepthMap &depth_, &sigma_;
  bool whole_turn_;
};

}  // namespace

void SmoothColourOutlines(ColourImage& panorama, const DepthMap& depth, bool whole_turn,
                          const DepthMap& sigma) {
  if (depth.empty() || depth.width != panorama.width || depth.height != panorama.height) return;
  const ColourImage stairs = panorama;
  const Smoother smoother(stairs, depth, whole_turn, sigma);
  const std::vector<std::uint8_t> marks = smoother.Marks();
  std::array<float, 3> mean{};
  for (int y = 0; y < panorama.height; ++y)
    for (int x = 0; x < panorama.width; ++x) {
      const std::size_t texel =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(panorama.width) +
          static_cast<std::size_t>(x);
      if (marks[texel] == 0 || !smoother.MeanAlong(x, y, mean)) continue;
      for (std::size_t c = 0; c < 3; ++c)
        panorama.rgb[3 * texel + c] = static_cast<std::uint8_t>(std::lround(mean[c]));
    }
}

}  // namespace arthro::app
