#include "app/bench/panorama/registration_bench.h"

#include <cmath>
#include <iterator>
#include <limits>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/bench/machine_words.h"
#include "app/bench/panorama/stitcher_peer.h"
#include "app/bench/speed_error_plot.h"
#include "app/bench/table_number.h"
#include "authoring/lens/rectifier.h"
#include "authoring/panorama/graph/register.h"
#include "authoring/panorama/preparation/prepare.h"
#include "authoring/phantom/clip/clip.h"
#include "simulation/core/options_json.h"
#include "simulation/core/process_cost.h"
#include "tests/support/panorama/clip_score.h"

namespace arthro::app {
namespace {

using namespace test;

using authoring::Detector;
using authoring::GraphStages;
using authoring::PairMethod;

struct ClipKind {
  const char* words;
  authoring::ClipPreset preset;
};
constexpr ClipKind kClips[] = {{"easy", authoring::ClipPreset::kEasy},
                               {"medium", authoring::ClipPreset::kMedium},
                               {"hard", authoring::ClipPreset::kHard}};

struct Prepared {
  std::vector<authoring::WorkingFrame> frames;
  cv::Mat mask;
};

// Prepares raw frames for matching, as the panorama job does.
Prepared Prepare(const std::vector<cv::Mat>& raw, const authoring::Rectifier& rectifier,
                 double scale) {
  Prepared prepared{{}, rectifier.mask()};
  std::vector<cv::Mat> rectified(raw.size());
  authoring::ClipLookBuilder look;
  for (std::size_t i = 0; i < raw.size(); ++i) {
    rectifier.Rectify(raw[i], rectified[i]);
    look.Add(rectified[i], rectifier.mask());
  }
  const authoring::ClipLook seen = look.Finish();
  for (std::size_t i = 0; i < raw.size(); ++i)
    prepared.frames.push_back(
        authoring::Prepare(static_cast<int>(i), rectified[i], scale, rectifier.mask(), seen, {}));
  return prepared;
}

void Score(const authoring::Clip& clip, const authoring::RectifiedView& view,
           const std::vector<authoring::FrameResult>& results, RegistrationBenchRow& row) {
  const ClipScore score = ScoreClip(clip, view, results);
  constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();
  row.frames = clip.frames();
  row.placed = score.placed;
  row.right = score.placed > 1 ? score.right : 0;  // a single frame has no error
  row.wrong_as_good = score.wrong_as_good;
  row.mean_px = row.right > 0 ? score.mean_px : kNothing;
  row.max_px = row.right > 0 ? score.max_px : kNothing;
  row.covered = score.covered;
}

RegistrationBenchRow RunPeer(const authoring::Clip& clip, const authoring::RectifiedView& view,
                             const Prepared& prepared, double scale, PeerMode mode,
                             const RegistrationBenchOptions& options, const Progress& progress) {
  PeerOptions limits;
  limits.mode = mode;
  limits.cpu_limit = options.peer_limit;
  std::vector<cv::Mat> greys;
  for (const auto& frame : prepared.frames) greys.push_back(frame.grey);
  const PeerResult peer = StitchWithPeer(greys, prepared.mask, limits, progress);

  std::vector<authoring::FrameResult> results(greys.size());
  for (std::size_t i = 0; i < results.size(); ++i) results[i].index = static_cast<int>(i);
  const double shift = 0.5 * scale - 0.5;  // x_work = (x + 0.5) scale - 0.5
  const cv::Matx33d work_from_rectified(scale, 0, shift, 0, scale, shift, 0, 0, 1);
  for (std::size_t k = 0; k < peer.frames.size(); ++k) {
    auto& result = results.at(static_cast<std::size_t>(peer.frames[k]));
    result.is_placed = true;
    result.component = 0;
    result.panorama_from_rectified = peer.mosaic_from_frame[k] * work_from_rectified;
  }
  RegistrationBenchRow row;
  row.chain = mode == PeerMode::kScans ? "cv::Stitcher scans" : "cv::Stitcher panorama";
  row.is_peer = true;
  row.outcome = peer.outcome;
  row.cpu_ms = 1e3 * peer.cpu_seconds / static_cast<double>(greys.size());
  Score(clip, view, results, row);
  row.covered = std::numeric_limits<double>::quiet_NaN();  // the peer expects no error
  return row;
}

}  // namespace

std::vector<BenchChain> BenchChains(bool every_chain) {
  constexpr struct {
    const char* words;
    Detector detector;
  } kDetectors[] = {{"SURF", Detector::kSurf},
                    {"SIFT", Detector::kSift},
                    {"AKAZE", Detector::kAkaze},
                    {"ORB", Detector::kOrb}};
  constexpr struct {
    const char* words;
    double scale;
  } kScales[] = {{"1/2", 0.5}, {"1/4", 0.25}, {"1/1", 1.0}};
  constexpr struct {
    const char* words;
    GraphStages stages;
  } kStages[] = {{"all", GraphStages::kRefinement},
                 {"loops", GraphStages::kLoops},
                 {"pairs", GraphStages::kPairs}};
  std::vector<BenchChain> chains;
  for (const auto& d : kDetectors)
    for (const auto& s : kScales)
      for (const auto& g : kStages) {
        const int off_axis = (&d != kDetectors) + (&s != kScales) + (&g != kStages);
        if (off_axis > 1 && !every_chain) continue;
        BenchChain chain{fmt::format("{} {} {}", d.words, s.words, g.words), s.scale, {}};
        chain.options.method = PairMethod::kFeaturesThenDirect;
        chain.options.features.detector = d.detector;
        chain.options.graph.stages = g.stages;
        chains.push_back(chain);
      }
  // Features alone, as the paper has it, and the default: none at all.
  for (const auto& d : kDetectors) {
    if (&d != kDetectors && !every_chain) continue;
    BenchChain paper{fmt::format("{} 1/2 alone", d.words), 0.5, {}};
    paper.options.method = PairMethod::kFeatures;
    paper.options.features.detector = d.detector;
    chains.push_back(paper);
  }
  for (const auto& s : kScales) {
    BenchChain direct{fmt::format("direct {} all", s.words), s.scale, {}};
    direct.options.method = PairMethod::kDirect;
    chains.push_back(direct);
  }
  return chains;
}

RegistrationBench RunRegistrationBench(const RegistrationBenchOptions& options,
                                       const Progress& progress) {
  RegistrationBench bench{options, {}};
  const auto chains = BenchChains(options.every_chain);
  const double runs = static_cast<double>(std::size(kClips) * chains.size());
  double run = 0;
  for (const ClipKind& kind : kClips) {
    authoring::ClipOptions clip_options =
        authoring::ClipOptionsOf(kind.preset, options.width, options.height);
    clip_options.seed = options.seed;
    if (options.frames > 0) clip_options.frames = options.frames;
    const authoring::Clip clip(clip_options);
    std::vector<cv::Mat> raw;
    for (int i = 0; i < clip.frames(); ++i) {
      progress.Step("draw the clip", run / runs);
      raw.push_back(clip.Frame(i));
    }
    for (const BenchChain& chain : chains) {
      progress.Step(chain.words, run++ / runs);
      const authoring::Rectifier rectifier(clip.lens(), {}, chain.scale);
      const double start = ProcessCpuMs();
      const Prepared prepared = Prepare(raw, rectifier, chain.scale);
      const auto results = authoring::Register(prepared.frames, rectifier.view(), rectifier.mask(),
                                               chain.options, nullptr, {{}, progress.stop});
      RegistrationBenchRow row;
      row.clip = kind.words;
      row.chain = chain.words;
      row.cpu_ms = (ProcessCpuMs() - start) / clip.frames();
      Score(clip, rectifier.view(), results, row);
      bench.rows.push_back(row);
    }
    if (!options.peers) continue;
    // At full size, where the peer chooses its own working size.
    const authoring::Rectifier rectifier(clip.lens(), {});
    const Prepared prepared = Prepare(raw, rectifier, 1.0);
    for (const PeerMode mode : {PeerMode::kScans, PeerMode::kPanorama}) {
      RegistrationBenchRow row =
          RunPeer(clip, rectifier.view(), prepared, 1.0, mode, options, {{}, progress.stop});
      row.clip = kind.words;
      bench.rows.push_back(row);
    }
  }
  return bench;
}

std::string TableOf(const RegistrationBench& bench) {
  std::string table = fmt::format(
      "# panorama: speed against error | {} | {} x {} px, seed {}\n"
      "{:<8}{:<24}{:>7}{:>8}{:>7}{:>7}{:>9}{:>9}{:>9}{:>10}  {}\n",
      MachineWords(), bench.options.width, bench.options.height, bench.options.seed, "clip",
      "chain", "frames", "placed", "right", "wrong", "mean px", "max px", "covered", "CPU ms/fr",
      "outcome");
  for (const auto& row : bench.rows)
    table += fmt::format("{:<8}{:<24}{:>7}{:>8}{:>7}{:>7}{:>9}{:>9}{:>9}{:>10}  {}\n", row.clip,
                         row.chain, row.frames, row.placed, row.right, row.wrong_as_good,
                         TableNumber(row.mean_px, 2), TableNumber(row.max_px, 2),
                         TableNumber(row.covered, 2), TableNumber(row.cpu_ms, 1), row.outcome);
  return table +
         "right: worst of nine points less than 10 px off; wrong: placed, 10 px or more off, and "
         "expected to be less;\ncovered: share of placed frames within their expected error; "
         "reading of files is not in the time.\n";
}

nlohmann::json JsonOf(const RegistrationBench& bench) {
  const auto number = [](double value) {
    return std::isfinite(value) ? nlohmann::json(value) : nlohmann::json(nullptr);
  };
  nlohmann::json rows = nlohmann::json::array();
  for (const auto& row : bench.rows)
    rows.push_back({{"clip", row.clip},
                    {"chain", row.chain},
                    {"peer", row.is_peer},
                    {"outcome", row.outcome},
                    {"frames", row.frames},
                    {"placed", row.placed},
                    {"right", row.right},
                    {"wrong_as_good", row.wrong_as_good},
                    {"mean_px", number(row.mean_px)},
                    {"max_px", number(row.max_px)},
                    {"covered", number(row.covered)},
                    {"cpu_ms_per_frame", number(row.cpu_ms)}});
  return {{"schema", "arthroscene.bench.panorama/1"},
          {"machine", MachineWords()},
          {"options", JsonFromOptions(bench.options)},
          {"rows", rows}};
}

std::string PlotOf(const RegistrationBench& bench) {
  std::vector<PlotMark> marks;
  for (const auto& row : bench.rows)
    marks.push_back({row.clip, row.chain, row.cpu_ms, row.mean_px,
                     row.frames > 0 ? static_cast<double>(row.right) / row.frames : 0});
  return SpeedErrorSvg({"Registration: speed against error", "processor time per frame, ms",
                        "mean corner error of right frames, px",
                        "filled: share of frames right; top edge: no frame right",
                        "exact homographies of the rendered clips"},
                       marks);
}

}  // namespace arthro::app
