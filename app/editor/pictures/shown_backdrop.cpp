#include "app/editor/pictures/shown_backdrop.h"

#include "app/state/edits.h"
#include "app/steps/depth/depth_step.h"
#include "app/steps/portals/portals_step.h"
#include "app/steps/portals/reach_board.h"
#include "app/view/backdrop/relief_filling.h"
#include "app/view/exposure/footage_light.h"
#include "simulation/scene/shrunk_projection.h"

namespace arthro::app {

ShownBackdrop::Content ShownBackdrop::ContentOf(const EditorState& state) {
  const authoring::Document& document = state.document();
  const DepthCache& cache = state.steps.depth->cache;
  Content content;
  content.of = content.panorama = document.panorama;
  content.depth = document.depth;
  content.sigma = document.depth_sigma;
  if (cache.preview && cache.preview_panorama) {
    content.panorama = cache.preview_panorama;
    content.depth = cache.preview;
    content.sigma = nullptr;
  }
  content.reach = ReachPictureOf(state);
  content.backdrop = document.scene.backdrop;
  content.is_as_filmed = state.steps.portals->shows_as_filmed && !state.practice;
  return content;
}

Backdrop ShownBackdrop::Drawn(const Content& wanted) {
  Backdrop drawn = WithKnownLight(wanted.backdrop, OrEmpty(wanted.depth));
  if (wanted.is_as_filmed) drawn.relight = 0;
  if (wanted.panorama != wanted.of)
    drawn.projection =
        Shrunk(drawn.projection, static_cast<double>(wanted.of->width) / wanted.panorama->width);
  return drawn;
}

std::shared_ptr<const DrawnRelief> ShownBackdrop::NoisyRelief(const ReliefWork::Source& source,
                                                              bool is_shown) {
  if (auto made = work_.Find(source)) {
    awaited_.reset();
    return made;
  }
  if (is_shown) {
    if (!relief_) return nullptr;
    const ReliefWork::Source before{shown_.depth, shown_.sigma, source.panorama_size,
                                    source.backdrop};
    auto shifted = work_.FindShifted(source, before, relief_);
    if (shifted) awaited_ = source;
    return shifted;
  }
  awaited_ = source;
  return std::make_shared<const DrawnRelief>(MakeDrawnRelief(
      source.panorama_size, *source.depth, *source.sigma, source.backdrop, NoiseRemoval::kRough));
}

bool ShownBackdrop::TakeRelief(const Content& wanted, const Backdrop& drawn) {
  if (!wanted.panorama || !wanted.depth || !wanted.sigma) {
    awaited_.reset();
    relief_ = nullptr;
    return true;
  }
  const bool is_shown =
      shown_.of == wanted.of && shown_.reach == wanted.reach && wanted.HasPlaceOf(shown_);
  auto made = NoisyRelief(
      {wanted.depth, wanted.sigma, {wanted.panorama->width, wanted.panorama->height}, drawn},
      is_shown);
  if (!made) return false;
  relief_ = std::move(made);
  return true;
}

bool ShownBackdrop::Take(const EditorState& state, ArthroscopicView& scope, Overview& overview) {
  const Content wanted = ContentOf(state);
  if (wanted == shown_) return TakeQuietRelief(scope, overview);
  const Backdrop drawn = Drawn(wanted);
  // The panorama is by far the most to upload; a slider changes only its place or the relief.
  const bool has_same_relief = wanted.HasReliefOf(shown_);
  const bool has_same_panorama =
      wanted.panorama && wanted.panorama == shown_.panorama &&
      (has_same_relief ||
       !FillsOthers(*wanted.panorama, OrEmpty(shown_.depth), OrEmpty(wanted.depth)));
  const bool keeps_panorama =
      has_same_panorama &&
      ((has_same_relief && wanted.HasPlaceOf(shown_)) || scope.SetGeometry(drawn));
  if ((!keeps_panorama || !has_same_relief) && !TakeRelief(wanted, drawn)) return false;
  const bool has_same_reach = wanted.reach == shown_.reach;
  shown_ = wanted;
  if (!wanted.panorama) return true;

  const DepthMap &relief = OrEmpty(wanted.depth), &sigma = OrEmpty(wanted.sigma);
  if (!keeps_panorama)
    scope.SetBackdrop(*wanted.panorama, relief, drawn, sigma, relief_.get());
  else if (!has_same_relief)
    scope.SetDepth(relief, sigma, relief_.get());
  const bool is_preview = wanted.panorama != wanted.of;
  const DepthMap& seen = relief_ ? relief_->sampled : relief;
  if (keeps_panorama && has_same_reach)
    overview.SetRelief(seen, drawn);
  else
    overview.SetBackdrop(wanted.reach && !is_preview ? *wanted.reach : *wanted.panorama, seen,
                         drawn);
  return true;
}

// The relief that was shown rough is shown as it is once it has been made.
bool ShownBackdrop::TakeQuietRelief(ArthroscopicView& scope, Overview& overview) {
  if (!awaited_) return false;
  const auto made = work_.Find(*awaited_);
  if (!made) return false;
  awaited_.reset();
  relief_ = made;
  scope.SetDepth(OrEmpty(shown_.depth), OrEmpty(shown_.sigma), made.get());
  overview.SetRelief(made->sampled, Drawn(shown_));
  return true;
}

}  // namespace arthro::app
