// Closed forms of the arthroscope, which a servo tick and a picture pay for, and the pivot
// calibration by number of presses.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "app/bench/micro/micro_bench.h"
#include "simulation/core/units.h"
#include "simulation/scope/arthroscope.h"
#include "simulation/scope/pivot_calibration.h"
#include "tests/support/view/reference_tracer.h"

namespace arthro::app {
namespace {

using namespace simulation;
using test::ReferenceRay;
using test::ReferenceSphereHit;
using test::ReferenceView;

constexpr double kFieldOfView = RadiansFromDegrees(90.0), kSphereRadius = 0.05;
constexpr double kViewAngle = RadiansFromDegrees(30.0);
constexpr RodPose kPose{0.2, -0.3, 0.4, 0.02};

void AddClosedForms(std::vector<MicroFunction>& functions) {
  DeviceRig rig;
  rig.pivot = {0.01, -0.02, 0.15};
  const glm::dvec3 hip = HipFromRodPose(kPose, rig);
  const glm::dquat handle = HandleFromRodPose(kPose, rig);
  functions.push_back(
      {"rod pose from hand", [=] { KeepAlive(RodPoseFromHip(hip, handle, rig, kPose)); },
       [=] {
         const RodPose back = RodPoseFromHip(hip, handle, rig, kPose);
         return MicroError{.text = fmt::format("round trip {:.1e} rad",
                                               std::hypot(back.latitude - kPose.latitude,
                                                          back.longitude - kPose.longitude))};
       }});
  functions.push_back(
      {"view from rod pose", [] { KeepAlive(ViewFromPose(kPose, kViewAngle)); },
       [] {
         const ScopeView view = ViewFromPose(kPose, kViewAngle),
                         reference = ReferenceView({0.2, -0.3, 0.4, 0.02, kViewAngle, {}});
         return MicroError{.text =
                               fmt::format("product of rotations {:.1e} rad",
                                           std::max({glm::length(view.view - reference.view),
                                                     glm::length(view.up - reference.up),
                                                     glm::length(view.right - reference.right)}))};
       }});
  functions.push_back(
      {"centre of the view on the backdrop",
       [] { KeepAlive(CentreDirection(kPose, kViewAngle, kSphereRadius)); },
       [] {
         // β(ρ) is the angle between the rod and the centre, by its own formula.
         const glm::dvec3 centre = CentreDirection(kPose, kViewAngle, kSphereRadius);
         const glm::dvec3 u = BasisOf(kPose).axis;
         const double beta = std::atan2(glm::length(glm::cross(u, centre)), glm::dot(u, centre));
         const double formula = CentreAngle(kViewAngle, kPose.depth, kSphereRadius);
         return MicroError{.text = fmt::format("beta {:.1e} rad", std::abs(beta - formula))};
       }});
}

// One ray per pixel of a 512 x 512 picture, as a renderer without a GPU would pay.
void AddWindow(std::vector<MicroFunction>& functions) {
  constexpr int kSize = 512;
  const auto trace = [](auto&& use) {
    const RoundWindow window = WindowOfSize(kFieldOfView, kSize);
    const ScopeView view = ViewFromPose(kPose, kViewAngle);
    for (int y = 0; y < kSize; ++y)
      for (int x = 0; x < kSize; ++x)
        if (const auto ray = RayFromPixel(window, view, {x, y}))
          use(x, y, SphereHit(view.tip, *ray, kSphereRadius));
  };
  functions.push_back(
      {"512 x 512 rays to the backdrop",
       [trace] { trace([](int, int, const glm::dvec3& hit) { KeepAlive(hit); }); },
       [trace] {
         const ScopeView view = ViewFromPose(kPose, kViewAngle);
         double worst = 0;
         trace([&](int x, int y, const glm::dvec3& hit) {
           if (const auto ray = ReferenceRay(view, kFieldOfView, kSize, {x, y}))
             worst = std::max(
                 worst, glm::length(hit - *ReferenceSphereHit(view.tip, *ray, kSphereRadius)));
         });
         return MicroError{.text = fmt::format("ray tracer {:.1e} m", worst)};
       }});
}

constexpr glm::dvec3 kPivot(0.012, -0.034, 0.11);
constexpr int kPivotSets = 20;

// Presses with 0.055 mm of noise within a cone of 40 degrees, one in thirty 20 mm off.
std::vector<std::vector<PivotPress>> PivotSets(int count) {
  std::mt19937 random(7);
  std::normal_distribution<double> noise(0.0, 0.055e-3);
  std::vector<std::vector<PivotPress>> sets(kPivotSets);
  for (auto& presses : sets)
    for (int i = 0; i < count; ++i) {
      const double around = 2.0 * std::numbers::pi * i / count, half = RadiansFromDegrees(20.0);
      const glm::dvec3 u(std::sin(half) * std::cos(around), std::sin(half) * std::sin(around),
                         std::cos(half));
      glm::dvec3 hip = kPivot - 0.1 * u + glm::dvec3(noise(random), noise(random), noise(random));
      if (i % 30 == 29) hip.x += 0.02;
      presses.push_back({hip, hip + 0.2 * u});
    }
  return sets;
}

void AddPivot(std::vector<MicroFunction>& functions) {
  for (const int count : {2, 8, 32, 200, 2000}) {
    const auto sets = MadeOnce([count] { return PivotSets(count); });
    functions.push_back(
        {fmt::format("pivot from {} presses", count),
         [sets] { KeepAlive(CalibratePivot(sets()[0])); },
         [sets] {
           double error2 = 0;
           for (const auto& presses : sets()) {
             const double error = glm::length(*CalibratePivot(presses).pivot - kPivot);
             error2 += error * error / kPivotSets;
           }
           const double rms = MmFromMetres(std::sqrt(error2));
           return MicroError{rms, fmt::format("{:.4f} mm rms, predicted {:.4f} mm", rms,
                                              MmFromMetres(CalibratePivot(sets()[0]).sigma))};
         }});
  }
}

}  // namespace

MicroGroup ScopeMicro(bool) {
  MicroGroup group{"scope", "error of the pivot, mm rms", "pivot of simulated presses", {}};
  AddClosedForms(group.functions);
  AddWindow(group.functions);
  AddPivot(group.functions);
  return group;
}

}  // namespace arthro::app
