#include "app/steps/depth/depth_step.h"

#include <algorithm>
#include <utility>

#include "app/state/edits.h"
#include "authoring/depth/depth_filter.h"
#include "authoring/depth/depth_noise.h"
#include "authoring/depth/depth_preview.h"
#include "simulation/core/same_options.h"
#include "simulation/haptics/relief/relief_smoothing.h"

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
          backdrop = document.scene.backdrop, pyramid](const Progress&) -> Jobs::Apply {
    const auto made =
        pyramid ? pyramid : std::make_shared<const authoring::DepthPreview>(*panorama);
    DepthMap relief = made->Filter(options);
    // Without its noise, as the picture draws the whole map; here this does not hold up the window.
    Backdrop small = backdrop;
    small.projection = Shrunk(backdrop.projection, made->Factor());
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
    };
  };
}

void TakeMadeBefore(const EditorState& state, Document& next) {
  const authoring::EstimatedDepth made = state.steps.depth->cache.Find(next);
  if (made.depth) SetEstimatedDepth(next, made);
}

Jobs::Work FullWork(const Document& document) {
  return [panorama = document.panorama,
          options = document.depth_options](const Progress& progress) -> Jobs::Apply {
    const authoring::EstimatedDepth depth = authoring::EstimateDepth(*panorama, options, progress);
    return [=](EditorState& state) {
      // The author may have gone on meanwhile; then this depth belongs to nothing.
      const Document& now = state.document();
      if (now.panorama != panorama || !SameOptions(now.depth_options, options)) return;
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
           SameOptions(cache.preview_options, document.depth_options);
  };
  if (state.steps.depth->preview_jobs.busy()) {
    // Full-size work for options that changed meanwhile is of no use.
    if (!SameOptions(state.steps.depth->in_work, document.depth_options))
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

void SetDepthOptions(EditorState& state, const authoring::DepthOptions& options,
                     const std::string& what) {
  if (SameOptions(options, state.document().depth_options)) return;
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
    TakeMadeBefore(state, next);
  });
}

namespace {

using State = EditorState;

DepthBoard& BoardOf(State& state) { return state.steps.depth->board; }

bool HasBoard(const State& state) { return Idle(state) && HasPicture(state); }

template <MapTool tool>
void TakeTool(State& state) {
  state.step = Step::kDepth;
  BoardOf(state).is_shown = true;
  BoardOf(state).tool = tool;
}

template <MapLayer layer>
void ShowLayer(State& state) {
  state.step = Step::kDepth;
  BoardOf(state).is_shown = true;
  BoardOf(state).layer = layer;
}

constexpr Command kCommands[] = {
    {"depth-map",
     "Map of the depth",
     "Show the depth over the panorama: its origin, its uncertainty, distances and profiles.",
     "Depth",
     {},
     {},
     HasBoard,
     [](State& state) {
       state.step = Step::kDepth;
       BoardOf(state).is_shown = true;
     }},
    {"depth-scope",
     "Scope view",
     "Show the scene through the scope and from outside.",
     "Depth",
     {},
     {},
     HasBoard,
     [](State& state) { BoardOf(state).is_shown = false; }},
    {"map-origin",
     "Origin",
     "Colour each depth by its origin: measured, estimated from brightness or interpolated.",
     "Depth",
     {},
     {},
     HasBoard,
     ShowLayer<MapLayer::kOrigin>},
    {"map-sigma",
     "Uncertainty",
     "Colour each depth by its standard error.",
     "Depth",
     {},
     {},
     HasBoard,
     ShowLayer<MapLayer::kSigma>},
    {"map-range",
     "Distance",
     "Colour each depth by the distance of the tissue from the portal.",
     "Depth",
     {},
     {},
     HasBoard,
     ShowLayer<MapLayer::kRange>},
    {"map-picture",
     "Picture only",
     "Show the panorama without colours.",
     "Depth",
     {},
     {},
     HasBoard,
     ShowLayer<MapLayer::kPicture>},
    {"map-read",
     "Read a depth",
     "Click on the map: the distance there with its standard error.",
     "Depth",
     {},
     {},
     HasBoard,
     TakeTool<MapTool::kRead>},
    {"map-length",
     "Give a length",
     "Click on two points whose distance is known; it sets the scale of the scene.",
     "Depth",
     {},
     {},
     HasBoard,
     TakeTool<MapTool::kLength>},
    {"map-profile",
     "Profile",
     "Draw a line on the map: the distance of the tissue along it.",
     "Depth",
     {},
     {},
     HasBoard,
     TakeTool<MapTool::kProfile>},
    {"map-brush",
     "Mark as wrong",
     "Paint over depth that is wrong. It is interpolated from its surround instead.",
     "Depth",
     {},
     {},
     HasBoard,
     TakeTool<MapTool::kBrush>},
    {"set-scale",
     "Set the scale",
     "Scale the scene so that the distance between the two points is the length that was given.",
     "Depth",
     {},
     {},
     [](const State& state) { return Idle(state) && CanSetScale(state); },
     SetScale},
    {"forget-lengths",
     "Forget the lengths",
     "Remove the points and the lengths. The scale stays as it is.",
     "Depth",
     {},
     {},
     HasBoard,
     ForgetLengths},
    {"make-depth",
     "Make depth from the picture",
     "Replace the imported depth map by one that is made from the picture. Undo brings it back.",
     "Scene",
     {},
     {},
     [](const State& state) {
       return Idle(state) && HasPicture(state) && state.document().is_depth_imported;
     },
     MakeDepth},
};

}  // namespace

std::span<const Command> DepthCommands() { return kCommands; }

}  // namespace arthro::app
