// Is it the same value? Parts of a document that edits and pictures compare.
#pragma once

#include "simulation/core/frames.h"
#include "simulation/scene/scene.h"

namespace arthro::app {

inline bool SamePose(const Pose& a, const Pose& b) {
  return a.position == b.position && a.quaternion == b.quaternion && a.scale == b.scale;
}

inline bool SameBackdrop(const Backdrop& a, const Backdrop& b) {
  return a.panorama == b.panorama && a.depth == b.depth && a.radius == b.radius &&
         a.relight == b.relight && a.projection.type == b.projection.type &&
         a.projection.centre_px == b.projection.centre_px &&
         a.projection.focal_px == b.projection.focal_px &&
         a.projection.px_per_deg == b.projection.px_per_deg && a.rights.source == b.rights.source &&
         a.rights.licence == b.rights.licence && a.rights.consent == b.rights.consent;
}

}  // namespace arthro::app
