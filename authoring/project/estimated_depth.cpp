#include "authoring/project/estimated_depth.h"

#include <utility>

#include "authoring/depth/depth_filter.h"
#include "authoring/depth/noise/depth_noise.h"
#include "authoring/depth/strokes/mend_depth.h"

namespace arthro::authoring {

EstimatedDepth EstimateDepth(const ColourImage& panorama, const DepthOptions& options,
                             const SharedStrokes& strokes, const Backdrop& backdrop,
                             const Progress& progress) {
  const DepthStrokes& drawn = OrEmpty(strokes);
  MendedDepth mended;
  mended.relief = DepthFromColour(panorama, options, nullptr, progress,
                                  MarksOf(drawn, panorama.width, panorama.height));
  mended.sigma = NoiseOfDepth(mended.relief, options.texture_size);
  ReplayStrokes(drawn, {panorama, backdrop.projection, backdrop.radius}, mended);
  EstimatedDepth estimated{Share(std::move(mended.relief)), nullptr};
  if (!mended.sigma.empty()) estimated.sigma = Share(std::move(mended.sigma));
  return estimated;
}

void SetEstimatedDepth(Document& document, const EstimatedDepth& estimated) {
  SetDepth(document, estimated.depth);
  Backdrop& backdrop = document.scene.backdrop;
  if (backdrop.depth.empty()) backdrop.depth = "depth.tiff";
  document.depth_sigma = estimated.sigma;
  if (!estimated.sigma)
    backdrop.depth_sigma.clear();
  else if (backdrop.depth_sigma.empty())
    backdrop.depth_sigma = "depth-sigma.tiff";
}

ReliefOrigin UnstatedOrigin(const Document& document) {
  return document.depth && !document.is_depth_imported ? ReliefOrigin::kBrightness
                                                       : ReliefOrigin::kMeasured;
}

}  // namespace arthro::authoring
