// Tissue track of ten minutes at the meniscus of the demo scene: half of them with the probe, half
// with the shaver, which touch it most of the time. Prints the size of the log with its frames, how
// long a look back takes to come to a moment, and how far the tissue that it shows is from the
// tissue of the session. `--minutes N` for a longer or shorter one.
#include <cstdlib>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "simulation/core/units.h"
#include "simulation/scene/files/scene_io.h"
#include "simulation/training/robot/robot_hands.h"
#include "simulation/training/robot/robot_joint.h"
#include "simulation/training/track/tissue_track.h"
#include "tests/benchmark/bench_report.h"
#include "tests/support/build_paths.h"
#include "tests/support/temp_folder.h"

namespace arthro::simulation {
namespace {

constexpr int kFramesPerLeg = 250;  // from one place to the next
constexpr double kAway = 4e-3;      // m, between places
constexpr double kIn = -1.5e-3;     // m, pressed
constexpr int kSampleEvery = 37;    // frames between worlds that are compared

// The session's tissue at a moment.
struct Sample {
  double t = 0;
  std::size_t body = 0;
  std::vector<glm::dvec3> positions;
  bool is_asleep = false;
};

// Places of the meniscus that the portal of the instrument faces, portal frame.
std::vector<glm::dvec3> PlacesToTouch(const LoadedScene& loaded, const glm::dvec3& portal) {
  const Tissue& tissue = loaded.scene.tissues.at(0);
  const SurfaceMesh& surface = OrEmpty(loaded.surfaces.at(0));
  const Rigid3 portal_from_tissue{tissue.pose.quaternion, tissue.pose.position};
  std::vector<glm::dvec3> places;
  for (const auto& triangle : surface.triangles) {
    const auto at = [&](std::size_t k) {
      return portal_from_tissue * surface.vertices[static_cast<std::size_t>(triangle[k])];
    };
    const glm::dvec3 normal = glm::cross(at(1) - at(0), at(2) - at(0));
    if (glm::dot(normal, portal - at(0)) > 0.6 * glm::length(normal) * glm::length(portal - at(0)))
      places.push_back((at(0) + at(1) + at(2)) / 3.0);
  }
  return places;
}

double Megabytes(double bytes) { return 1e-6 * bytes; }

void Run(test::BenchReport& report, double minutes) {
  const std::filesystem::path resources = std::filesystem::path(ARTHRO_SOURCE_DIR) / "resources";
  const LoadedScene loaded = LoadScene(resources / "demo");
  Exercise exercise;
  for (const Exercise& each : loaded.scene.exercises)
    if (each.id == "probe-five") exercise = each;
  // One step that is never done: with the instrument, the tissue lives.
  exercise.steps.resize(1);
  std::get<ProbeStep>(exercise.steps[0]).hold = 1e9;
  exercise.limits = {};
  const test::TempFolder folder;
  const std::filesystem::path file = folder / "a.attempt";
  const auto frames = static_cast<long>(6000 * minutes);
  std::vector<Sample> samples;
  {
    AttemptLog log(file, std::vector<LogSource>{{"", "", "1", {}}}, "{}");
    RobotJoint joint(loaded, exercise, ReadTissuePresets(resources / "presets" / "tissues"), &log);
    std::mt19937 random(21);
    std::uniform_real_distribution<double> tremor(-2e-5, 2e-5);
    const glm::dvec3 portal = joint.instrument_portal();
    const auto places = PlacesToTouch(loaded, portal);
    glm::dvec3 from = places[random() % places.size()], to = from;
    RobotHands hands = joint.hands();
    for (long k = 0; k < frames; ++k) {
      const long leg = k % kFramesPerLeg;
      if (leg == 0) from = std::exchange(to, places[random() % places.size()]);
      const double share = static_cast<double>(leg) / kFramesPerLeg;
      const glm::dvec3 place = glm::mix(from, to, MinimumJerk(std::min(1.0, 3 * share)));
      const double depth = glm::mix(
          kAway, kIn, MinimumJerk(std::clamp(3 * std::min(share, 1.1 - share) - 0.6, 0., 1.)));
      const glm::dvec3 tip = place + depth * glm::normalize(portal - place) +
                             glm::dvec3(tremor(random), tremor(random), tremor(random));
      hands.instrument = PoseOfTip(portal, tip, 0.3 * share);
      hands.scope.roll = 0.2 * std::sin(1e-3 * static_cast<double>(k));
      const bool shaves = k >= frames / 2;
      hands.closes = shaves && share > 0.5;
      joint.SetInstrument(shaves ? ToolKind::kShaver : ToolKind::kProbe);
      joint.Advance(hands);
      if (k % kSampleEvery != 0 || joint.tissues() == nullptr) continue;
      const auto& bodies = joint.tissues()->bodies;
      for (std::size_t i = 0; i < bodies.size(); ++i)
        samples.push_back({kFrameTime * static_cast<double>(joint.frames().size()),
                           static_cast<std::size_t>(bodies[i].tissue), bodies[i].positions,
                           bodies[i].report.is_asleep});
      if (k % 6000 == 0) {
        fmt::print(stderr, "{:.0f} min: {:.1f} mm³ taken\n", static_cast<double>(k) / 6000,
                   1e9 * bodies.front().cut.removed);
        std::fflush(stderr);
      }
    }
    log.Close();
  }

  const RecordedAttempt attempt = ReadAttempt(file);
  double bytes = 0;
  long whole = 0;
  for (const TrackPiece& piece : attempt.track) {
    bytes += static_cast<double>(piece.bytes.size());
    whole += piece.bytes.front() == static_cast<char>(PieceKind::kWhole);
  }
  fmt::print("{:g} min: log {:.2f} MB, of it track {:.2f} MB in {} pieces, {} of them whole\n",
             minutes, Megabytes(static_cast<double>(std::filesystem::file_size(file))),
             Megabytes(bytes), attempt.track.size(), whole);

  TissueTrack track(attempt.track);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> any(0, kFrameTime * static_cast<double>(frames));
  report.Measure(
      "come to a random moment", 1, [&] { test::KeepAlive(track.At(any(random))); }, "",
      report.quick() ? 3 : 2000);
  double t = 0;
  report.Measure(
      "play on by 1/30 s", 1, [&] { test::KeepAlive(track.At(t += 1.0 / 30)); }, "",
      report.quick() ? 3 : 2000);

  double largest = 0, largest_asleep = 0, squares = 0, count = 0;
  long other = 0;
  for (const Sample& sample : samples) {
    const WorldPicture& world = track.At(sample.t);
    for (const BodyPicture& body : world.bodies) {
      if (static_cast<std::size_t>(body.tissue) != sample.body) continue;
      if (body.positions.size() != sample.positions.size()) {
        ++other;  // a cut since the last piece
        continue;
      }
      for (std::size_t i = 0; i < body.positions.size(); ++i) {
        const double error = glm::distance(body.positions[i], sample.positions[i]);
        largest = std::max(largest, error);
        if (sample.is_asleep) largest_asleep = std::max(largest_asleep, error);
        squares += error * error;
        count += 1;
      }
    }
  }
  fmt::print(
      "error against the session, in {} samples: {:.2f} µm rms, {:.0f} µm at most (up to 1/15 s "
      "late), {:.2f} µm at most at rest; {} samples with a cut that was shown within 1/15 s\n",
      samples.size(), 1e6 * std::sqrt(squares / std::max(1.0, count)), 1e6 * largest,
      1e6 * largest_asleep, other);
}

}  // namespace
}  // namespace arthro::simulation

int main(int argc, char** argv) {
  arthro::test::BenchReport report("tissue track", argc, argv);
  double minutes = report.quick() ? 0.1 : 10;
  for (int i = 1; i + 1 < argc; ++i)
    if (std::string(argv[i]) == "--minutes") minutes = std::atof(argv[i + 1]);
  arthro::simulation::Run(report, minutes);
  return 0;
}
