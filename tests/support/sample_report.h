// A report of an attempt with frames: the scope looks at two targets in turn while the instrument
// presses three times, the last time too hard.
#pragma once

#include <cmath>

#include "app/report/attempt_report.h"
#include "tests/support/sample_attempts.h"

namespace arthro::test {

inline app::AttemptReport SampleReport(double seconds = 74) {
  using namespace simulation;
  app::AttemptReport report;
  report.exercise = SampleExercise();
  report.goal = "Touch spine and edge with 0.5 to 3 N, each for half a second, and see both.";
  report.trainee = "T-7F3K";
  report.station = "station-1";
  report.rig = "mouse";
  report.program = "arthroscene 0.1.0";
  report.targets.resize(2);
  report.targets[0].id = "spine";
  report.targets[1].id = "edge";
  app::AttemptRecord& attempt = report.attempt;
  attempt.id = "00000000-0000-4000-8000-000000000001";
  attempt.scene = "Demo knee";
  attempt.started = "2026-11-23T20:30:00.000Z";
  attempt.mode = app::AttemptMode::kTest;
  attempt.metrics_version = 1;
  app::SetResult(attempt, SampleResult(seconds));
  const auto count = static_cast<std::size_t>(seconds / kFrameTime);
  for (std::size_t k = 0; k < count; ++k) {
    const double t = kFrameTime * static_cast<double>(k);
    AttemptFrame& frame = report.frames.emplace_back();
    for (ToolFrame& tool : frame.tool) {
      tool.is_valid = true;
      tool.depth = 0.02F;
    }
    const auto place = [&](double shift, double rate) {
      return glm::vec3(0.006 * std::sin(rate * t) + shift, 0.004 * std::cos(0.7 * rate * t),
                       0.02 + 0.005 * std::sin(0.3 * rate * t));
    };
    frame.tool[0].tip = place(0, 0.4);
    frame.tool[1].tip = place(0.004, 0.9);
    for (const auto& [at, force] : {std::pair(12.0, 2.1), {30.0, 2.8}, {44.4, 9.1}}) {
      const double x = (t - at) / 0.8;
      if (std::abs(x) < 1) {
        frame.tool[1].mean_force = static_cast<float>(0.96 * force * std::cos(1.5708 * x));
        frame.tool[1].peak_force = static_cast<float>(force * std::cos(1.5708 * x));
      }
    }
    frame.sight.targets = 2;
    for (std::size_t i = 0; i < 2; ++i) {
      PointSight& sight = frame.sight.target[i];
      sight.centre =
          static_cast<float>(std::abs(std::sin(0.11 * t + 1.6 * static_cast<double>(i))));
      sight.is_clear = sight.centre < 0.9F;
    }
  }
  return report;
}

}  // namespace arthro::test
