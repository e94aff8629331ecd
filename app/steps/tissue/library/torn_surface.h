// Surface of a tissue after cuts, closed, and that of a meniscus whose bucket handle is displaced.
// Used by the window and by the job `model`. m, own frame.
#pragma once

#include <span>

#include "authoring/models/meniscus_tear.h"
#include "simulation/core/progress.h"

namespace arthro::app {

// `removed`: volume of the slots, m³; may be null. Throws Error(kBadMesh) for an open surface.
SurfaceMesh TornSurface(const SurfaceMesh& surface, std::span<const Cut> cuts,
                        std::span<const Ball> fixed, double* removed);

// Simplified to what a tissue needs. Throws as TearCuts and WithDisplacedHandle do.
SurfaceMesh DisplacedHandle(const SurfaceMesh& surface, const authoring::TearOptions& tear,
                            std::span<const Ball> fixed, double* removed, const Progress& progress);

}  // namespace arthro::app
