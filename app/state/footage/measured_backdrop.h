// A measured relief as the backdrop of a scene: the picture over it, its standard error and the
// origin of each depth. One way from a measurement to a document, for jobs and for the window.
#pragma once

#include <memory>
#include <optional>

#include "authoring/project/document.h"
#include "authoring/relief/make/make_relief.h"
#include "simulation/scene/image.h"
#include "simulation/scene/lens.h"
#include "simulation/scene/projection.h"

namespace arthro::app {

// All maps have the size of the panorama. No sigma, no origin: they are not known.
struct MeasuredBackdrop {
  std::shared_ptr<const ColourImage> panorama;
  std::shared_ptr<const DepthMap> depth, sigma;
  std::shared_ptr<const OriginMap> origin;
  Projection projection;
  double radius = 0;  // m
};

// Opaque colours, black at unobserved pixels.
ColourImage OnBlack(const authoring::RgbaPicture& picture);

// The maps at the size of the picture. Everything is null where the result has no picture.
MeasuredBackdrop BackdropOf(const authoring::ReliefResult& result);

// Another depth map of the same panorama, kept as it is from then on.
void PutMeasuredDepth(authoring::Document& document, const MeasuredBackdrop& measured);
// Depth and panorama. Without a lens the scope keeps the lens that it has.
void PutMeasuredPanorama(authoring::Document& document, const MeasuredBackdrop& measured,
                         const std::optional<Lens>& lens);

// A scene that can be practised in as it is. `result` must have a picture.
authoring::Document DocumentFromRelief(const authoring::ReliefResult& result,
                                       const std::optional<Lens>& lens, double view_angle);

}  // namespace arthro::app
