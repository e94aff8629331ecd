// Speed against error of the arthroscopic view. Times of a frame vary with relief search, samples
// per pixel, resolution, panorama size and picture content. The error is the difference from a ray
// tracer in double precision (end and colour of each ray) or, for samples, the distance of grid
// lines from their closed form. Processor time counts all threads, as software rendering uses them.
// Only the times differ between runs on one renderer.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "app/bench/view/frame_cost.h"
#include "app/bench/view/traced_agreement.h"
#include "simulation/core/options.h"
#include "simulation/core/progress.h"
#include "tests/support/view/grid_picture.h"

namespace arthro::app {

struct ViewBenchOptions {
  int timed_frames = 60;
  int size = 1024;
  int panorama = 4096;
  int triangles = 100000;
  int pixels = 3000;
  template <class V>
  void Visit(V&& v) {
    v("timed_frames", timed_frames, Range{2, 100000}, "", "Frames that are timed per row.");
    v("size", size, Range{64, 4096}, "px", "Side of the larger picture; the other has half of it.");
    v("panorama", panorama, Range{256, 16384}, "px",
      "Width of the larger panorama; the other has a quarter of it.");
    v("triangles", triangles, Range{200, 2000000}, "",
      "Triangles of the finer tissue; the other has a fifth of them.");
    v("pixels", pixels, Range{1, 1000000}, "",
      "Random pixels per picture that are compared with the ray tracer.");
  }
};

struct ViewBenchRow {
  std::string part;   // "relief", "stairs", "samples" or "scene"
  std::string words;  // "64 steps, cells of 8"
  int size = 0, panorama = 0;
  ReliefSearch relief;
  int samples = 2;
  int triangles = 0;  // tissue that moves in every frame
  FrameTimes times;
  std::optional<TracedAgreement> traced;  // parts "relief" and "scene"; no colours for a lit scene
  std::optional<test::GridAgreement> grid;  // part "samples"
};

struct ViewBench {
  ViewBenchOptions options;
  std::string drawn_by;  // the renderer
  std::vector<ViewBenchRow> rows;
  std::vector<FrameCostRow> costs;  // each feature of a moving picture, at both sizes
};

// Throws Error(kDisplay) where nothing can draw.
ViewBench RunViewBench(const ViewBenchOptions& options, const Progress& progress);

std::string TableOf(const ViewBench& bench);
nlohmann::json JsonOf(const ViewBench& bench);
// SVG of the share of pixels whose ray ends elsewhere, over the frame's time. Leaves out the rows
// of the grid, whose error is another one.
std::string PlotOf(const ViewBench& bench);

}  // namespace arthro::app
