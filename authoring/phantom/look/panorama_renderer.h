// Draws the phantom as the panorama of a scene: colours antialiased at silhouettes and creases,
// relief exact at pixel centres.
#pragma once

#include <vector>

#include "authoring/phantom/look/appearance.h"
#include "authoring/phantom/look/tissue_caster.h"
#include "authoring/phantom/look/vessels.h"
#include "authoring/phantom/shape/cavity.h"
#include "simulation/core/progress.h"
#include "simulation/scene/image.h"
#include "simulation/scene/projection.h"

namespace arthro::authoring {

struct PhantomView {
  const Cavity& cavity;
  const VesselTrees& vessels;
  const TissueCaster* tissues = nullptr;  // drawn as well when given
  Look look;
};

struct PhantomPicture {
  ColourImage colour;
  DepthMap depth;  // relief D - distance, rounded to 2⁻²⁰ m (0.95 µm) so that it packs well
  std::vector<Surface> surfaces;  // visible surface at each pixel centre
  std::vector<double> distances;  // m, of the surfaces; empty with tissues
};

// Exposure that makes the cavity's bright parts bright but not white.
double ExposureOf(const PhantomView& view, const Projection& projection, int width, int height);

// Gives the same bytes for any number of threads; 0 takes one per processor. Given the picture of
// the same view without its tissues, only the pixels that they change are coloured again.
PhantomPicture RenderPanorama(const PhantomView& view, const Projection& projection, int width,
                              int height, double exposure, int threads, const Progress& progress,
                              const char* stage, const PhantomPicture* without = nullptr);

}  // namespace arthro::authoring
