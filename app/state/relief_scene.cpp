#include "app/state/relief_scene.h"

#include <limits>
#include <memory>

#include "app/state/footage_optics.h"
#include "authoring/relief/enlarge_relief.h"

namespace arthro::app {
namespace {

std::shared_ptr<const ColourImage> OpaquePicture(const authoring::RgbaPicture& picture) {
  auto image = std::make_shared<ColourImage>(picture.width, picture.height);
  const std::size_t pixels = image->rgb.size() / 3;
  for (std::size_t i = 0; i < pixels; ++i)
    for (std::size_t c = 0; c < 3; ++c)
      image->rgb[3 * i + c] = picture.rgba[4 * i + 3] == 0 ? 0 : picture.rgba[4 * i + c];
  return image;
}

}  // namespace

authoring::Document DocumentFromRelief(const authoring::ReliefResult& result,
                                       const std::optional<Lens>& lens, double view_angle) {
  // A larger difference between neighbouring cells of half a degree is steeper than 75°.
  constexpr double kStep = 0.035;  // share of the radius
  authoring::Document document;
  document.panorama = OpaquePicture(result.picture);
  Backdrop& backdrop = document.scene.backdrop;
  backdrop.panorama = "panorama.png";
  backdrop.depth = "depth.tiff";
  backdrop.depth_sigma = "depth-sigma.tiff";
  backdrop.depth_origin = "depth-origin.png";
  backdrop.radius = result.report.radius;
  backdrop.projection =
      authoring::EnlargedProjection(result.report.projection, result.picture_scale);
  document.depth = std::make_shared<const DepthMap>(authoring::EnlargedMap(
      result.relief, result.picture_scale, static_cast<float>(kStep * result.report.radius)));
  document.depth_sigma = std::make_shared<const DepthMap>(authoring::EnlargedMap(
      result.sigma, result.picture_scale, std::numeric_limits<float>::max()));
  document.depth_origin = std::make_shared<const OriginMap>(
      authoring::EnlargedMap(result.origin, result.picture_scale));
  document.is_depth_imported = true;
  document.scene.scope.view_angle = view_angle;
  document.scene.instruments.push_back({});
  if (lens) TakeFootageLens(document, *lens, false);
  return document;
}

}  // namespace arthro::app
