#include "app/recording/frame_shape.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "simulation/core/error.h"

namespace arthro::app {
namespace {

constexpr FrameShape kAll[] = {FrameShape::kSquare, FrameShape::k4x3, FrameShape::k16x9};

double Aspect(FrameShape shape) {
  switch (shape) {
    case FrameShape::kSquare:
      return 1.0;
    case FrameShape::k4x3:
      return 4.0 / 3.0;
    case FrameShape::k16x9:
      return 16.0 / 9.0;
  }
  return 1.0;
}

}  // namespace

std::string_view ToString(FrameShape shape) {
  switch (shape) {
    case FrameShape::kSquare:
      return "square";
    case FrameShape::k4x3:
      return "4:3";
    case FrameShape::k16x9:
      return "16:9";
  }
  return "";
}

FrameShape FrameShapeOf(std::string_view word) {
  for (const FrameShape shape : kAll)
    if (word == ToString(shape)) return shape;
  throw Error(Code::kBadArgument,
              fmt::format("there is no layout \"{}\"; write square, 4:3 or 16:9", word));
}

int FrameWidth(FrameShape shape, int height) {
  if (shape == FrameShape::kSquare) return height;
  return 2 * static_cast<int>(std::lround(0.5 * Aspect(shape) * height));
}

ScreenPlace PlaceOnScreen(FrameShape shape, int width, int height) {
  const int edge =
      std::max(0, std::min(height, static_cast<int>(std::floor(width / Aspect(shape) + 1e-9))));
  return {(width - edge) / 2, (height - edge) / 2, edge};
}

ColourImage LaidOut(const ColourImage& picture, FrameShape shape) {
  if (shape == FrameShape::kSquare) return picture;
  ColourImage frame(FrameWidth(shape, picture.height), picture.height);
  const int left = (frame.width - picture.width) / 2;
  for (int y = 0; y < picture.height; ++y)
    std::copy_n(picture.at(0, y), 3 * picture.width, frame.at(left, y));
  return frame;
}

}  // namespace arthro::app
