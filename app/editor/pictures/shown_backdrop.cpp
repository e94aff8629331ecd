#include "app/editor/pictures/shown_backdrop.h"

#include "app/state/edits.h"
#include "app/steps/depth/depth_step.h"
#include "app/steps/portals/portals_step.h"
#include "app/steps/portals/reach_board.h"
#include "app/view/exposure/footage_light.h"

namespace arthro::app {

std::shared_ptr<const DrawnRelief> ShownBackdrop::ReliefOf(const ReliefWork::Source& source,
                                                           bool is_shown) {
  if (auto made = work_.Find(source)) {
    awaited_.reset();
    return made;
  }
  const ReliefMaps after{*source.depth, *source.sigma};
  if (is_shown) {
    const ReliefMaps before{OrEmpty(depth_), OrEmpty(sigma_)};
    const auto changed = relief_ ? SmallChange(before, after) : std::nullopt;
    if (!changed) return nullptr;
    awaited_ = source;
    return std::make_shared<const DrawnRelief>(
        WithShift(*relief_, source.panorama_size, before, after, source.backdrop, *changed));
  }
  awaited_ = source;
  return std::make_shared<const DrawnRelief>(MakeDrawnRelief(
      source.panorama_size, after.depth, after.sigma, source.backdrop, ReliefNoise::kKept));
}

bool ShownBackdrop::Take(const EditorState& state, ArthroscopicView& scope, Overview& overview) {
  const authoring::Document& document = state.document();
  const DepthCache& cache = state.steps.depth->cache;
  const bool preview = cache.preview && cache.preview_panorama;
  const auto& panorama = preview ? cache.preview_panorama : document.panorama;
  const auto& depth = preview ? cache.preview : document.depth;
  const std::shared_ptr<const DepthMap> sigma = preview ? nullptr : document.depth_sigma;
  const DepthMap& relief = OrEmpty(depth);
  const Backdrop& wanted = document.scene.backdrop;
  const bool as_filmed = state.steps.portals->shows_as_filmed && !state.practice;
  const bool same_place = backdrop_ == wanted && as_filmed == as_filmed_;
  const std::shared_ptr<const ColourImage> reach = ReachPictureOf(state);
  const bool same_reach = reach == reach_;
  const bool same_panorama = panorama == panorama_ && panorama;
  const bool same_depth = depth == depth_ && sigma == sigma_;
  const bool same_scene = panorama == panorama_ && same_depth && same_place;
  if (same_scene && same_reach) return TakeQuietRelief(scope);
  Backdrop shown = WithKnownLight(wanted, relief);
  if (as_filmed) shown.relight = 0;
  if (preview)
    shown.projection =
        Shrunk(shown.projection, static_cast<double>(document.panorama->width) / panorama->width);
  // The panorama is by far the most to upload; a slider changes only its place or the relief.
  const bool is_kept = same_scene || (same_panorama && scope.SetGeometry(shown));
  if (!is_kept || !same_depth) {
    std::shared_ptr<const DrawnRelief> made;
    if (panorama && depth && sigma) {
      const bool is_shown = shown_of_ == document.panorama && same_place && same_reach;
      made = ReliefOf({depth, sigma, {panorama->width, panorama->height}, shown}, is_shown);
      if (!made) return false;
    } else {
      awaited_.reset();
    }
    relief_ = made;
  }
  panorama_ = panorama;
  shown_of_ = document.panorama;
  depth_ = depth;
  sigma_ = sigma;
  backdrop_ = wanted;
  as_filmed_ = as_filmed;
  reach_ = reach;
  if (!panorama) return true;
  const ColourImage& coloured = reach && !preview ? *reach : *panorama;
  if (!is_kept)
    scope.SetBackdrop(*panorama, relief, shown, OrEmpty(sigma), relief_.get());
  else if (!same_depth)
    scope.SetDepth(relief, OrEmpty(sigma), relief_.get());
  if (is_kept && same_reach)
    overview.SetRelief(relief, shown);
  else
    overview.SetBackdrop(coloured, relief, shown);
  return true;
}

// The relief that was shown with its noise is shown without it once that is removed.
bool ShownBackdrop::TakeQuietRelief(ArthroscopicView& scope) {
  if (!awaited_) return false;
  const auto made = work_.Find(*awaited_);
  if (!made) return false;
  awaited_.reset();
  relief_ = made;
  scope.SetDepth(OrEmpty(depth_), OrEmpty(sigma_), made.get());
  return true;
}

}  // namespace arthro::app
