// Half-open rectangle of pixels, for work on a part of a map.
#pragma once

#include <algorithm>

#include "simulation/scene/image.h"

namespace arthro {

// Empty: nothing.
struct PixelBounds {
  int left = 0, top = 0, right = 0, bottom = 0;
  bool is_empty() const { return left >= right || top >= bottom; }
  int width() const { return right - left; }
  int height() const { return bottom - top; }
  friend bool operator==(const PixelBounds&, const PixelBounds&) = default;
};

// Smallest rectangle around both.
inline PixelBounds Joined(const PixelBounds& a, const PixelBounds& b) {
  if (a.is_empty()) return b;
  if (b.is_empty()) return a;
  return {std::min(a.left, b.left), std::min(a.top, b.top), std::max(a.right, b.right),
          std::max(a.bottom, b.bottom)};
}

// `margin` px larger on each side, within a map of that size.
inline PixelBounds Grown(const PixelBounds& box, int margin, int width, int height) {
  return {std::max(0, box.left - margin), std::max(0, box.top - margin),
          std::min(width, box.right + margin), std::min(height, box.bottom + margin)};
}

// Smallest rectangle around the values whose bytes differ between two maps; all of them where the
// sizes differ.
PixelBounds DifferenceOf(const DepthMap& before, const DepthMap& after);

}  // namespace arthro
