// arthroscene demo [-o DIR]: the demo scene without a window, as pictures, forces and a report.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "app/cli/flags/number_flags.h"
#include "app/cli/job_files.h"
#include "app/cli/job_progress.h"
#include "app/cli/jobs.h"
#include "app/cli/practice/replay_pictures.h"
#include "app/cli/practice/shipped_presets.h"
#include "app/platform/resource_folder.h"
#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"
#include "simulation/core/folders/partial_folder.h"
#include "simulation/core/json_text.h"
#include "simulation/practice/replay/replay.h"
#include "simulation/scene/files/scene_io.h"
#include "simulation/scene/image_io.h"

namespace arthro::app {
namespace {

namespace fs = std::filesystem;

struct DemoJob {
  fs::path folder = "arthroscene-demo";
  int pictures = 8;
  int size = 512;
};

// State of both hands and the tissues at the time of a picture.
struct Moment {
  double t = 0;  // s of the trace
  simulation::Snapshot snapshot;
  std::optional<simulation::WorldPicture> world;
};

// The trace in as many equal parts as there are pictures; of each part the moment of the largest
// force on the instrument, or its middle where nothing was touched.
class Moments {
 public:
  Moments(double begin, double end, int count)
      : begin_(begin),
        part_((end - begin) / count),
        moments_(static_cast<std::size_t>(count)),
        best_(moments_.size(), -1.0) {}

  void Watch(double t, const simulation::Snapshot& snapshot,
             const simulation::WorldPicture* world) {
    if (t < next_look_) return;
    next_look_ = t + kLookEvery - 1e-6;
    const int last = static_cast<int>(moments_.size()) - 1;
    const auto index = static_cast<std::size_t>(
        std::clamp(part_ > 0.0 ? static_cast<int>((t - begin_) / part_) : 0, 0, last));
    const double middle = begin_ + (static_cast<double>(index) + 0.5) * part_;
    const double force = glm::length(snapshot.instrument.tip_force);
    // Below a thousandth of a newton nothing is touched; then nearness to the middle decides.
    const double score = force > 1e-3 ? 1.0 + force : 1.0 / (1.0 + std::abs(t - middle));
    if (score <= best_[index]) return;
    best_[index] = score;
    moments_[index] = {t, snapshot, world ? std::optional(*world) : std::nullopt};
  }
  const std::vector<Moment>& all() const { return moments_; }

 private:
  static constexpr double kLookEvery = 0.01;  // s, as often as the demo's hands are recorded
  double begin_, part_, next_look_ = begin_;
  std::vector<Moment> moments_;
  std::vector<double> best_;
};

std::string ContactName(int contact, const Scene& scene) {
  if (contact == simulation::kNoContact) return "none";
  if (contact == simulation::kBackdropContact) return "backdrop";
  return scene.tissues[static_cast<std::size_t>(contact - 1)].name;
}

void Run(const DemoJob& job) {
  const Progress progress = TerminalProgress();
  PartialFolder folder(job.folder);
  const fs::path demo = ResourceFolder() / "demo";
  const LoadedScene loaded = LoadScene(demo);
  const auto trace = simulation::ReadTrace(demo / "trace.csv");
  simulation::ReplayReport report;
  if (trace.empty()) throw Error(Code::kBadData, "the demo's trace has no row", demo);
  Moments moments(trace.front().sample.t, trace.back().sample.t, job.pictures);
  const auto rows =
      simulation::Replay(loaded, {trace}, {}, progress, &report, ShippedTissuePresets(),
                         [&](double t, const auto& snapshot, const auto* world) {
                           moments.Watch(t, snapshot, world);
                         });
  for (const std::string& message : report.messages)
    fmt::print(stderr, "note: {}\n", PrintableLine(message));

  StillPictures pictures(loaded, ShippedLooks(loaded.scene));
  const simulation::ScopeOptics optics = simulation::OpticsOf(loaded.scene.scope, loaded.lens);
  auto json = ParseJson(simulation::ReportText(report, loaded.scene), Code::kBadData);
  json["pictures"] = nlohmann::json::array();
  LiveTissues tissues;
  const std::size_t count = moments.all().size();
  for (std::size_t i = 0; i < count; ++i) {
    progress.Step("pictures", static_cast<double>(i) / static_cast<double>(count));
    const Moment& moment = moments.all()[i];
    tissues.Forget();  // moments are seconds apart
    if (moment.world) {
      tissues.Show(*moment.world, loaded.scene.tissues, pictures.view(), nullptr);
      pictures.eye().Follow(*moment.world);
    }
    pictures.eye().Leave();
    const std::string name = fmt::format("picture_{:02}.png", i + 1);
    // Upright, as surgeons hold it.
    Picture picture = RecordedPicture(moment.snapshot, pictures.eye().MoveTo(moment.snapshot.scope),
                                      optics, {.is_upright = true});
    picture.disturbances.time = moment.t;
    picture.flecks = FlecksIn(loaded.scene.backdrop);
    WriteColourImage(folder.beside() / name, pictures.Draw(picture, job.size));
    const simulation::ToolState& instrument = moment.snapshot.instrument;
    json["pictures"].push_back({{"file", name},
                                {"t", moment.t},
                                {"contact", ContactName(instrument.contact, loaded.scene)},
                                {"force", glm::length(instrument.tip_force)}});
  }
  WriteAtomically(folder.beside() / "forces.csv", simulation::ForcesText(rows, loaded.scene));
  WriteAtomically(folder.beside() / "report.json", json.dump(2) + "\n");
  folder.PutInPlace();
  std::printf(
      "Played %.1f s of practice on \"%s\". In %s:\n  picture_01.png … picture_%02d.png\n"
      "  forces.csv\n  report.json\n",
      report.duration, loaded.scene.title.c_str(),
      fs::absolute(job.folder).lexically_normal().c_str(), job.pictures);
}

}  // namespace

void AddDemoJob(CLI::App& program) {
  auto job = std::make_shared<DemoJob>();
  CLI::App* command = program.add_subcommand(
      "demo", "Play the demo scene without a window: writes pictures, forces and a report.");
  const auto files = JobFiles::Of(*command);
  files
      ->OutputFolder(command->add_option("-o,--output", job->folder, "Folder to write."),
                     {{"picture_[0-9]+[.]png", kPictureFile},
                      {"forces[.]csv", kForcesFile},
                      {"report[.]json", kReplayReportFile}})
      ->capture_default_str();
  AddNumber(*command, "--pictures", job->pictures, {1, 99}, "", "Number of pictures.");
  AddNumber(*command, "--size", job->size, {64, 4096}, "px", "Width and height of a picture.");
  files->Run([job] { Run(*job); });
}

}  // namespace arthro::app
