// Frames of an attempt as bytes of its log: the 32-bit words that changed since the frame before,
// after a mask of them. Every thousandth frame is whole. Values that mostly equal others are kept
// as their difference.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "simulation/training/observe/attempt_frame.h"

namespace arthro::simulation {

// Words of a frame with kMostTargets targets.
inline constexpr std::size_t kFrameWords = 2 * 16 + 14 + 6 * kMostTargets + 2;
// Shares of the targets' regions that were taken, the volume taken elsewhere, rim and contour;
// behind the others in frames in which they changed.
inline constexpr std::size_t kTakenWords = kMostTargets + 3;
using FrameWords = std::array<std::uint32_t, kFrameWords>;
using TakenWords = std::array<float, kTakenWords>;

// Those of a frame before anything was taken.
TakenWords NothingTaken();

class FrameEncoder {
 public:
  // Replaces `bytes`.
  void Encode(const AttemptFrame& frame, std::string& bytes);

 private:
  FrameWords before_{};
  TakenWords taken_ = NothingTaken();
  int since_whole_ = 0;
};

class FrameDecoder {
 public:
  // Returns false for bytes that are no frame.
  bool Decode(std::string_view bytes, AttemptFrame& frame);

 private:
  FrameWords before_{};
  TakenWords taken_ = NothingTaken();
};

}  // namespace arthro::simulation
