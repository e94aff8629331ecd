#include "authoring/adjustment/crop_backdrop.h"

#include <algorithm>
#include <memory>
#include <vector>

#include <fmt/format.h>

#include "simulation/core/error.h"

namespace arthro::authoring {
namespace {

// The part of a row-major picture of `width` px with `values` per pixel.
template <class T>
std::vector<T> Part(const std::vector<T>& whole, int width, int values, const PixelBox& box) {
  std::vector<T> part;
  part.reserve(static_cast<std::size_t>(box.width) * box.height * values);
  for (int y = box.y; y < box.y + box.height; ++y) {
    const auto row = whole.begin() + (static_cast<std::ptrdiff_t>(y) * width + box.x) * values;
    part.insert(part.end(), row, row + static_cast<std::ptrdiff_t>(box.width) * values);
  }
  return part;
}

std::shared_ptr<const DepthMap> Part(const std::shared_ptr<const DepthMap>& map,
                                     const PixelBox& box) {
  if (!map) return nullptr;
  DepthMap part;
  part.width = box.width;
  part.height = box.height;
  part.relief = Part(map->relief, map->width, 1, box);
  return Share(std::move(part));
}

std::shared_ptr<const OriginMap> Part(const std::shared_ptr<const OriginMap>& map,
                                      const PixelBox& box) {
  if (!map) return nullptr;
  OriginMap part(box.width, box.height);
  part.origin = Part(map->origin, map->width, 1, box);
  return Share(std::move(part));
}

// Points and radius of a stroke are shares of the picture's width.
SharedStrokes Part(const SharedStrokes& strokes, int width, const PixelBox& box) {
  if (!strokes) return nullptr;
  DepthStrokes moved = *strokes;
  const double zoom = static_cast<double>(width) / box.width;
  const glm::dvec2 corner(static_cast<double>(box.x) / width, static_cast<double>(box.y) / width);
  for (DepthStroke& stroke : moved) {
    stroke.radius = std::min(1.0, zoom * stroke.radius);
    for (glm::dvec2& point : stroke.points) point = zoom * (point - corner);
  }
  return Share(std::move(moved));
}

}  // namespace

void CropBackdrop(Document& document, const PixelBox& box) {
  const ColourImage& whole = OrEmpty(document.panorama);
  if (whole.empty())
    throw Error(Code::kBadScene, "there is no panorama yet; import one before it is cropped");
  if (box.x < 0 || box.y < 0 || box.width < kLeastCrop || box.height < kLeastCrop ||
      box.x > whole.width - box.width || box.y > whole.height - box.height)
    throw Error(
        Code::kBadArgument,
        fmt::format("the part {} x {} px at ({}, {}) does not lie in the panorama of {} x "
                    "{} px, or is less than {} px wide; choose another part",
                    box.width, box.height, box.x, box.y, whole.width, whole.height, kLeastCrop));
  const int width = whole.width;
  ColourImage part(box.width, box.height);
  part.rgb = Part(whole.rgb, whole.width, 3, box);
  document.panorama = Share(std::move(part));
  const auto sigma = Part(document.depth_sigma, box);
  const auto origin = Part(document.depth_origin, box);
  document.depth = Part(document.depth, box);
  document.depth_sigma = sigma;
  document.depth_origin = origin;
  UnmendedDepth& unmended = document.unmended;
  unmended.depth = Part(unmended.depth, box);
  unmended.sigma = Part(unmended.sigma, box);
  unmended.origin = Part(unmended.origin, box);
  document.scene.backdrop.projection.centre_px -= glm::dvec2(box.x, box.y);
  document.depth_strokes = Part(document.depth_strokes, width, box);
  if (!document.footage) return;
  // The report goes on to describe the whole panorama.
  FootageRecord record = *document.footage;
  PixelBox now = box;
  if (record.is_mirrored) now.x = width - box.x - box.width;
  if (record.crop) {
    now.x += record.crop->x;
    now.y += record.crop->y;
  }
  record.crop = now;
  document.footage = Share(std::move(record));
}

}  // namespace arthro::authoring
