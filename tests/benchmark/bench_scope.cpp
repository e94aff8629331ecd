// Cost and error of the arthroscope's closed forms (what a servo tick and a picture pay for them)
// and of the pivot calibration, by number of presses.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "app/bench/view/reference_tracer.h"
#include "simulation/core/units.h"
#include "simulation/scope/arthroscope.h"
#include "simulation/scope/pivot_calibration.h"
#include "tests/benchmark/bench_report.h"

namespace arthro::test {
namespace {

using namespace simulation;
using app::ReferenceRay;
using app::ReferenceSphereHit;
using app::ReferenceView;

void MeasureArthroscope(BenchReport& report) {
  DeviceRig rig;
  rig.pivot = {0.01, -0.02, 0.15};
  const RodPose pose{0.2, -0.3, 0.4, 0.02};
  const glm::dvec3 hip = HipFromRodPose(pose, rig);
  const glm::dquat handle = HandleFromRodPose(pose, rig);
  const double alpha = RadiansFromDegrees(30.0), radius = 0.05;

  const RodPose back = RodPoseFromHip(hip, handle, rig, pose);
  report.Measure(
      "rod pose from hand", 1000, [&] { KeepAlive(RodPoseFromHip(hip, handle, rig, pose)); },
      fmt::format("round trip {:.1e} rad",
                  std::hypot(back.latitude - pose.latitude, back.longitude - pose.longitude)));
  const ScopeView view = ViewFromPose(pose, alpha),
                  reference = ReferenceView({0.2, -0.3, 0.4, 0.02, alpha, std::nullopt});
  report.Measure(
      "view from rod pose", 1000, [&] { KeepAlive(ViewFromPose(pose, alpha)); },
      fmt::format("reference {:.1e} rad", std::max({glm::length(view.view - reference.view),
                                                    glm::length(view.up - reference.up),
                                                    glm::length(view.right - reference.right)})));
  // β(ρ) is the angle between the rod and the centre, by its own formula.
  const glm::dvec3 centre = CentreDirection(pose, alpha, radius), u = BasisOf(pose).axis;
  const double beta = std::atan2(glm::length(glm::cross(u, centre)), glm::dot(u, centre));
  report.Measure(
      "centre of the view on the backdrop", 1000,
      [&] { KeepAlive(CentreDirection(pose, alpha, radius)); },
      fmt::format("beta {:.1e} rad", std::abs(beta - CentreAngle(alpha, pose.depth, radius))));
}

// One ray a pixel of a 512 x 512 picture, as a renderer without a GPU would pay.
void MeasureWindow(BenchReport& report) {
  constexpr int kSize = 512;
  const double fov = RadiansFromDegrees(90.0), radius = 0.05;
  const RoundWindow window = WindowOfSize(fov, kSize);
  const ScopeView view = ViewFromPose({0.2, -0.3, 0.4, 0.02}, RadiansFromDegrees(30.0));
  const auto trace = [&](auto&& use) {
    for (int y = 0; y < kSize; ++y)
      for (int x = 0; x < kSize; ++x)
        if (const auto ray = RayFromPixel(window, view, {x, y}))
          use(x, y, SphereHit(view.tip, *ray, radius));
  };
  double worst = 0.0;
  trace([&](int x, int y, const glm::dvec3& hit) {
    const auto ray = ReferenceRay(view, fov, kSize, {x, y});
    if (ray)
      worst = std::max(worst, glm::length(hit - *ReferenceSphereHit(view.tip, *ray, radius)));
  });
  report.Measure(
      "512 x 512 rays to the backdrop", 1,
      [&] { trace([](int, int, const glm::dvec3& hit) { KeepAlive(hit); }); },
      fmt::format("reference {:.1e} m", worst), 60);
}

// Presses with 0.055 mm of noise within a cone of 40 degrees, one in thirty 20 mm off.
void MeasurePivot(BenchReport& report) {
  const glm::dvec3 pivot(0.012, -0.034, 0.11);
  for (int n : {2, 8, 32, 200, 2000}) {
    std::mt19937 random(7);
    std::normal_distribution<double> noise(0.0, 0.055e-3);
    double error2 = 0.0;
    constexpr int kSets = 20;
    std::vector<std::vector<PivotPress>> sets(kSets);
    for (auto& presses : sets) {
      for (int i = 0; i < n; ++i) {
        const double around = 2.0 * std::numbers::pi * i / n, half = RadiansFromDegrees(20.0);
        const glm::dvec3 u(std::sin(half) * std::cos(around), std::sin(half) * std::sin(around),
                           std::cos(half));
        glm::dvec3 hip = pivot - 0.1 * u + glm::dvec3(noise(random), noise(random), noise(random));
        if (i % 30 == 29) hip.x += 0.02;
        presses.push_back({hip, hip + 0.2 * u});
      }
      const double error = glm::length(*CalibratePivot(presses).pivot - pivot);
      error2 += error * error / kSets;
    }
    report.Measure(
        fmt::format("pivot from {} presses", n), n < 32 ? 100 : 1,
        [&] { KeepAlive(CalibratePivot(sets[0])); },
        fmt::format("truth {:.4f} mm rms, predicted {:.4f} mm", MmFromMetres(std::sqrt(error2)),
                    MmFromMetres(CalibratePivot(sets[0]).sigma)),
        n < 2000 ? 300 : 60);
  }
}

}  // namespace
}  // namespace arthro::test

int main(int argc, char** argv) {
  arthro::test::BenchReport report("scope", argc, argv);
  arthro::test::MeasureArthroscope(report);
  arthro::test::MeasureWindow(report);
  arthro::test::MeasurePivot(report);
}
