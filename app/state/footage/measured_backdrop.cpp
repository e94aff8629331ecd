#include "app/state/footage/measured_backdrop.h"

#include <algorithm>

#include "app/state/footage/footage_optics.h"
#include "app/state/footage/footage_source.h"
#include "authoring/project/every_instrument.h"
#include "authoring/relief/surface/enlarge_relief.h"

namespace arthro::app {

ColourImage OnBlack(const authoring::RgbaPicture& picture) {
  ColourImage image(picture.width, picture.height);
  for (std::size_t i = 0; i < image.rgb.size() / 3; ++i)
    for (std::size_t c = 0; c < 3; ++c)
      image.rgb[3 * i + c] = picture.rgba[4 * i + 3] == 0 ? 0 : picture.rgba[4 * i + c];
  return image;
}

MeasuredBackdrop BackdropOf(const authoring::ReliefResult& result) {
  const int factor = std::max(1, result.picture_scale);
  MeasuredBackdrop backdrop;
  if (result.relief.empty() || result.picture.width != factor * result.relief.width ||
      result.picture.height != factor * result.relief.height)
    return backdrop;
  backdrop.panorama = std::make_shared<const ColourImage>(OnBlack(result.picture));
  // A larger difference between neighbouring cells of half a degree is steeper than 75°.
  constexpr double kStep = 0.035;  // share of the radius
  const auto step = static_cast<float>(kStep * result.report.radius);
  backdrop.depth =
      std::make_shared<const DepthMap>(authoring::EnlargedMap(result.relief, factor, step));
  backdrop.sigma =
      std::make_shared<const DepthMap>(authoring::EnlargedMap(result.sigma, factor, step));
  backdrop.origin =
      std::make_shared<const OriginMap>(authoring::EnlargedMap(result.origin, factor));
  backdrop.projection = authoring::EnlargedProjection(result.report.projection, factor);
  backdrop.radius = result.report.radius;
  return backdrop;
}

void PutMeasuredDepth(authoring::Document& document, const MeasuredBackdrop& measured) {
  SetDepth(document, measured.depth);
  Backdrop& backdrop = document.scene.backdrop;
  backdrop.radius = measured.radius;
  backdrop.depth = "depth.tiff";
  document.depth_sigma = measured.sigma;
  backdrop.depth_sigma = measured.sigma ? "depth-sigma.tiff" : "";
  document.depth_origin = measured.origin;
  backdrop.depth_origin = measured.origin ? "depth-origin.png" : "";
  document.is_depth_imported = true;
  document.depth_strokes = nullptr;  // they mended the map that was there
  document.unmended = {};
}

void PutMeasuredPanorama(authoring::Document& document, const MeasuredBackdrop& measured,
                         const std::optional<Lens>& lens) {
  document.panorama = measured.panorama;
  PutFootage(document, nullptr);  // it tells of the panorama before
  document.scene.backdrop.panorama = "panorama.png";
  document.scene.backdrop.projection = measured.projection;
  PutMeasuredDepth(document, measured);
  if (lens) TakeFootageLens(document, *lens, false);
}

authoring::Document DocumentFromRelief(const authoring::ReliefResult& result,
                                       const std::optional<Lens>& lens, double view_angle) {
  authoring::Document document;
  PutMeasuredPanorama(document, BackdropOf(result), lens);
  document.scene.scope.view_angle = view_angle;
  document.scene.instruments = authoring::EveryInstrument();
  return document;
}

}  // namespace arthro::app
