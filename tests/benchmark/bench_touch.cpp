// What touch costs, with its error beside it: one query of the backdrop (target 0.1 µs) for ours
// and the paper's kernel, and the whole servo tick of two devices in a scene with a mesh of 20 000
// triangles (target 20 µs).
#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "simulation/haptics/contact.h"
#include "simulation/haptics/paper_kernel.h"
#include "simulation/session/scripted_device.h"
#include "simulation/session/session.h"
#include "tests/benchmark/bench_report.h"
#include "tests/support/analytic_relief.h"
#include "tests/support/shapes.h"

namespace arthro::simulation {
namespace {

using test::AnalyticRelief;
using test::BenchReport;
using test::KeepAlive;

// A stroke of 4000 points over the relief, on its exact surface.
std::vector<glm::dvec2> Stroke() {
  std::vector<glm::dvec2> pixels;
  for (int i = 0; i < 4000; ++i) {
    const double t = 1e-3 * i;
    pixels.emplace_back(511.5 + 250 * std::sin(1.1 * t) + 20 * std::sin(7 * t),
                        511.5 + 240 * std::sin(1.7 * t + 0.4));
  }
  return pixels;
}

template <class Query>
std::string NormalError(const AnalyticRelief& relief, Query&& query) {
  std::vector<double> angles;
  for (const glm::dvec2& p : Stroke())
    angles.push_back(DegreesFromRadians(
        2 * std::asin(std::min(
                1.0, glm::length(query(relief.Surface(p)).normal - relief.Normal(p)) / 2))));
  std::sort(angles.begin(), angles.end());
  return fmt::format("normal p99 {:.3f} max {:.3f} deg", angles[angles.size() * 99 / 100],
                     angles.back());
}

void MeasureQueries(BenchReport& report) {
  for (const ProjectionType type : {ProjectionType::kGnomonic, ProjectionType::kEquirectangular}) {
    const AnalyticRelief relief = AnalyticRelief::Waves(type);
    std::vector<glm::dvec3> points;
    for (const glm::dvec2& p : Stroke()) points.push_back(relief.Surface(p));
    const std::string name = type == ProjectionType::kGnomonic ? "gnomonic" : "equirectangular";
    for (const bool is_coarse : {false, true}) {
      const DepthMap map = is_coarse ? relief.EightBit() : relief.Float();
      const DepthField field(relief.backdrop, map);
      const std::string source = name + (is_coarse ? ", 8 bit" : ", float");
      std::size_t i = 0;
      const auto next = [&]() -> const glm::dvec3& { return points[i++ % points.size()]; };
      const auto ours = [&](const glm::dvec3& x) { return field.Query(x); };
      const auto paper = [&](const glm::dvec3& x) { return PaperQuery(relief.backdrop, map, x); };
      report.Measure(
          "depth query, " + source, 1000, [&] { KeepAlive(ours(next())); },
          NormalError(relief, ours));
      report.Measure(
          "paper's kernel, " + source, 1000, [&] { KeepAlive(paper(next())); },
          NormalError(relief, paper));
    }
  }
}

LoadedScene MakeScene(bool has_mesh) {
  const AnalyticRelief relief = AnalyticRelief::Waves(ProjectionType::kGnomonic);
  LoadedScene loaded;
  loaded.scene.backdrop = relief.backdrop;
  loaded.scene.portals.incision_spacing = 0.03;
  loaded.depth = relief.Float();
  if (has_mesh) {
    loaded.scene.tissues.emplace_back();
    loaded.scene.tissues[0].pose.position = {0, 0, 0.042};
    loaded.surfaces.push_back(test::Torus(0.010, 0.003, 125, 80));
  }
  return loaded;
}

// Both tips stroke through backdrop and mesh at up to 30 mm/s; each tick is timed on its own.
void MeasureTicks(BenchReport& report, bool has_mesh) {
  using Clock = std::chrono::steady_clock;
  Session session(MakeScene(has_mesh));
  ScriptedDevice scope(session.scope_rig()), instrument(session.instrument_rig());
  const int ticks = report.quick() ? 50 : 20000;
  std::vector<double> seconds;
  int touching = 0, mesh = 0;
  double first = 0;
  for (int i = 0; i < ticks; ++i) {
    const double t = 1e-3 * i;
    scope.Set(
        {0.25 * std::sin(1.3 * t), 0.25 * std::cos(1.1 * t), t, 0.0455 + 0.001 * std::sin(2 * t)});
    instrument.Set(
        {0.15 * std::sin(0.9 * t), -0.6 + 0.25 * std::sin(t), 0, 0.052 + 0.002 * std::sin(2 * t)});
    const DeviceSample a = scope.Sample(t), b = instrument.Sample(t);
    const Clock::time_point start = Clock::now();
    session.Tick(a, b, 1e-3);
    seconds.push_back(std::chrono::duration<double>(Clock::now() - start).count());
    if (i == 0) first = seconds[0];
    for (const ToolState* tool : {&session.snapshot().scope, &session.snapshot().instrument}) {
      touching += tool->contact >= 0;
      mesh += tool->contact > 0;
    }
  }
  std::sort(seconds.begin(), seconds.end());
  const auto quantile = [&](double q) {
    return seconds[std::min(seconds.size() - 1,
                            static_cast<std::size_t>(q * static_cast<double>(seconds.size())))];
  };
  report.Row(has_mesh ? "tick, two devices, 20 000 triangles" : "tick, two devices, backdrop only",
             {quantile(0.5), quantile(0.99)},
             fmt::format(
                 "p99.9 {:.1f} us, first {:.1f} us; in contact {:.0f} %, with the mesh {:.0f} %",
                 1e6 * quantile(0.999), 1e6 * first, 50.0 * touching / ticks, 50.0 * mesh / ticks));
}

// One contact under the exact surface, with the force's error.
void MeasureContact(BenchReport& report) {
  const AnalyticRelief relief = AnalyticRelief::Waves(ProjectionType::kGnomonic);
  ContactOptions options;
  options.damping = options.static_friction = options.sliding_friction = 0.0;
  std::vector<glm::dvec3> tips, reference;
  for (const glm::dvec2& p : Stroke()) {
    tips.push_back(relief.Surface(p) - 1e-3 * relief.Normal(p));
    reference.push_back(options.stiffness * 1e-3 * relief.Normal(p));
  }
  for (const bool is_coarse : {false, true}) {
    const DepthField field(relief.backdrop, is_coarse ? relief.EightBit() : relief.Float());
    const Surroundings around{field, {}};
    ContactState state;
    double error2 = 0, reference2 = 0;
    const auto tick = [&](std::size_t i) {
      return TickContact(around, options, options.stiffness, {}, tips[i], 1e-3, state).force;
    };
    for (std::size_t i = 0; i < tips.size(); ++i) {
      const glm::dvec3 error = tick(i) - reference[i];
      if (i < 100) continue;
      error2 += glm::dot(error, error);
      reference2 += glm::dot(reference[i], reference[i]);
    }
    std::size_t i = 0;
    report.Measure(
        is_coarse ? "contact tick, one device, 8 bit" : "contact tick, one device, float", 100,
        [&] { KeepAlive(tick(i++ % tips.size())); },
        fmt::format("force rms {:.3f} %", 100 * std::sqrt(error2 / reference2)));
  }
}

void MeasureBuilding(BenchReport& report) {
  for (const bool is_coarse : {false, true}) {
    AnalyticRelief relief = AnalyticRelief::Waves(ProjectionType::kGnomonic);
    relief.width = 2048;
    const DepthMap map = is_coarse ? relief.EightBit() : relief.Float();
    report.Measure(
        is_coarse ? "build field, 2048x1024, 8 bit" : "build field, 2048x1024, float", 1,
        [&] { KeepAlive(DepthField(relief.backdrop, map)); }, "", 5);
  }
  const SurfaceMesh torus = test::Torus(0.010, 0.003, 125, 80);
  report.Measure(
      "build tree, 20 000 triangles", 1, [&] { KeepAlive(SurfaceBvh(torus, {})); }, "", 20);
}

}  // namespace
}  // namespace arthro::simulation

int main(int argc, char** argv) {
  using namespace arthro::simulation;
  arthro::test::BenchReport report("touch", argc, argv);
  MeasureQueries(report);
  MeasureContact(report);
  MeasureTicks(report, false);
  MeasureTicks(report, true);
  MeasureBuilding(report);
}
