#include "authoring/panorama/crop_panorama.h"

#include <cstring>

#include <fmt/format.h>

#include "simulation/core/error.h"

namespace arthro::authoring {

void CropPanorama(PanoramaResult& result, const PixelBox& box) {
  RgbaPicture& whole = result.picture;
  if (box.x < 0 || box.y < 0 || box.width < 1 || box.height < 1 ||
      box.x > whole.width - box.width || box.y > whole.height - box.height)
    throw Error(Code::kBadArgument,
                fmt::format("the part {} x {} px at ({}, {}) leaves the panorama of {} x {} px; "
                            "choose a part of it",
                            box.width, box.height, box.x, box.y, whole.width, whole.height));
  RgbaPicture part{box.width, box.height, {}};
  const std::size_t row = 4 * static_cast<std::size_t>(box.width);
  part.rgba.resize(row * static_cast<std::size_t>(box.height));
  for (int y = 0; y < box.height; ++y)
    std::memcpy(&part.rgba[static_cast<std::size_t>(y) * row],
                &whole.rgba[4 * (static_cast<std::size_t>(y + box.y) * whole.width + box.x)], row);
  whole = std::move(part);
  PanoramaReport& report = result.report;
  report.panorama.width = box.width;
  report.panorama.height = box.height;
  report.panorama.cx -= box.x;
  report.panorama.cy -= box.y;
  if (report.over_relief) report.over_relief->centre_px -= glm::dvec2(box.x, box.y);
  for (FrameReport& frame : report.frames) {
    if (frame.component != 0) continue;
    auto& h = frame.panorama_from_rectified;  // row-major
    for (std::size_t column = 0; column < 3; ++column) {
      h[column] -= box.x * h[6 + column];
      h[3 + column] -= box.y * h[6 + column];
    }
  }
}

}  // namespace arthro::authoring
