#include "authoring/panorama/ties/clicked_tie.h"

#include <algorithm>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace arthro::authoring {
namespace {

glm::dmat3 PlaceOf(const FrameReport& frame) {
  const auto& h = frame.panorama_from_rectified;  // row-major; GLM's columns
  return {h[0], h[3], h[6], h[1], h[4], h[7], h[2], h[5], h[8]};
}

bool IsInPanorama(const PanoramaReport& report, const FrameReport& frame) {
  return frame.is_placed && frame.component == 0 &&
         std::none_of(report.tied.begin(), report.tied.end(),
                      [&](const TiedFrame& tied) { return tied.index == frame.index; });
}

}  // namespace

std::optional<TieInFrame> FrameAt(const PanoramaReport& report, const glm::dvec2& panorama_pixel) {
  const PinholeView& view = report.rectified;
  if (report.over_relief || !(view.focal_px > 0)) return std::nullopt;
  std::optional<TieInFrame> nearest;
  double least = 0;
  for (const FrameReport& frame : report.frames) {
    if (!IsInPanorama(report, frame)) continue;
    const glm::dvec3 p = glm::inverse(PlaceOf(frame)) * glm::dvec3(panorama_pixel, 1.0);
    if (!(p.z > 0)) continue;
    const glm::dvec2 rectified = glm::dvec2(p) / p.z;
    const auto raw = PixelFromRay(report.lens, {(rectified.x - view.cx) / view.focal_px,
                                                (rectified.y - view.cy) / view.focal_px, 1.0});
    const Lens& lens = report.lens;
    if (!raw || raw->x < -0.5 || raw->y < -0.5 || raw->x > lens.width - 0.5 ||
        raw->y > lens.height - 0.5)
      continue;
    const glm::dvec2 middle(lens.circle.r > 0 ? lens.circle.cx : lens.cx,
                            lens.circle.r > 0 ? lens.circle.cy : lens.cy);
    const double off = glm::distance(*raw, middle);
    if (lens.circle.r > 0 && off > lens.circle.r) continue;
    if (nearest && off >= least) continue;
    nearest = TieInFrame{frame.index, *raw};
    least = off;
  }
  return nearest;
}

std::optional<glm::dvec2> PanoramaPixelOf(const PanoramaReport& report, const TieInFrame& point) {
  const PinholeView& view = report.rectified;
  const auto ray = RayFromPixel(report.lens, point.pixel);
  if (report.over_relief || !ray || !(ray->z > 0)) return std::nullopt;
  for (const FrameReport& frame : report.frames) {
    if (frame.index != point.frame || !frame.is_placed || frame.component != 0) continue;
    const glm::dvec3 p = PlaceOf(frame) * glm::dvec3(view.cx + view.focal_px * ray->x / ray->z,
                                                     view.cy + view.focal_px * ray->y / ray->z, 1);
    if (p.z > 0) return glm::dvec2(p) / p.z;
  }
  return std::nullopt;
}

}  // namespace arthro::authoring
