#include "app/steps/lessons/lookback/touches.h"

#include <array>
#include <cmath>
#include <map>

#include "simulation/device/device_sample.h"
#include "simulation/tissue/body/tissue_preset.h"

namespace arthro::app {
namespace {

constexpr double kDab = 0.5e-3;  // m, as the metric marked_area counts

TouchGrade GradeOf(double force) {
  constexpr double kCare = 3.0;  // N, as the bar of the practice shows it
  return force > simulation::kSafeProbingForce ? TouchGrade::kHarm
         : force > kCare                       ? TouchGrade::kCare
                                               : TouchGrade::kLight;
}

}  // namespace

std::vector<TouchMark> TouchesOf(std::span<const simulation::AttemptFrame> frames) {
  std::vector<TouchMark> touches;
  std::map<std::array<long, 3>, TouchGrade> known;
  for (std::size_t k = 0; k < frames.size(); ++k) {
    if (frames[k].is_paused) continue;
    for (const simulation::ToolFrame& tool : frames[k].tool) {
      if (!tool.is_inside() || tool.contact == simulation::kNoContact) continue;
      const glm::dvec3 place(tool.drawn_tip);
      const std::array<long, 3> dab{std::lround(place.x / kDab), std::lround(place.y / kDab),
                                    std::lround(place.z / kDab)};
      const TouchGrade grade = GradeOf(tool.peak_force);
      const auto before = known.find(dab);
      if (before != known.end() && before->second >= grade) continue;
      known[dab] = grade;
      touches.push_back({simulation::kFrameTime * static_cast<double>(k), place, grade});
    }
  }
  return touches;
}

}  // namespace arthro::app
