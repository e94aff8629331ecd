#include "authoring/project/estimated_depth.h"

#include <utility>

#include "authoring/depth/depth_filter.h"
#include "authoring/depth/depth_noise.h"

namespace arthro::authoring {

EstimatedDepth EstimateDepth(const ColourImage& panorama, const DepthOptions& options,
                             const Progress& progress) {
  EstimatedDepth estimated{Share(DepthFromColour(panorama, options, nullptr, progress)), nullptr};
  DepthMap sigma = NoiseOfDepth(*estimated.depth, options.texture_size);
  if (!sigma.empty()) estimated.sigma = Share(std::move(sigma));
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

}  // namespace arthro::authoring
