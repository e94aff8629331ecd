#include "app/view/disturbances/murk_field.h"

#include <algorithm>
#include <cmath>

#include <glm/vec2.hpp>

namespace arthro::app {
namespace {

// Cells of noise across the window.
constexpr float kNearCells = 2.6f, kFarCells = 5.2f, kDewCells = 11.0f;
constexpr float kFinerDew = 2.7f;  // cells of finer drops per cell of drops

// 0 to 1.
float Lattice(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
  std::uint32_t h = x * 0x8da6b343u + y * 0xd8163841u + z * 0xcb1ab31fu;
  h = (h ^ (h >> 15)) * 0x2c1b3c6du;
  h = (h ^ (h >> 12)) * 0x297a2d39u;
  return static_cast<float>((h ^ (h >> 15)) >> 8) * (1.0f / 16777215.0f);
}

// Value noise of one z over a rectangle, 0 to 1, smooth in all three coordinates. The corners of
// the cells are made once, already mixed along z, since the places between are many more.
class NoisePlane {
 public:
  // `from`, `to`: the least and the largest x and y.
  NoisePlane(const glm::vec2& from, const glm::vec2& to, float z)
      : left_(CellOf(from.x)),
        low_(CellOf(from.y)),
        width_(CellOf(to.x) - left_ + 2),
        height_(CellOf(to.y) - low_ + 2) {
    const float cell = std::floor(z), f = z - cell, u = Smooth(f);
    const auto k = static_cast<std::uint32_t>(static_cast<std::int32_t>(cell));
    for (int y = low_; y < low_ + height_; ++y)
      for (int x = left_; x < left_ + width_; ++x) {
        const auto i = static_cast<std::uint32_t>(x), j = static_cast<std::uint32_t>(y);
        corners_.push_back(std::lerp(Lattice(i, j, k), Lattice(i, j, k + 1), u));
      }
  }
  float At(const glm::vec2& p) const {
    const glm::vec2 q = p - glm::vec2(left_, low_);
    const int x = std::clamp(static_cast<int>(q.x), 0, width_ - 2),
              y = std::clamp(static_cast<int>(q.y), 0, height_ - 2);
    const float u = Smooth(q.x - static_cast<float>(x)), v = Smooth(q.y - static_cast<float>(y));
    const float* below = corners_.data() + y * width_ + x;
    const float* above = below + width_;
    const float low = below[0] + (below[1] - below[0]) * u,
                high = above[0] + (above[1] - above[0]) * u;
    return low + (high - low) * v;
  }

 private:
  static int CellOf(float x) { return static_cast<int>(std::floor(x)); }
  static float Smooth(float f) { return f * f * (3.0f - 2.0f * f); }

  int left_, low_, width_, height_;
  std::vector<float> corners_;
};

// Clouds with wisps: three octaves of noise at places displaced by noise, as fluid folds what it
// carries. Mean about 1/2.
class Clouds {
 public:
  Clouds(const glm::vec2& from, const glm::vec2& to, float z)
      : fold_x_(from + kFoldX, to + kFoldX, z + 3),
        fold_y_(from + kFoldY, to + kFoldY, z + 11),
        cloud_(from - kMost, to + kMost, z),
        finer_(2.1f * (from - kMost) + kFiner, 2.1f * (to + kMost) + kFiner, 2.1f * z + 23),
        finest_(4.3f * (from - kMost) + kFinest, 4.3f * (to + kMost) + kFinest, 4.3f * z + 7) {}
  float DensityAt(const glm::vec2& p) const {
    const glm::vec2 shifted =
        p + kFold * glm::vec2(fold_x_.At(p + kFoldX) - 0.5f, fold_y_.At(p + kFoldY) - 0.5f);
    const float sum = 0.55f * cloud_.At(shifted) + 0.29f * finer_.At(2.1f * shifted + kFiner) +
                      0.16f * finest_.At(4.3f * shifted + kFinest);
    return std::clamp(0.5f + 1.7f * (sum - 0.5f), 0.0f, 1.0f);
  }

 private:
  static constexpr float kFold = 1.7f, kMost = 1.0f;  // over half of kFold
  static constexpr glm::vec2 kFoldX{31, 7}, kFoldY{5, 47}, kFiner{17, 3}, kFinest{2, 41};

  NoisePlane fold_x_, fold_y_, cloud_, finer_, finest_;
};

std::uint8_t Byte(float share) {
  return static_cast<std::uint8_t>(std::lround(255.0f * std::clamp(share, 0.0f, 1.0f)));
}

}  // namespace

std::vector<std::uint8_t> MurkField(int seed, double time) {
  std::vector<std::uint8_t> texels;
  texels.reserve(std::size_t{4} * kMurkSize * kMurkSize);
  // Each seed has its own part of an endless noise; the fluid drifts and turns over slowly.
  const glm::vec2 part(static_cast<float>(seed % 1009) * 13.0f,
                       static_cast<float>((seed / 1009) % 1009) * 29.0f);
  const auto t = static_cast<float>(time);
  const glm::vec2 near_start = part + t * glm::vec2(0.11f, -0.04f),
                  far_start = part + t * glm::vec2(0.07f, 0.05f);
  const Clouds near(near_start, near_start + kNearCells, 0.17f * t),
      far(far_start, far_start + kFarCells, 40.0f + 0.13f * t);
  const glm::vec2 dew_start = kDewCells * part, dew_end = dew_start + kDewCells;
  const NoisePlane dew(dew_start, dew_end, 90.0f),
      finer_dew(kFinerDew * dew_start, kFinerDew * dew_end, kFinerDew * 90.0f);
  for (int j = 0; j < kMurkSize; ++j)
    for (int i = 0; i < kMurkSize; ++i) {
      const glm::vec2 at((static_cast<float>(i) + 0.5f) / kMurkSize,
                         (static_cast<float>(j) + 0.5f) / kMurkSize);
      const glm::vec2 drop = dew_start + kDewCells * at;
      texels.push_back(Byte(near.DensityAt(near_start + kNearCells * at)));
      texels.push_back(Byte(far.DensityAt(far_start + kFarCells * at)));
      texels.push_back(Byte(0.6f * dew.At(drop) + 0.4f * finer_dew.At(kFinerDew * drop)));
      texels.push_back(255);
    }
  return texels;
}

}  // namespace arthro::app
