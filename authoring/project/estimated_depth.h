// Relief of a document that is made from the brightness of its panorama, with the noise that it
// states [method.md, Depth from brightness].
#pragma once

#include <memory>

#include "authoring/project/document.h"
#include "simulation/core/progress.h"
#include "simulation/scene/relief_origin.h"

namespace arthro::authoring {

struct EstimatedDepth {
  std::shared_ptr<const DepthMap> depth, sigma;  // sigma: null where no noise is stated
};

// The estimate mended by `strokes` (null: none). `backdrop` is the place of the panorama.
EstimatedDepth EstimateDepth(const ColourImage& panorama, const DepthOptions& options,
                             const SharedStrokes& strokes, const Backdrop& backdrop,
                             const Progress& progress);

// Puts it in the place of the document's own depth, with names for the files that have none.
void SetEstimatedDepth(Document& document, const EstimatedDepth& estimated);

// Origin of the depths of a document where it has no map of their origins.
ReliefOrigin UnstatedOrigin(const Document& document);

}  // namespace arthro::authoring
