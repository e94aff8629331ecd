// Cost and error of the arthroscope's closed forms: what a servo tick and a picture pay for them.
#include <cmath>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "simulation/core/units.h"
#include "simulation/scope/arthroscope.h"
#include "tests/benchmark/bench_report.h"

namespace arthro::test {
namespace {

using namespace simulation;

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
  report.Measure("view from rod pose", 1000, [&] { KeepAlive(ViewFromPose(pose, alpha)); });
  // β(ρ) is the angle between the rod and the centre, by its own formula.
  const glm::dvec3 centre = CentreDirection(pose, alpha, radius), u = BasisOf(pose).axis;
  const double beta = std::atan2(glm::length(glm::cross(u, centre)), glm::dot(u, centre));
  report.Measure(
      "centre of the view on the backdrop", 1000,
      [&] { KeepAlive(CentreDirection(pose, alpha, radius)); },
      fmt::format("beta {:.1e} rad", std::abs(beta - CentreAngle(alpha, pose.depth, radius))));
}

}  // namespace
}  // namespace arthro::test

int main(int argc, char** argv) {
  arthro::test::BenchReport report("scope", argc, argv);
  arthro::test::MeasureArthroscope(report);
}
