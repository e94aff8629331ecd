#include "app/state/measured_depth.h"

#include "app/state/edits.h"
#include "app/state/footage_optics.h"

namespace arthro::app {
namespace {

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
}

}  // namespace

void SetMeasuredPanorama(EditorState& state, const std::string& name,
                         const MeasuredBackdrop& backdrop, const std::optional<Lens>& lens) {
  Edit(state, name, "", [&](auto& next) {
    next.panorama = backdrop.panorama;
    next.scene.backdrop.panorama = "panorama.png";
    next.scene.backdrop.projection = backdrop.projection;
    PutMeasuredDepth(next, backdrop);
    if (lens) TakeFootageLens(next, *lens, false);
  });
}

void SetMeasuredDepth(EditorState& state, const std::string& name,
                      const MeasuredBackdrop& backdrop) {
  Edit(state, name, "", [&](auto& next) { PutMeasuredDepth(next, backdrop); });
}

}  // namespace arthro::app
