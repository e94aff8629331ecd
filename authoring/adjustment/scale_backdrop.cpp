#include "authoring/adjustment/scale_backdrop.h"

#include <algorithm>
#include <utility>

#include "authoring/alignment/placing_notes.h"
#include "authoring/relief/editing/relief_scale.h"
#include "simulation/core/error.h"

namespace arthro::authoring {

void ScaleStrokes(Document& document, double factor) {
  for (auto* map : {&document.unmended.depth, &document.unmended.sigma})
    if (*map) *map = Share(ScaledMap(**map, factor));
  if (!document.depth_strokes) return;
  DepthStrokes strokes = *document.depth_strokes;
  for (DepthStroke& stroke : strokes)
    stroke.amount = std::min(kHighestStroke, factor * stroke.amount);
  document.depth_strokes = Share(std::move(strokes));
}

double ScaleBackdrop(Document& document, const KnownLength& length) {
  const ColourImage& panorama = OrEmpty(document.panorama);
  if (panorama.empty())
    throw Error(Code::kBadScene, "there is no panorama yet; import one before it is scaled");
  Backdrop& backdrop = document.scene.backdrop;
  // A bare sphere has no relief. An estimated relief counts as it is: what is not measured has no
  // other length.
  const DepthMap bare = document.depth ? DepthMap() : DepthMap(panorama.width, panorama.height);
  const DepthMap& relief = document.depth ? *document.depth : bare;
  const OriginMap& origin = OrEmpty(document.depth_origin);
  const double factor = ScaleFromLength({relief, OrEmpty(document.depth_sigma), origin,
                                         backdrop.projection, backdrop.radius},
                                        length)
                            .factor;
  backdrop.radius *= factor;
  if (document.depth) {
    const auto sigma = document.depth_sigma ? Share(ScaledMap(*document.depth_sigma, factor))
                                            : std::shared_ptr<const DepthMap>();
    document.depth = Share(ScaledMap(*document.depth, factor));
    document.depth_sigma = sigma;
    // The same map, were it made anew.
    document.depth_options.near_relief *= factor;
    document.depth_options.far_relief *= factor;
    ScaleStrokes(document, factor);
  }
  for (Tissue& tissue : document.scene.tissues) tissue.pose.position *= factor;
  MoveNotes(document.scene, [&](const glm::dvec3& x) { return factor * x; });
  return factor;
}

}  // namespace arthro::authoring
