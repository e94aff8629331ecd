// Part of a picture that its frame on the screen shows: all of it at zoom 1, else a part that the
// wheel and drags choose. Sizes and positions on the screen are in px from the frame's top left.
#pragma once

#include <glm/vec2.hpp>

namespace arthro::app {

struct PictureZoom {
  double zoom = 1;              // 1: the whole picture just fits
  glm::dvec2 middle{0.5, 0.5};  // centre of the visible part, as a share of the picture
};

// Rectangle of the whole picture on the screen.
struct PicturePlace {
  glm::dvec2 corner{0}, size{0};
};
PicturePlace PlaceOf(const PictureZoom& zoom, const glm::dvec2& frame, const glm::dvec2& picture);

// `notches` of the wheel at `pointer`, which stays over the same point of the picture.
PictureZoom Zoomed(const PictureZoom& zoom, double notches, const glm::dvec2& pointer,
                   const glm::dvec2& frame, const glm::dvec2& picture);
PictureZoom Dragged(const PictureZoom& zoom, const glm::dvec2& by, const glm::dvec2& frame,
                    const glm::dvec2& picture);

}  // namespace arthro::app
