#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <span>

#include <fmt/format.h>

#include "app/bench/quantile.h"
#include "app/bench/view/view_bench.h"
#include "app/view/backdrop/relief_outlines.h"
#include "app/view/exposure/picture_statistics.h"
#include "app/view/instruments/probe_mesh.h"
#include "app/view/instruments/tool_mesh.h"
#include "app/view/offscreen_context.h"
#include "simulation/core/process_cost.h"
#include "tests/support/view/view_cases.h"

namespace arthro::app {
namespace {

using namespace test;

constexpr std::array kSearches = {ReliefSearch{0, 1},  ReliefSearch{64, 16}, kUsualRelief,
                                  ReliefSearch{64, 4}, ReliefSearch{64, 1},  ReliefSearch{256, 1}};
constexpr std::array kSamples = {1, 2, 4, 8};
constexpr int kWarmUp = 5;  // frames, in which drivers compile and upload

// Content of a picture beside the backdrop. `fineness` is the share of the options' triangles.
struct SceneKind {
  const char* words;
  double fineness = 0;
  double relight = 0;
  bool is_disturbed = false;
  simulation::TissueStructure structure = simulation::TissueStructure::kPlain;
  bool shows_camera = false;  // rows of kCamera follow
};
constexpr std::array kScenes = {SceneKind{"two instruments"},
                                SceneKind{"two instruments, {} triangles", 0.2},
                                SceneKind{"two instruments, {} triangles", 1},
                                SceneKind{"two instruments, {} triangles, lamp", 0.2, 1},
                                SceneKind{"the same, haze and bubbles", 0.2, 1, true},
                                SceneKind{"{} triangles, lamp, as cartilage", 0.2, 1, false,
                                          simulation::TissueStructure::kHyaline},
                                SceneKind{"{} triangles, lamp, as a meniscus", 0.2, 1, false,
                                          simulation::TissueStructure::kFibres, true}};

// Features of the camera, each with those before it.
struct CameraRow {
  const char* words;
  CameraFeatures features;
};
constexpr std::array kCamera = {CameraRow{"the same, camera: exposure", CameraFeatures::kExposure},
                                CameraRow{"the same and grain", CameraFeatures::kGrain},
                                CameraRow{"the same and sharpness", CameraFeatures::kSharpness},
                                CameraRow{"the same and fringe", CameraFeatures::kFringe},
                                CameraRow{"the same and smooth edges", CameraFeatures::kEdges},
                                CameraRow{"the same and occlusion", CameraFeatures::kOcclusion}};

// Number of rows, for the progress.
constexpr double kRows =
    3 * kSearches.size() + 2 * kSamples.size() + 2 * (kScenes.size() + kCamera.size());

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
    return std::move(bench_);
  }

 private:
  void MeasureRelief(int width, int size);
  void MeasureSamples(int size);
  void MeasureScenes(int size);
  template <class F>
  FrameTimes TimeFrames(const std::string& words, F&& frame);
  // Times frames of several kinds in turns, so that a change of the machine's speed falls on all.
  template <class F>
  std::vector<FrameTimes> TimeInTurns(const std::string& words, std::size_t kinds, F&& frame);
  double ErrorAgainstStill(const Picture& picture, int size);

  ViewBenchOptions options_;
  const Progress& progress_;
  OffscreenContext context_;
  ArthroscopicView view_;  // after the context: it must end first
  ViewBench bench_;
};

template <class F>
std::vector<FrameTimes> ViewBenchRun::TimeInTurns(const std::string& words, std::size_t kinds,
                                                  F&& frame) {
  using Clock = std::chrono::steady_clock;
  const int warm_up = std::min(kWarmUp, options_.timed_frames),
            all = warm_up + options_.timed_frames;
  std::vector<std::vector<double>> wall(kinds), cpu(kinds);
  for (int i = 0; i < all; ++i) {
    progress_.Step(
        words,
        (static_cast<double>(bench_.rows.size()) + static_cast<double>(kinds) * i / all) / kRows);
    for (std::size_t kind = 0; kind < kinds; ++kind) {
      const Clock::time_point start = Clock::now();
      const double cpu_start = ProcessCpuMs();
      frame(kind);
      view_.Finish();
      if (i < warm_up) continue;
      cpu[kind].push_back(1e-3 * (ProcessCpuMs() - cpu_start));
      wall[kind].push_back(std::chrono::duration<double>(Clock::now() - start).count());
    }
  }
  std::vector<FrameTimes> times;
  for (std::size_t kind = 0; kind < kinds; ++kind)
    times.push_back({Quantile(wall[kind], 0.5), Quantile(wall[kind], 0.99),
                     Quantile(cpu[kind], 0.5), Quantile(cpu[kind], 0.99)});
  return times;
}

template <class F>
FrameTimes ViewBenchRun::TimeFrames(const std::string& words, F&& frame) {
  return TimeInTurns(words, 1, [&](std::size_t) { frame(); }).front();
}

// Root mean square difference of the green channel from the picture of a scope at rest, which has
// four rays and eight samples per pixel, in the inner part of the window. Grain is left out.
double ViewBenchRun::ErrorAgainstStill(const Picture& picture, int size) {
  Picture live = picture;
  live.camera->grain = 0;
  Picture still = live;
  still.rays = 2;
  still.samples = kSamples.back();
  view_.Render(still, size);
  const ColourImage wanted = view_.ReadPixels();
  view_.Render(live, size);
  const ColourImage drawn = view_.ReadPixels();
  const PictureMask mask =
      DiscMask(size, size, 0.5 * (size - 1), 0.5 * (size - 1), 0.5 * kMeasuredRadius * size);
  double squares = 0;
  int count = 0;
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x)
      if (mask.at(x, y)) squares += std::pow(drawn.at(x, y)[1] - wanted.at(x, y)[1], 2), ++count;
  return std::sqrt(squares / std::max(count, 1));
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
    std::vector<Picture> pictures{picture};
    std::vector<std::string> words{fmt::format(fmt::runtime(kind.words), ring.triangles.size())};
    for (const CameraRow& row :
         kind.shows_camera ? std::span(kCamera) : std::span<const CameraRow>()) {
      pictures.push_back(picture);
      pictures.back().camera = LensCamera();
      pictures.back().features = row.features;
      words.push_back(row.words);
    }
    SurfaceMesh now = ring;
    int frame = 0;
    const std::vector<FrameTimes> times =
        TimeInTurns(words[0], pictures.size(), [&](std::size_t i) {
          ++frame;
          for (std::size_t v = 0; v < now.vertices.size(); ++v)
            now.vertices[v].z =
                ring.vertices[v].z + 1e-4 * std::sin(0.3 * frame + 900 * now.vertices[v].x);
          if (!now.vertices.empty()) view_.SetTissueShape(1, now.vertices);
          pictures[i].view.tip.x += 1e-7;
          pictures[i].disturbances.time += 0.03;
          view_.Render(pictures[i], size);
        });
    // Compares the last frame.
    const SurfaceMesh lies = Moved(lying, tissues[0].pose), moves = Moved(now, tissues[1].pose);
    const ReferenceMesh meshes[] = {{&probe}, {&lies}, {&moves}};
    const std::vector<TracedPixel> traced =
        TracePixels(smooth, pictures.back(), size, options_.pixels, meshes);
    const std::optional<TracedAgreement> agreement =
        Held(CompareWithTraced(traced, view_.ReadDistances(), size));
    for (std::size_t i = 0; i < pictures.size(); ++i) {
      std::optional<double> off_still;
      if (pictures[i].camera) off_still = ErrorAgainstStill(pictures[i], size);
      bench_.rows.push_back({"scene",
                             words[i],
                             size,
                             options_.panorama,
                             picture.relief,
                             picture.samples,
                             static_cast<int>(ring.triangles.size()),
                             times[i],
                             agreement,
                             {},
                             off_still});
    }
  }
}

}  // namespace

ViewBench RunViewBench(const ViewBenchOptions& options, const Progress& progress) {
  return ViewBenchRun(options, progress).Run();
}

}  // namespace arthro::app
