#include "app/state/settings/picture_zoom.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>

namespace arthro::app {
namespace {

constexpr double kNotch = 1.2;  // zoom a notch
constexpr double kMostZoom = 24;

// Keeps the visible part inside the picture; an axis that fits is centred.
PictureZoom Kept(PictureZoom zoom, const glm::dvec2& frame, const glm::dvec2& picture) {
  const glm::dvec2 size = PlaceOf(zoom, frame, picture).size;
  for (int axis = 0; axis < 2; ++axis) {
    const double half = size[axis] > 0 ? 0.5 * frame[axis] / size[axis] : 1;
    zoom.middle[axis] = half >= 0.5 ? 0.5 : std::clamp(zoom.middle[axis], half, 1.0 - half);
  }
  return zoom;
}

}  // namespace

PicturePlace PlaceOf(const PictureZoom& zoom, const glm::dvec2& frame, const glm::dvec2& picture) {
  if (picture.x <= 0 || picture.y <= 0) return {};
  const double scale = zoom.zoom * std::min(frame.x / picture.x, frame.y / picture.y);
  PicturePlace place;
  place.size = scale * picture;
  place.corner = 0.5 * frame - zoom.middle * place.size;
  return place;
}

PictureZoom Zoomed(const PictureZoom& zoom, double notches, const glm::dvec2& pointer,
                   const glm::dvec2& frame, const glm::dvec2& picture) {
  const PicturePlace place = PlaceOf(zoom, frame, picture);
  if (place.size.x <= 0 || place.size.y <= 0) return zoom;
  const glm::dvec2 under = (pointer - place.corner) / place.size;
  PictureZoom next = zoom;
  next.zoom = std::clamp(zoom.zoom * std::pow(kNotch, notches), 1.0, kMostZoom);
  const glm::dvec2 size = PlaceOf(next, frame, picture).size;
  next.middle = under - (pointer - 0.5 * frame) / size;
  return Kept(next, frame, picture);
}

PictureZoom Dragged(const PictureZoom& zoom, const glm::dvec2& by, const glm::dvec2& frame,
                    const glm::dvec2& picture) {
  const glm::dvec2 size = PlaceOf(zoom, frame, picture).size;
  if (size.x <= 0 || size.y <= 0) return zoom;
  PictureZoom next = zoom;
  next.middle -= by / size;
  return Kept(next, frame, picture);
}

}  // namespace arthro::app
