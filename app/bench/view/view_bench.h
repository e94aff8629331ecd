// Speed against error of the arthroscopic view: what a frame takes, by the search for the relief,
// the looks at the panorama a pixel, resolution, size of the panorama, and what is in the picture;
// beside it how far the picture is from the ray tracer in double precision (where a ray ends, and
// in what colour) or, for the looks, how far the lines of a grid are from the closed form. Wall
// clock is what a user waits; processor time is of all threads, which is what software rendering
// takes. All but the times is the same in every run on one renderer.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "app/bench/view/traced_agreement.h"
#include "simulation/core/options.h"
#include "simulation/core/progress.h"
#include "tests/support/view/grid_picture.h"

namespace arthro::app {

struct ViewBenchOptions {
  int frames = 60;
  int size = 1024;
  int panorama = 4096;
  int triangles = 100000;
  int pixels = 3000;
  template <class V>
  void Visit(V&& v) {
    v("frames", frames, Range{2, 100000}, "", "Frames that are timed a row.");
    v("size", size, Range{64, 4096}, "px", "Side of the larger picture; the other has half of it.");
    v("panorama", panorama, Range{256, 16384}, "px",
      "Width of the larger panorama; the other has a quarter of it.");
    v("triangles", triangles, Range{200, 2000000}, "",
      "Of the finer tissue; the other has a fifth of it.");
    v("pixels", pixels, Range{1, 1000000}, "",
      "Random pixels of a picture that are held against the ray tracer.");
  }
};

struct FrameTimes {
  double wall = 0, wall_p99 = 0;  // s a frame; the median, and the 99th percentile
  double cpu = 0, cpu_p99 = 0;
};

struct ViewBenchRow {
  std::string part;   // "relief", "stairs", "samples" or "scene"
  std::string words;  // "64 steps, cells of 8"
  int size = 0, panorama = 0;
  ReliefSearch relief;
  int samples = 2;
  int triangles = 0;  // of tissue that moves in every frame
  FrameTimes times;
  std::optional<TracedAgreement> traced;    // of relief and scene; a lit scene's without colours
  std::optional<test::GridAgreement> grid;  // of samples
};

struct ViewBench {
  ViewBenchOptions options;
  std::string drawn_by;  // the renderer
  std::vector<ViewBenchRow> rows;
};

// Throws Error(kDisplay) where nothing can draw.
ViewBench RunViewBench(const ViewBenchOptions& options, const Progress& progress);

std::string TableOf(const ViewBench& bench);
nlohmann::json JsonOf(const ViewBench& bench);
// SVG: share of the pixels that end elsewhere, over the frame's time. The grid's rows have another
// error and are left out.
std::string PlotOf(const ViewBench& bench);

}  // namespace arthro::app
