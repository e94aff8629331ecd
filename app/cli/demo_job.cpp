// arthroscene demo [-o DIR]: the demo scene without a window, as pictures, forces and a report.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "app/cli/job_progress.h"
#include "app/cli/jobs.h"
#include "app/cli/living_tissues_of.h"
#include "app/resource_folder.h"
#include "app/view/still_picture.h"
#include "simulation/core/atomic_file.h"
#include "simulation/core/error.h"
#include "simulation/scene/image_io.h"
#include "simulation/scene/scene_io.h"
#include "simulation/session/replay.h"

namespace arthro::app {
namespace {

namespace fs = std::filesystem;
using simulation::DeviceRole;
using simulation::ForceRow;

struct DemoJob {
  fs::path folder = "arthroscene-demo";
  int pictures = 8;
  int size = 512;
};

// What both hands were doing when a picture is taken.
struct Moment {
  double t = 0;
  simulation::ToolState scope, instrument;
};

// The trace in as many equal parts as there are pictures; of each part the moment of the largest
// force on the instrument, or its middle where nothing was touched.
std::vector<Moment> ChooseMoments(const std::vector<ForceRow>& rows, int count) {
  const double begin = rows.front().t, part = (rows.back().t - begin) / count;
  std::vector<Moment> moments(static_cast<std::size_t>(count));
  std::vector<double> best(moments.size(), -1.0);
  Moment now;
  for (const ForceRow& row : rows) {
    (row.device == DeviceRole::kScope ? now.scope : now.instrument) = row.state;
    now.t = row.t;
    const auto index = static_cast<std::size_t>(
        std::clamp(part > 0.0 ? static_cast<int>((row.t - begin) / part) : 0, 0, count - 1));
    const double middle = begin + (static_cast<double>(index) + 0.5) * part;
    const double force = glm::length(now.instrument.tip_force);
    // Below a thousandth of a newton nothing is touched; then nearness to the middle decides.
    const double score = force > 1e-3 ? 1.0 + force : 1.0 / (1.0 + std::abs(now.t - middle));
    if (score > best[index]) {
      best[index] = score;
      moments[index] = now;
    }
  }
  return moments;
}

std::string ContactName(int contact, const Scene& scene) {
  if (contact == simulation::kNoContact) return "none";
  if (contact == simulation::kBackdropContact) return "backdrop";
  return scene.tissues[static_cast<std::size_t>(contact - 1)].name;
}

Picture PictureOf(const Moment& moment, const Scene& scene) {
  // The camera head is held upright, as surgeons do, while the scope turns in it.
  Picture picture =
      PictureFromPose(moment.scope.pose, scene.scope.view_angle, scene.scope.field_of_view, 0.0);
  if (moment.instrument.fault == simulation::Fault::kNone)
    picture.instrument = InstrumentView{{scene.portals.incision_spacing, 0.0, 0.0},
                                        moment.instrument.proxy_in_portal,
                                        moment.instrument.pose.roll};
  return picture;
}

void Run(const DemoJob& job) {
  const fs::path demo = ResourceFolder() / "demo";
  const LoadedScene loaded = LoadScene(demo);
  const auto trace = simulation::ReadTrace(demo / "trace.csv");
  const Progress progress = TerminalProgress();
  simulation::ReplayReport report;
  const auto rows =
      simulation::Replay(loaded, trace, {}, progress, &report, LivingTissuesOf(loaded));

  std::error_code fault;
  fs::create_directories(job.folder, fault);
  if (fault)
    throw Error(Code::kFile,
                "this folder could not be made: " + fault.message() + "; choose another",
                job.folder);
  StillPictures pictures(loaded);
  auto json = nlohmann::json::parse(simulation::ReportText(report, loaded.scene));
  json["pictures"] = nlohmann::json::array();
  const auto moments = ChooseMoments(rows, job.pictures);
  for (std::size_t i = 0; i < moments.size(); ++i) {
    progress.Step("pictures", static_cast<double>(i) / static_cast<double>(moments.size()));
    const std::string name = fmt::format("picture_{:02}.png", i + 1);
    WriteColourImage(job.folder / name,
                     pictures.Draw(PictureOf(moments[i], loaded.scene), job.size));
    const simulation::ToolState& instrument = moments[i].instrument;
    json["pictures"].push_back({{"file", name},
                                {"t", moments[i].t},
                                {"contact", ContactName(instrument.contact, loaded.scene)},
                                {"force", glm::length(instrument.tip_force)}});
  }
  WriteAtomically(job.folder / "forces.csv", simulation::ForcesText(rows, loaded.scene));
  WriteAtomically(job.folder / "report.json", json.dump(2) + "\n");
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
      "demo", "Play the demo scene without a window: pictures, forces and a report");
  command->add_option("-o,--output", job->folder, "Folder for what is written")
      ->capture_default_str();
  command->add_option("--pictures", job->pictures, "How many moments are shown")
      ->check(CLI::Range(1, 99))
      ->capture_default_str();
  command->add_option("--size", job->size, "Width and height of a picture, px")
      ->check(CLI::Range(64, 4096))
      ->capture_default_str();
  command->callback([job] { Run(*job); });
}

}  // namespace arthro::app
