#include "simulation/training/metrics/ghost_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <glm/geometric.hpp>

#include "simulation/training/steps/same_moment.h"

namespace arthro::simulation {
namespace {

// Frames of a step that was done.
std::span<const AttemptFrame> FramesIn(std::span<const AttemptFrame> frames,
                                       std::span<const StepResult> steps, const StepResult& step) {
  const StepTime time = TimeOf(steps, step);
  const auto at = [&](double t) {
    return std::min(frames.size(), static_cast<std::size_t>(std::max(0.0, t / kFrameTime + 0.5)));
  };
  return frames.subspan(at(time.begin), at(time.end) - at(time.begin));
}

// Tips of the tool while it counts.
std::vector<glm::dvec3> TipsIn(std::span<const AttemptFrame> frames, DeviceRole role) {
  std::vector<glm::dvec3> tips;
  for (const AttemptFrame& frame : frames)
    if (const ToolFrame& tool = frame.tool[Index(role)]; !frame.is_paused && tool.is_inside())
      tips.emplace_back(tool.drawn_tip);
  return tips;
}

double DistanceFromWay(const glm::dvec3& x, std::span<const glm::dvec3> way) {
  double nearest = glm::distance(x, way.front());
  for (std::size_t i = 1; i < way.size(); ++i) {
    const glm::dvec3 along = way[i] - way[i - 1], off = x - way[i - 1];
    const double square = glm::dot(along, along);
    const double share = square > 0 ? std::clamp(glm::dot(off, along) / square, 0.0, 1.0) : 0.0;
    nearest = std::min(nearest, glm::length(off - share * along));
  }
  return nearest;
}

}  // namespace

std::optional<double> GhostDistance(std::span<const AttemptFrame> frames,
                                    std::span<const StepResult> steps, const GhostPath& ghost,
                                    DeviceRole role) {
  double sum = 0;
  std::size_t count = 0;
  for (const StepResult& step : steps) {
    const auto same = std::ranges::find(ghost.steps, step.id, &StepResult::id);
    if (step.outcome != StepOutcome::kDone || same == ghost.steps.end() ||
        same->outcome != StepOutcome::kDone)
      continue;
    const std::vector<glm::dvec3> way = TipsIn(FramesIn(ghost.frames, ghost.steps, *same), role);
    if (way.empty()) continue;
    for (const glm::dvec3& tip : TipsIn(FramesIn(frames, steps, step), role)) {
      sum += DistanceFromWay(tip, way);
      ++count;
    }
  }
  return count > 0 ? std::optional(sum / static_cast<double>(count)) : std::nullopt;
}

}  // namespace arthro::simulation
