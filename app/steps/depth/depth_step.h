// Step 2: keeps the document's depth map that of its panorama and options: a small preview while a
// slider moves, the full map once it is let go, both in a thread of their own.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "app/state/command.h"
#include "app/steps/depth/depth_board.h"
#include "app/steps/depth/depth_cache.h"
#include "app/steps/depth/import_depth.h"
#include "app/steps/depth/touch_probe.h"
#include "authoring/depth/depth_histogram.h"

namespace arthro::app {

struct Ui;

struct DepthStep {
  explicit DepthStep(std::function<void()> wake) : preview_jobs(std::move(wake)) {}

  DepthCache cache;
  Jobs preview_jobs;
  authoring::DepthOptions in_work;           // options of the map that preview_jobs computes
  authoring::SharedStrokes strokes_in_work;  // strokes of that map
  std::function<void(EditorState&)> when_ready;
  DepthBoard board;
  std::optional<DepthImport> import;
  std::string import_words;  // meaning of the file; empty: to be read
  TouchPreview touch;
  // Histogram of the map that the options make, and what it was made from.
  std::optional<authoring::DepthHistogram> histogram;
  std::weak_ptr<const ColourImage> histogram_of;
  authoring::DepthOptions histogram_options;
};
// Share of the backdrop's distance that a relief may reach.
inline constexpr double kMostRelief = 0.95;

std::span<const Command> DepthCommands();
void DepthPanel(Ui& ui, EditorState& state);

// Nothing happens while the depth map is an imported one: MakeDepth says that it may be replaced.
void SetDepthOptions(EditorState& state, const authoring::DepthOptions& options,
                     const std::string& what);
// Puts a depth map that is made from the picture in the place of the imported one.
void MakeDepth(EditorState& state);

// Smaller levels of the panorama, made when they are first wanted.
const authoring::DepthPreview& PyramidOf(EditorState& state);

// Histogram of the present options, from a small level; nothing where they contradict each other.
const std::optional<authoring::DepthHistogram>& DepthHistogramOf(EditorState& state);

// Starts the work that is wanted, if any. Once a frame; returns at once.
void KeepDepthFresh(EditorState& state);

// Takes over what ended. Shows a fault beside the sliders, not in a dialog: the next value may
// be valid. True when something changed.
bool FinishDepth(EditorState& state);

// The map is being made or is about to be.
bool DepthIsUnderWay(const EditorState& state);

// Runs `then` once the depth map is that of the options: now, or after the work.
void WhenDepthIsReady(EditorState& state, std::function<void(EditorState&)> then);

}  // namespace arthro::app
