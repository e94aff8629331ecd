// A measured relief as the backdrop: the picture over it, its standard error and the origin of each
// depth go into the document together, in one step that is undone.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "app/state/editor_state.h"
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
void SetMeasuredPanorama(EditorState& state, const std::string& name,
                         const MeasuredBackdrop& backdrop, const std::optional<Lens>& lens);
// Another depth map of the same panorama, kept as it is from then on.
void SetMeasuredDepth(EditorState& state, const std::string& name,
                      const MeasuredBackdrop& backdrop);

}  // namespace arthro::app
