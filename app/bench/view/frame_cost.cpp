#include "app/bench/view/frame_cost.h"

#include <array>
#include <cmath>
#include <deque>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/bench/table_number.h"
#include "app/bench/view/live_error.h"
#include "app/bench/view/traced_agreement.h"
#include "app/view/backdrop/relief_outlines.h"
#include "app/view/instruments/probe_mesh.h"
#include "app/view/instruments/tool_mesh.h"
#include "tests/support/view/view_cases.h"

namespace arthro::app {
namespace {

using namespace test;

constexpr int kWarmUp = 5;  // turns

// Contents of a view. Views differ only in that: a change of it would be uploaded anew.
enum class Content { kBackdrop, kLit, kInstruments, kTissue, kStructure };

// A link of the chain: what it adds to the picture before it.
struct Link {
  const char* words;
  Content content;
  bool has_relief = true;
  std::optional<CameraFeatures> features = {};
  bool has_flecks = false;
};
constexpr std::array kChain{
    Link{"backdrop on a bare sphere", Content::kBackdrop, false},
    Link{"relief", Content::kBackdrop},
    Link{"lamp", Content::kLit},
    Link{"two instruments and their shadow", Content::kInstruments},
    Link{"tissue of {} triangles", Content::kTissue},
    Link{"structure of the tissue", Content::kStructure},
    Link{"flecks", Content::kStructure, true, {}, true},
    Link{"camera: exposure", Content::kStructure, true, CameraFeatures::kExposure, true},
    Link{"grain", Content::kStructure, true, CameraFeatures::kGrain, true},
    Link{"sharpness", Content::kStructure, true, CameraFeatures::kSharpness, true},
    Link{"fringe", Content::kStructure, true, CameraFeatures::kFringe, true},
    Link{"smooth edges", Content::kStructure, true, CameraFeatures::kEdges, true},
    Link{"occlusion", Content::kStructure, true, CameraFeatures::kOcclusion, true}};

// The held instrument is drawn as far as its portal; the other one lies there as a surface.
struct Parts {
  LoadedScene loaded;
  SurfaceMesh held, lying, ring;
  std::vector<Tissue> tissues = std::vector<Tissue>(2);
};

Parts PartsOf(const FrameCostOptions& options) {
  Parts parts{WavyJoint(options.panorama), {}, {}, {}};
  const InstrumentView tool = ProbeInFront();
  parts.held = Moved(MakeToolMesh(tool.kind).body, ProbePose(tool.portal, tool.proxy, tool.roll));
  parts.lying = MakeToolMesh(simulation::ToolKind::kPunch).body;
  const int around = std::max(3, static_cast<int>(std::lround(std::sqrt(0.5 * options.triangles))));
  parts.ring = Ring(0.007, 0.0024, around, around);
  parts.tissues[0].pose.position = {-0.004, 0.003, 0.026};
  parts.tissues[1].pose.position = {0.002, 0.004, 0.034};
  parts.tissues[1].pose.quaternion = glm::dquat(std::cos(0.5), std::sin(0.5), 0, 0);
  return parts;
}

void Show(ArthroscopicView& view, const Parts& parts, Content content) {
  Backdrop backdrop = parts.loaded.scene.backdrop;
  backdrop.relight = content == Content::kBackdrop ? 0 : 1;
  view.SetBackdrop(*parts.loaded.panorama, *parts.loaded.depth, backdrop);
  if (content < Content::kInstruments) return;
  std::vector<simulation::TissueLook> looks(2);
  if (content == Content::kStructure) {
    looks[1].structure = simulation::TissueStructure::kFibres;
    looks[1].fibres = looks[1].vessels = 1;
  }
  view.SetTissues(parts.tissues,
                  std::vector{Share(parts.lying),
                              Share(content < Content::kTissue ? SurfaceMesh{} : parts.ring)},
                  looks);
}

Picture PictureOf(const Link& link) {
  Picture picture = ViewOfWavyJoint();
  if (link.has_relief) picture.relief = kUsualRelief;
  picture.samples = 2;
  if (link.content >= Content::kInstruments) picture.instrument = ProbeInFront();
  if (link.has_flecks) picture.flecks = kUsualFlecks;
  if (link.features) {
    picture.camera = LensCamera();
    picture.features = *link.features;
  }
  return picture;
}

}  // namespace

std::vector<FrameCostRow> MeasureFrameCosts(const FrameCostOptions& options,
                                            const std::vector<int>& sizes,
                                            const Progress& progress) {
  const Parts parts = PartsOf(options);
  LoadedScene smooth = parts.loaded;
  DepthMap outlined = *smooth.depth;
  SmoothOutlines(outlined, false);
  smooth.depth = Share(std::move(outlined));

  std::deque<ArthroscopicView> views(static_cast<std::size_t>(Content::kStructure) + 1);
  for (std::size_t i = 0; i < views.size(); ++i) Show(views[i], parts, static_cast<Content>(i));
  const auto view_of = [&](std::size_t link) -> ArthroscopicView& {
    return views[static_cast<std::size_t>(kChain[link].content)];
  };

  std::vector<FrameCostRow> rows;
  for (std::size_t s = 0; s < sizes.size(); ++s) {
    std::vector<Picture> pictures;
    pictures.reserve(kChain.size());
    for (const Link& link : kChain) pictures.push_back(PictureOf(link));
    SurfaceMesh now = parts.ring;
    int drawn = 0;
    const auto frame = [&](std::size_t i) {
      ++drawn;
      for (std::size_t v = 0; v < now.vertices.size(); ++v)
        now.vertices[v].z =
            parts.ring.vertices[v].z + 1e-4 * std::sin(0.3 * drawn + 900 * now.vertices[v].x);
      if (kChain[i].content >= Content::kTissue) view_of(i).SetTissueShape(1, now.vertices);
      pictures[i].view.tip.x += 1e-7;
      pictures[i].disturbances.time += 0.03;
      view_of(i).Render(pictures[i], sizes[s]);
    };
    const std::vector<FrameSeries> series = DrawInTurns(
        kChain.size(), options.timed_frames, std::min(kWarmUp, options.timed_frames), frame,
        [&](std::size_t i) { view_of(i).Finish(); },
        [&](double share) {
          progress.Step("cost of features",
                        (static_cast<double>(s) + share) / static_cast<double>(sizes.size()));
        });
    for (std::size_t i = 0; i < kChain.size(); ++i) {
      const Link& link = kChain[i];
      FrameCostRow row{fmt::format(fmt::runtime(link.words), parts.ring.triangles.size()), sizes[s],
                       series[i].Times(),
                       i == 0 ? series[i].Times() : series[i].Beyond(series[i - 1])};
      if (link.features) {
        row.off_still = ErrorAgainstStill(view_of(i), pictures[i], sizes[s]);
      } else if (!link.has_flecks) {
        const SurfaceMesh lies = Moved(parts.lying, parts.tissues[0].pose),
                          moves = Moved(now, parts.tissues[1].pose);
        std::vector<ReferenceMesh> meshes;
        if (link.content >= Content::kInstruments) meshes = {{&parts.held}, {&lies}};
        if (link.content >= Content::kTissue) {
          view_of(i).SetTissueShape(1, now.vertices);
          meshes.push_back({&moves});
        }
        view_of(i).Render(pictures[i], sizes[s]);
        const TracedAgreement agreement =
            CompareWithTraced(TracePixels(smooth, pictures[i], sizes[s], options.pixels, meshes),
                              view_of(i).ReadDistances(), sizes[s]);
        if (agreement.compared > 0) row.ends_off = agreement.elsewhere;
      }
      rows.push_back(std::move(row));
    }
  }
  return rows;
}

std::string TableOf(const std::vector<FrameCostRow>& rows) {
  std::string table = fmt::format(
      "# cost of each feature, drawn in turns; ms per frame\n"
      "{:>5} {:<36}{:>8}{:>8} |{:>8}{:>8}{:>10} |{:>8}{:>8} |{:>9}{:>8}\n"
      "{:>5} {:<36}{:>8}{:>8} |{:>8}{:>8}{:>10} |{:>8}{:>8} |{:>9}{:>8}\n",
      "size", "picture with all above and", "wall", "", "cpu", "", "two cores", "share", "of cpu",
      "ends off", "still",  //
      "px", "", "median", "p99", "median", "p99", "at most", "median", "p99", "%", "rms");
  const auto column = [](std::optional<double> value, int width, double factor) {
    return value ? fmt::format("{:>{}.2f}", factor * *value, width)
                 : fmt::format("{:>{}}", "-", width);
  };
  for (const FrameCostRow& row : rows)
    table += fmt::format(
        "{:>5} {:<36}{:>8.1f}{:>8.1f} |{:>8.1f}{:>8.1f}{:>10.1f} |{:>8.2f}{:>8.2f} |{}{}\n",
        row.size, row.words, kMilli * row.picture.wall, kMilli * row.picture.wall_p99,
        kMilli * row.picture.cpu, kMilli * row.picture.cpu_p99, kMilli * row.picture.OnTwoCores(),
        kMilli * row.share.cpu, kMilli * row.share.cpu_p99, column(row.ends_off, 9, 100),
        column(row.off_still, 8, 1));
  table +=
      "two cores, at most: work of the thread that calls OpenGL, and half of that of the others: "
      "the wall time where\nnothing else runs. A slow machine leaves the camera's features out "
      "from "
      "the last to grain.\n";
  return table;
}

nlohmann::json JsonOf(const std::vector<FrameCostRow>& rows) {
  nlohmann::json all = nlohmann::json::array();
  const auto optional = [](std::optional<double> value) {
    return value ? nlohmann::json(*value) : nlohmann::json(nullptr);
  };
  const auto times = [](const FrameTimes& of) {
    return nlohmann::json{{"wall_ms_median", kMilli * of.wall},
                          {"wall_ms_p99", kMilli * of.wall_p99},
                          {"cpu_ms_median", kMilli * of.cpu},
                          {"cpu_ms_p99", kMilli * of.cpu_p99},
                          {"thread_ms_median", kMilli * of.thread}};
  };
  for (const FrameCostRow& row : rows)
    all.push_back({{"feature", row.words},
                   {"size", row.size},
                   {"picture", times(row.picture)},
                   {"share", times(row.share)},
                   {"two_cores_ms", kMilli * row.picture.OnTwoCores()},
                   {"ends_off", optional(row.ends_off)},
                   {"off_still", optional(row.off_still)}});
  return all;
}

}  // namespace arthro::app
