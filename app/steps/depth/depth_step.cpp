#include "app/steps/depth/depth_step.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "app/state/edits.h"
#include "authoring/depth/depth_filter.h"
#include "authoring/depth/depth_preview.h"
#include "authoring/depth/noise/depth_noise.h"
#include "authoring/depth/strokes/mend_depth.h"
#include "simulation/core/same_options.h"
#include "simulation/core/units.h"
#include "simulation/haptics/relief/relief_smoothing.h"
#include "simulation/scene/shrunk_projection.h"

namespace arthro::app {
namespace {

using authoring::Document;

// Up to so many pixels a preview is shown on the panorama as it is, its relief stretched to it:
// handing over a relief of that size takes less than a frame. Larger panoramas are shown small
// meanwhile.
constexpr int kMostStretched = 1 << 22;

DepthMap Stretched(const DepthMap& small, int width, int height, int factor) {
  DepthMap large(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      large.at(x, y) =
          small.at(std::min(x / factor, small.width - 1), std::min(y / factor, small.height - 1));
  return large;
}

// A small picture and its relief, at the speed of the slider.
Jobs::Work PreviewWork(const Document& document,
                       const std::shared_ptr<const authoring::DepthPreview>& pyramid) {
  return [panorama = document.panorama, options = document.depth_options,
          strokes = document.depth_strokes, backdrop = document.scene.backdrop,
          pyramid](const Progress&) -> Jobs::Apply {
    const auto made =
        pyramid ? pyramid : std::make_shared<const authoring::DepthPreview>(*panorama);
    const ColourImage& level = made->Picture();
    Backdrop small = backdrop;
    small.projection = Shrunk(backdrop.projection, made->Factor());
    const authoring::DepthStrokes& drawn = OrEmpty(strokes);
    authoring::MendedDepth mended;
    mended.relief = made->Filter(options, nullptr, authoring::DepthPreview::kMostPixels,
                                 authoring::MarksOf(drawn, level.width, level.height));
    authoring::ReplayStrokes(drawn, {level, small.projection, small.radius}, mended);
    DepthMap relief = std::move(mended.relief);
    // Without its noise, as the picture draws the whole map; here this does not hold up the window.
    relief = simulation::WithoutNoise(
        relief, authoring::NoiseOfDepth(relief, options.texture_size / made->Factor()), small);
    std::shared_ptr<const ColourImage> picture = panorama;
    if (panorama->width * panorama->height <= kMostStretched)
      relief = Stretched(relief, panorama->width, panorama->height, made->Factor());
    else
      picture = std::make_shared<const ColourImage>(made->Picture());
    auto depth = std::make_shared<const DepthMap>(std::move(relief));
    return [=](EditorState& state) {
      DepthCache& cache = state.steps.depth->cache;
      cache.pyramid = made;
      cache.pyramid_of = panorama;
      if (state.document().panorama != panorama) return;
      cache.preview = depth;
      cache.preview_panorama = picture;
      cache.preview_options = options;
      cache.preview_strokes = strokes;
    };
  };
}

void TakeMadeBefore(const EditorState& state, Document& next) {
  const authoring::EstimatedDepth made = state.steps.depth->cache.Find(next);
  if (made.depth) SetEstimatedDepth(next, made);
}

Jobs::Work FullWork(const Document& document) {
  return [panorama = document.panorama, options = document.depth_options,
          strokes = document.depth_strokes,
          backdrop = document.scene.backdrop](const Progress& progress) -> Jobs::Apply {
    const authoring::EstimatedDepth depth =
        authoring::EstimateDepth(*panorama, options, strokes, backdrop, progress);
    return [=](EditorState& state) {
      // The author may have gone on meanwhile; then this depth belongs to nothing.
      const Document& now = state.document();
      if (now.panorama != panorama || now.depth_strokes != strokes ||
          !SameOptions(now.depth_options, options))
        return;
      Document next = now;
      SetEstimatedDepth(next, depth);
      state.history.Amend(std::move(next));
      state.steps.depth->cache.Note(state.document());
    };
  };
}

}  // namespace

bool FinishDepth(EditorState& state) {
  if (!state.steps.depth->preview_jobs.busy()) return false;
  try {
    state.steps.depth->preview_jobs.Finish(state);
  } catch (const Error& error) {
    // Stopped: other options are wanted now. Otherwise the depth stays what it was.
    if (error.code() != Code::kCancelled &&
        SameOptions(state.steps.depth->in_work, state.document().depth_options))
      state.steps.depth->cache.Refuse(state.document(), error.what());
  }
  return !state.steps.depth->preview_jobs.busy();
}

bool DepthIsUnderWay(const EditorState& state) {
  return state.steps.depth->preview_jobs.busy() ||
         state.steps.depth->cache.IsStale(state.document());
}

void KeepDepthFresh(EditorState& state) {
  DepthCache& cache = state.steps.depth->cache;
  const Document& document = state.document();
  if (!cache.IsStale(document)) {
    cache.preview.reset();
    cache.preview_panorama.reset();
    if (state.steps.depth->when_ready) std::exchange(state.steps.depth->when_ready, {})(state);
    return;
  }
  if (const auto made = cache.Find(document); made.depth) {  // after undo: computed before
    Document next = document;
    SetEstimatedDepth(next, made);
    state.history.Amend(std::move(next));
    return;
  }
  const auto has_preview = [&] {
    return cache.preview && cache.pyramid_of.lock() == document.panorama &&
           cache.preview_strokes == document.depth_strokes &&
           SameOptions(cache.preview_options, document.depth_options);
  };
  if (state.steps.depth->preview_jobs.busy()) {
    // Full-size work for options that changed meanwhile is of no use.
    if (state.steps.depth->strokes_in_work != document.depth_strokes ||
        !SameOptions(state.steps.depth->in_work, document.depth_options))
      state.steps.depth->preview_jobs.Stop();
    return;
  }
  try {
    authoring::CheckDepthOptions(document.depth_options);
  } catch (const Error& error) {
    if (cache.ProblemOf(document).empty() || !state.dragging) cache.Refuse(document, error.what());
    return;
  }
  state.steps.depth->in_work = document.depth_options;
  state.steps.depth->strokes_in_work = document.depth_strokes;
  if (!has_preview()) {
    const bool usable = cache.pyramid && cache.pyramid_of.lock() == document.panorama;
    state.steps.depth->preview_jobs.Start("Depth preview",
                                          PreviewWork(document, usable ? cache.pyramid : nullptr));
  } else if (!state.dragging) {
    state.steps.depth->preview_jobs.Start("Depth", FullWork(document));
  }
}

void WhenDepthIsReady(EditorState& state, std::function<void(EditorState&)> then) {
  if (!state.steps.depth->cache.IsStale(state.document())) return then(state);
  state.dragging = false;
  state.steps.depth->when_ready = std::move(then);
}

const authoring::DepthPreview& PyramidOf(EditorState& state) {
  DepthCache& cache = state.steps.depth->cache;
  const auto& panorama = state.document().panorama;
  if (!cache.pyramid || cache.pyramid_of.lock() != panorama) {
    cache.pyramid = std::make_shared<const authoring::DepthPreview>(*panorama);
    cache.pyramid_of = panorama;
  }
  return *cache.pyramid;
}

const std::optional<authoring::DepthHistogram>& DepthHistogramOf(EditorState& state) {
  DepthStep& step = *state.steps.depth;
  const Document& document = state.document();
  if (step.histogram && step.histogram_of.lock() == document.panorama &&
      SameOptions(step.histogram_options, document.depth_options))
    return step.histogram;
  constexpr int kPixels = 1 << 15;  // a few ms
  authoring::DepthReport report;
  step.histogram.reset();
  try {
    PyramidOf(state).Filter(document.depth_options, &report, kPixels);
    step.histogram = report.histogram;
    step.histogram_of = document.panorama;
    step.histogram_options = document.depth_options;
  } catch (const Error&) {
    // The page says what is wrong with the options.
  }
  return step.histogram;
}

void SetDepthOptions(EditorState& state, const authoring::DepthOptions& options,
                     const std::string& what) {
  if (SameOptions(options, state.document().depth_options)) return;
  // Relief stands out of the backdrop towards the incision and must not reach it. An older scene
  // may hold such a relief; its other options stay free.
  const double radius = state.document().scene.backdrop.radius;
  const double most = kMostRelief * radius;
  const double before = std::max(state.document().depth_options.near_relief,
                                 state.document().depth_options.far_relief);
  if (const double relief = std::max(options.near_relief, options.far_relief);
      relief > most && relief > before) {
    state.message = fmt::format(
        "A relief of {:.1f} mm was refused: the backdrop lies {:.1f} mm from the incision, so the "
        "tissue may stand out by {:.1f} mm at most.",
        MmFromMetres(relief), MmFromMetres(radius), MmFromMetres(most));
    return;
  }
  if (state.document().is_depth_imported) {
    state.message = "The imported depth map is kept. Make one from the picture to change it.";
    return;
  }
  Edit(state, "Depth: " + what, "depth." + what, [&](auto& next) {
    next.depth_options = options;
    // A map that was made before for these options is used again at once.
    TakeMadeBefore(state, next);
  });
}

void MakeDepth(EditorState& state) {
  const authoring::Document& document = state.document();
  if (!document.panorama || !document.is_depth_imported) return;
  Edit(state, "Replace the imported depth map", "", [&](auto& next) {
    next.is_depth_imported = false;
    next.unmended = {};
    TakeMadeBefore(state, next);
  });
}

}  // namespace arthro::app
