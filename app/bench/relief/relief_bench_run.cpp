#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <utility>

#include "app/bench/relief/colmap_peer.h"
#include "app/bench/relief/relief_bench.h"
#include "app/bench/relief/touch_error.h"
#include "app/state/footage/measured_backdrop.h"
#include "authoring/depth/depth_filter.h"
#include "authoring/panorama/make_panorama.h"
#include "authoring/relief/make/make_relief.h"
#include "simulation/core/error.h"
#include "simulation/core/process_cost.h"
#include "simulation/core/units.h"
#include "tests/support/relief/surface_score.h"
#include "tests/support/temp_folder.h"

namespace arthro::app {
namespace {

using authoring::DepthEstimator;

constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

struct BenchClip {
  std::string words;
  std::filesystem::path footage;
  test::CavityTruth truth;
  test::TrueSurface surface;
};

struct ReliefWay {
  const char* words;
  std::function<void(authoring::ReliefOptions&)> set;
};

std::vector<ReliefWay> ReliefWays() {
  return {{"motion and portal", [](authoring::ReliefOptions&) {}},
          {"motion and portal, no brightness",
           [](authoring::ReliefOptions& options) { options.use_brightness = false; }},
          {"motion", [](authoring::ReliefOptions& options) { options.use_pivot = false; }}};
}

struct BrightnessWay {
  const char* words;
  DepthEstimator estimator;
};
constexpr BrightnessWay kBrightnessWays[] = {
    {"homographies, paper", DepthEstimator::kPaper},
    {"homographies, inverse square", DepthEstimator::kInverseSquareRed},
    {"homographies, shading", DepthEstimator::kShading}};

ReliefBenchRow NewRow(const BenchClip& clip, const char* way) {
  ReliefBenchRow row;
  row.clip = clip.words;
  row.way = way;
  row.frames = static_cast<int>(clip.truth.poses.size());
  row.coverage = row.rmse_mm = row.median_mm = row.within_1mm = row.spearman = row.apart_px =
      row.force_error = row.force_of_truth = kNothing;
  return row;
}

void TakeScore(const test::SurfaceScore& score, ReliefBenchRow& row) {
  row.coverage = score.coverage;
  row.rmse_mm = MmFromMetres(score.rmse);
  row.median_mm = MmFromMetres(score.median);
  row.within_1mm = score.within_1mm;
  row.spearman = score.spearman;
}

void Score(const test::FoundSurface& found, const BenchClip& clip,
           const ReliefBenchOptions& options, ReliefBenchRow& row) {
  TakeScore(test::ScoreSurface(found, clip.surface), row);
  const TouchError touch = MeasureTouches(found, clip.surface, options.touches, options.seed);
  if (touch.touches == 0) return;
  row.force_error = touch.rms;
  row.force_of_truth = touch.true_rms;
}

ReliefBenchRow RunMotion(const BenchClip& clip, const ReliefWay& way,
                         const ReliefBenchOptions& options, const Progress& progress) {
  ReliefBenchRow row = NewRow(clip, way.words);
  authoring::ReliefRequest request;
  request.footage = clip.footage;
  request.lens = clip.truth.lens;
  request.options.view_angle = clip.truth.view_angle;
  request.options.insertion = test::MedianInsertion(clip.truth.poses);
  way.set(request.options);
  const double start = ProcessCpuMs();
  authoring::ReliefResult result;
  try {
    result = authoring::MakeRelief(request, progress);
  } catch (const Error& fault) {
    if (fault.code() == Code::kCancelled) throw;
    row.outcome = fault.sentence();
    return row;
  }
  row.cpu_ms = (ProcessCpuMs() - start) / row.frames;
  for (const authoring::PosedFrame& frame : result.report.frames) row.placed += frame.is_posed;
  if (!result.report.verdict.is_measured()) row.outcome = result.report.verdict.kind;
  const auto found = test::SurfaceOf(result, clip.truth, clip.surface);
  if (found) Score(*found, clip, options, row);
  return row;
}

// One panorama, and the estimators on it.
std::vector<ReliefBenchRow> RunBrightness(const BenchClip& clip, int estimators,
                                          const ReliefBenchOptions& options,
                                          const Progress& progress) {
  std::vector<ReliefBenchRow> rows;
  authoring::PanoramaRequest request;
  request.footage = clip.footage;
  request.lens = clip.truth.lens;
  const double start = ProcessCpuMs();
  authoring::PanoramaResult panorama;
  try {
    panorama = authoring::MakePanorama(request, progress);
  } catch (const Error& fault) {
    if (fault.code() == Code::kCancelled) throw;
    rows.push_back(NewRow(clip, "homographies"));
    rows.back().outcome = fault.sentence();
    return rows;
  }
  const double of_panorama = ProcessCpuMs() - start;
  const ColourImage colours = OnBlack(panorama.picture);
  const test::PanoramaPlaces places = test::PlacesOf(panorama.report, clip.truth, clip.surface);
  double apart = 0, count = 0;
  for (const double spread : places.spread)
    if (std::isfinite(spread)) apart += spread, ++count;
  for (int i = 0; i < estimators; ++i) {
    ReliefBenchRow row = NewRow(clip, kBrightnessWays[i].words);
    for (const auto& frame : panorama.report.frames) row.placed += frame.is_placed;
    row.apart_px = count > 0 ? apart / count : kNothing;
    authoring::DepthOptions depth_options;
    depth_options.estimator = kBrightnessWays[i].estimator;
    const double begin = ProcessCpuMs();
    try {
      const DepthMap depth =
          authoring::DepthFromColour(colours, depth_options, nullptr, {{}, progress.stop});
      row.cpu_ms = (of_panorama + ProcessCpuMs() - begin) / row.frames;
      Score(test::SurfaceOf(depth, places, clip.surface), clip, options, row);
    } catch (const Error& fault) {
      if (fault.code() == Code::kCancelled) throw;
      row.outcome = fault.sentence();
    }
    rows.push_back(row);
  }
  return rows;
}

// Sparse points instead of a surface: a cell without a point counts as not covered, and there is
// nothing to touch.
ReliefBenchRow RunPeer(const BenchClip& clip, const Progress& progress) {
  ReliefBenchRow row = NewRow(clip, "COLMAP, points");
  const char* path = std::getenv("PATH");
  const auto program = FindProgram("colmap", path ? path : "");
  if (!program) {
    row.outcome = "not installed: COLMAP was not compared; install colmap";
    row.cpu_ms = kNothing;
    return row;
  }
  const ColmapModel model = RunColmap(*program, clip.footage, clip.truth.lens, progress);
  row.outcome = model.outcome;
  row.cpu_ms = model.cpu_ms / row.frames;
  row.placed = static_cast<int>(model.frames.size());
  const auto fit = test::FitCameras(model.frames, clip.truth.poses);
  if (!fit) return row;
  TakeScore(test::ScoreSurface(test::SurfaceOf(model.points, *fit, clip.surface), clip.surface),
            row);
  return row;
}

// Small clips of rising difficulty, drawn into `folder`.
std::vector<BenchClip> DrawnClips(const std::filesystem::path& folder,
                                  const ReliefBenchOptions& options) {
  struct Kind {
    const char* words;
    int frames;
    double contrast, noise;
  };
  constexpr Kind kKinds[] = {
      {"easy", 20, 0.75, 1.5}, {"medium", 16, 0.4, 2.5}, {"hard", 12, 0.2, 4}};
  std::vector<BenchClip> clips;
  for (const Kind& kind : kKinds) {
    test::CavityOptions cavity;
    cavity.frames = options.quick ? 8 : kind.frames;
    cavity.contrast = kind.contrast;
    cavity.picture_noise = kind.noise;
    cavity.seed = static_cast<unsigned>(options.seed);
    BenchClip clip{kind.words, folder / kind.words, test::TruthOf(cavity), {}};
    std::filesystem::create_directory(clip.footage);
    test::WriteCavityClip(clip.footage, cavity);
    clip.surface = test::SurfaceOf(clip.truth);
    clips.push_back(std::move(clip));
    if (options.quick) break;
  }
  return clips;
}

}  // namespace

ReliefBench RunReliefBench(const ReliefBenchOptions& options, const Progress& progress) {
  ReliefBench bench{options, {}};
  const test::TempFolder folder;
  progress.Step("draw the clips", 0);
  std::vector<BenchClip> clips;
  if (options.clip.empty()) {
    clips = DrawnClips(folder.path(), options);
  } else {
    const std::filesystem::path given = options.clip;
    const auto words = given.has_filename() ? given.filename() : given.parent_path().filename();
    BenchClip clip{words.string(), given / "frames", test::ReadCavityTruth(given), {}};
    clip.surface = test::SurfaceOf(clip.truth);
    clips.push_back(std::move(clip));
  }
  std::vector<ReliefWay> ways = ReliefWays();
  if (options.quick) ways.resize(1);
  const int estimators = options.quick ? 1 : static_cast<int>(std::size(kBrightnessWays));
  const double runs = static_cast<double>(clips.size() * (ways.size() + 2));
  double run = 0;
  for (const BenchClip& clip : clips) {
    for (const ReliefWay& way : ways) {
      progress.Step(way.words, run++ / runs);
      bench.rows.push_back(RunMotion(clip, way, options, {{}, progress.stop}));
    }
    progress.Step("homographies", run++ / runs);
    for (ReliefBenchRow& row : RunBrightness(clip, estimators, options, {{}, progress.stop}))
      bench.rows.push_back(std::move(row));
    if (options.quick) continue;
    progress.Step("COLMAP", run++ / runs);
    bench.rows.push_back(RunPeer(clip, {{}, progress.stop}));
  }
  return bench;
}

}  // namespace arthro::app
