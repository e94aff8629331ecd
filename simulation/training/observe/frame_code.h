// Frames of an attempt as bytes of its log: the 32-bit words that changed since the frame before,
// after a mask of them. A word is kept as its distance from the one that the two frames before lead
// to, as a number of few bytes, where that makes the frame shorter. Every thousandth frame is
// whole. Values that mostly equal others are kept as their difference.
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
using FrameMask = std::array<std::uint8_t, (kFrameWords + 7) / 8>;

// Those of a frame before anything was taken.
TakenWords NothingTaken();

// Words and mask of the frame before, and words of the one before that.
struct FramesBefore {
  FrameWords words{}, older{};
  FrameMask mask{};
  TakenWords taken = NothingTaken();
};

class FrameEncoder {
 public:
  // Replaces `bytes`.
  void Encode(const AttemptFrame& frame, std::string& bytes);

 private:
  FramesBefore before_;
  std::string values_;
  int since_whole_ = 0;
};

class FrameDecoder {
 public:
  // Returns false for bytes that are no frame. Reads the frames of the first logs too, whose values
  // are whole words after a mask of their own.
  bool Decode(std::string_view bytes, AttemptFrame& frame);

 private:
  FramesBefore before_;
};

}  // namespace arthro::simulation
