#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "app/bench/view/view_bench.h"
#include "app/view/backdrop/relief_outlines.h"
#include "app/view/instruments/probe_mesh.h"
#include "app/view/instruments/tool_mesh.h"
#include "app/view/offscreen_context.h"
#include "tests/support/view/view_cases.h"

namespace arthro::app {
namespace {

using namespace test;

constexpr std::array kSearches = {ReliefSearch{0, 1},  ReliefSearch{64, 16}, kUsualRelief,
                                  ReliefSearch{64, 4}, ReliefSearch{64, 1},  ReliefSearch{256, 1}};
constexpr std::array kSamples = {1, 2, 4, 8};
constexpr double kFewer = 0.2;   // share of the triangles of the finer tissue, for most rows
constexpr int kFirstFrames = 5;  // frames, in which drivers compile and upload

// Content of a picture beside the backdrop. `fineness` is the share of the options' triangles.
struct SceneKind {
  const char* words;
  double fineness = 0;
  double relight = 0;
  bool is_disturbed = false;
  simulation::TissueStructure structure = simulation::TissueStructure::kPlain;
};
constexpr std::array kScenes = {SceneKind{"two instruments"},
                                SceneKind{"two instruments, {} triangles", kFewer},
                                SceneKind{"two instruments, {} triangles", 1},
                                SceneKind{"two instruments, {} triangles, lamp", kFewer, 1},
                                SceneKind{"the same, haze and bubbles", kFewer, 1, true},
                                SceneKind{"{} triangles, lamp, as cartilage", kFewer, 1, false,
                                          simulation::TissueStructure::kHyaline},
                                SceneKind{"{} triangles, lamp, as a meniscus", kFewer, 1, false,
                                          simulation::TissueStructure::kFibres}};

// Number of rows, for the progress.
constexpr double kRows = 3 * kSearches.size() + 2 * kSamples.size() + 2 * kScenes.size();
constexpr double kShareOfRows = 0.7;  // share of the time; the cost of the features follows

// No error, rather than an error of 0, where there was nothing to compare.
std::optional<TracedAgreement> Held(const TracedAgreement& agreement) {
  return agreement.compared > 0 ? std::optional(agreement) : std::nullopt;
}
std::optional<GridAgreement> Held(const GridAgreement& agreement) {
  return agreement.crossings > 0 ? std::optional(agreement) : std::nullopt;
}

// Reference relief: with smooth outlines, as it is drawn, but for every pixel. The map's own stairs
// have rows of their own.
LoadedScene WithSmoothOutlines(LoadedScene loaded) {
  DepthMap smooth = *loaded.depth;
  SmoothOutlines(smooth, false);
  loaded.depth = Share(std::move(smooth));
  return loaded;
}

class ViewBenchRun {
 public:
  ViewBenchRun(const ViewBenchOptions& options, const Progress& progress)
      : options_(options), progress_(progress) {
    bench_.options = options;
    bench_.drawn_by = context_.description();
  }
  ViewBench Run() {
    MeasureRelief(options_.panorama, options_.size / 2);
    MeasureRelief(options_.panorama, options_.size);
    MeasureRelief(options_.panorama / 4, options_.size / 2);
    for (const int size : {options_.size / 2, options_.size}) MeasureSamples(size);
    for (const int size : {options_.size / 2, options_.size}) MeasureScenes(size);
    const Progress rest{[this](std::string_view stage, double done) {
                          progress_.Step(stage, kShareOfRows + (1 - kShareOfRows) * done);
                        },
                        progress_.stop};
    bench_.costs = MeasureFrameCosts(
        {options_.timed_frames, options_.panorama,
         static_cast<int>(std::lround(kFewer * options_.triangles)), options_.pixels},
        {options_.size / 2, options_.size}, rest);
    return std::move(bench_);
  }

 private:
  void MeasureRelief(int width, int size);
  void MeasureSamples(int size);
  void MeasureScenes(int size);
  template <class F>
  FrameTimes TimeFrames(const std::string& words, F&& frame);

  ViewBenchOptions options_;
  const Progress& progress_;
  OffscreenContext context_;
  ArthroscopicView view_;  // after the context: it must end first
  ViewBench bench_;
};

template <class F>
FrameTimes ViewBenchRun::TimeFrames(const std::string& words, F&& frame) {
  return DrawInTurns(
             1, options_.timed_frames, std::min(kFirstFrames, options_.timed_frames),
             [&](std::size_t) { frame(); }, [&](std::size_t) { view_.Finish(); },
             [&](double share) {
               progress_.Step(
                   words, kShareOfRows * (static_cast<double>(bench_.rows.size()) + share) / kRows);
             })
      .front()
      .Times();
}

void ViewBenchRun::MeasureRelief(int width, int size) {
  const LoadedScene loaded = WavyJoint(width), smooth = WithSmoothOutlines(loaded);
  view_.SetTissues({}, {});
  view_.SetBackdrop(*loaded.panorama, *loaded.depth, loaded.scene.backdrop);
  Picture plain = ViewOfWavyJoint();
  plain.plain = true;
  plain.samples = 2;
  const std::vector<TracedPixel> traced = TracePixels(smooth, plain, size, options_.pixels);
  const std::vector<TracedPixel> stairs = TracePixels(loaded, plain, size, options_.pixels);
  for (const ReliefSearch& relief : kSearches) {
    plain.relief = relief;
    view_.Render(plain, size);
    const ColourImage colours = view_.ReadPixels();
    const std::vector<float> distances = view_.ReadDistances();
    const TracedAgreement agreement = CompareWithTraced(traced, distances, size, &colours);
    const std::string words = relief.steps == 0
                                  ? std::string("bare sphere")
                                  : fmt::format("{} steps, cells of {}", relief.steps, relief.cell);
    Picture picture = plain;
    picture.plain = false;
    const FrameTimes times = TimeFrames(words, [&] {
      picture.view.tip.x += 1e-7;
      view_.Render(picture, size);
    });
    bench_.rows.push_back(
        {"relief", words, size, width, relief, picture.samples, 0, times, Held(agreement), {}});
    if (relief == kUsualRelief)
      bench_.rows.push_back({"stairs",
                             "the same, by the map's stairs",
                             size,
                             width,
                             relief,
                             picture.samples,
                             0,
                             times,
                             Held(CompareWithTraced(stairs, distances, size, &colours)),
                             {}});
  }
}

void ViewBenchRun::MeasureSamples(int size) {
  GridPanorama grid;
  grid.width = options_.panorama;
  grid.height = grid.width / 2;
  grid.line_sigma = 1.25 * grid.width / options_.size;  // a pixel or two of the smaller picture
  grid.spacing = 25.6 * grid.line_sigma;
  Backdrop backdrop;
  backdrop.projection.centre_px = {(grid.width - 1) / 2.0, (grid.height - 1) / 2.0};
  backdrop.projection.focal_px = 1500.0 * grid.width / 4096;
  view_.SetTissues({}, {});
  view_.SetBackdrop(grid.Draw(), {}, backdrop);
  for (const int samples : kSamples) {
    Picture picture = ViewOfWavyJoint();
    picture.samples = samples;
    picture.plain = true;
    view_.Render(picture, size);
    const GridAgreement agreement =
        CompareWithGrid(view_.ReadPixels(), grid, backdrop, picture.view, picture.field_of_view);
    picture.plain = false;
    const std::string words = fmt::format("grid, {} samples per pixel", samples);
    const FrameTimes times = TimeFrames(words, [&] {
      picture.view.tip.x += 1e-7;
      view_.Render(picture, size);
    });
    bench_.rows.push_back(
        {"samples", words, size, grid.width, {}, samples, 0, times, {}, Held(agreement)});
  }
}

// The tissue moves in every frame; one instrument is held, the other lies there as a surface.
void ViewBenchRun::MeasureScenes(int size) {
  LoadedScene loaded = WavyJoint(options_.panorama);
  const LoadedScene smooth = WithSmoothOutlines(loaded);
  const InstrumentView held = ProbeInFront();
  // Drawn as far as its portal, which lies behind the lens.
  const SurfaceMesh probe =
      Moved(MakeToolMesh(held.kind).body, ProbePose(held.portal, held.proxy, held.roll));
  const SurfaceMesh lying = MakeToolMesh(simulation::ToolKind::kPunch).body;
  std::vector<Tissue> tissues(2);
  tissues[0].pose.position = {-0.004, 0.003, 0.026};
  tissues[1].pose.position = {0.002, 0.004, 0.034};
  tissues[1].pose.quaternion = glm::dquat(std::cos(0.5), std::sin(0.5), 0, 0);
  for (const SceneKind& kind : kScenes) {
    const int around = std::max(
        3, static_cast<int>(std::lround(std::sqrt(0.5 * kind.fineness * options_.triangles))));
    SurfaceMesh ring;
    if (kind.fineness > 0) ring = Ring(0.007, 0.0024, around, around);
    loaded.scene.backdrop.relight = kind.relight;
    view_.SetBackdrop(*loaded.panorama, *loaded.depth, loaded.scene.backdrop);
    std::vector<simulation::TissueLook> looks(2);
    looks[1].structure = kind.structure;
    looks[1].fibres = looks[1].vessels = looks[1].fibrillation = 1;
    view_.SetTissues(tissues, std::vector{Share(lying), Share(ring)}, looks);
    Picture picture = ViewOfWavyJoint();
    picture.relief = kUsualRelief;
    picture.samples = 2;
    picture.instrument = held;
    if (kind.is_disturbed) picture.disturbances.haze = picture.disturbances.bubbles = 0.4;
    SurfaceMesh now = ring;
    int frame = 0;
    const std::string words = fmt::format(fmt::runtime(kind.words), ring.triangles.size());
    const FrameTimes times = TimeFrames(words, [&] {
      ++frame;
      for (std::size_t v = 0; v < now.vertices.size(); ++v)
        now.vertices[v].z =
            ring.vertices[v].z + 1e-4 * std::sin(0.3 * frame + 900 * now.vertices[v].x);
      if (!now.vertices.empty()) view_.SetTissueShape(1, now.vertices);
      picture.view.tip.x += 1e-7;
      picture.disturbances.time += 0.03;
      view_.Render(picture, size);
    });
    // Compares the last frame.
    const SurfaceMesh lies = Moved(lying, tissues[0].pose), moves = Moved(now, tissues[1].pose);
    const ReferenceMesh meshes[] = {{&probe}, {&lies}, {&moves}};
    const std::vector<TracedPixel> traced =
        TracePixels(smooth, picture, size, options_.pixels, meshes);
    bench_.rows.push_back({"scene",
                           words,
                           size,
                           options_.panorama,
                           picture.relief,
                           picture.samples,
                           static_cast<int>(ring.triangles.size()),
                           times,
                           Held(CompareWithTraced(traced, view_.ReadDistances(), size)),
                           {}});
  }
}

}  // namespace

ViewBench RunViewBench(const ViewBenchOptions& options, const Progress& progress) {
  return ViewBenchRun(options, progress).Run();
}

}  // namespace arthro::app
