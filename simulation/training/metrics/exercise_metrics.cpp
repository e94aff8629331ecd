#include "simulation/training/metrics/exercise_metrics.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include <glm/geometric.hpp>

#include "simulation/training/metrics/metric_collector.h"

namespace arthro::simulation {
namespace {

constexpr int kLossEpisode = 50;         // frames, 0.5 s; a longer loss is an episode
constexpr int kSteadySight = 100;        // frames, 1 s, for which a tip that was found is seen
constexpr double kNearLens = 2e-3;       // m
constexpr double kHazeExtinction = 100;  // 1/m of green light at strength 1
constexpr double kLeastPath = 1e-4;      // m; a shorter one is rounding
constexpr double kDisturbed = 0.55;      // share of the light that is lost

const ToolFrame& InstrumentOf(const AttemptFrame& frame) {
  return frame.tool[Index(DeviceRole::kInstrument)];
}
const ToolFrame& ScopeOf(const AttemptFrame& frame) {
  return frame.tool[Index(DeviceRole::kScope)];
}

bool IsObserved(std::span<const AttemptFrame> frames) {
  return std::any_of(frames.begin(), frames.end(), [](const AttemptFrame& frame) {
    return frame.sight.targets > 0 || frame.sight.is_tip_visible;
  });
}

void MeasureLoss(std::span<const AttemptFrame> frames, MetricCollector& values) {
  int inside = 0, lost = 0, episodes = 0, run = 0;
  for (const AttemptFrame& frame : frames) {
    if (frame.is_paused) continue;
    const bool is_inside = InstrumentOf(frame).is_inside();
    const bool is_lost = is_inside && !frame.sight.is_tip_visible;
    inside += is_inside ? 1 : 0;
    lost += is_lost ? 1 : 0;
    run = is_lost ? run + 1 : 0;
    episodes += run == kLossEpisode + 1 ? 1 : 0;
  }
  const bool is_known = inside > 0 && IsObserved(frames);
  const std::string_view why =
      inside == 0 ? "the instrument was never in the joint" : "the picture was not observed";
  values.Give("tool_loss", "instrument",
              is_known ? std::optional(static_cast<double>(lost) / inside) : std::nullopt, why);
  values.Give("loss_episodes", "instrument",
              is_known ? std::optional<double>(episodes) : std::nullopt, why);
}

std::size_t FrameAt(double t) {
  return static_cast<std::size_t>(std::max(0.0, t / kFrameTime + 0.5));
}

// Time from each start of a step for the instrument until its tip is seen for 1 s, within the step.
void MeasureTriangulation(std::span<const AttemptFrame> frames, const StepEngine& engine,
                          MetricCollector& values) {
  double sum = 0;
  int count = 0;
  const auto& events = engine.events();
  for (std::size_t i = 0; i < events.size(); ++i) {
    if (events[i].kind != EventKind::kStepStart) continue;
    const int step = StepIndex(engine.exercise(), events[i].step);
    if (step < 0 || !UsesInstrument(engine.exercise().steps[static_cast<std::size_t>(step)]))
      continue;
    const auto over = std::find_if(
        events.begin() + static_cast<std::ptrdiff_t>(i), events.end(), [&](const auto& event) {
          return event.step == events[i].step &&
                 (event.kind == EventKind::kStepDone || event.kind == EventKind::kStepFailed);
        });
    const std::size_t last =
        over == events.end() ? frames.size() : std::min(frames.size(), FrameAt(over->t));
    int run = 0, waited = 0;
    for (std::size_t k = FrameAt(events[i].t); k < last; ++k) {
      if (frames[k].is_paused) continue;
      ++waited;
      run = frames[k].sight.is_tip_visible && InstrumentOf(frames[k]).is_inside() ? run + 1 : 0;
      if (run < kSteadySight) continue;
      sum += kFrameTime * (waited - kSteadySight);
      ++count;
      break;
    }
  }
  values.Give("triangulation", "instrument", count > 0 ? std::optional(sum / count) : std::nullopt,
              "no step with the instrument in which its tip was seen for 1 s");
}

double CountOf(const StepEngine& engine, EventKind kind) {
  return static_cast<double>(
      std::count_if(engine.events().begin(), engine.events().end(),
                    [&](const AttemptEvent& event) { return event.kind == kind; }));
}

// Straight legs between the places of a tip at the ends of the steps, per path of that tip.
void MeasureEfficiency(std::span<const AttemptFrame> frames, const StepEngine& engine,
                       const std::vector<MetricValue>& measured, MetricCollector& values) {
  for (const DeviceRole role : kDeviceRoles) {
    const std::string part = role == DeviceRole::kScope ? "scope" : "instrument";
    std::optional<glm::dvec3> last;
    double straight = 0;
    for (const AttemptEvent& event : engine.events()) {
      if (event.kind != EventKind::kStepStart && event.kind != EventKind::kStepDone) continue;
      const std::size_t k = FrameAt(event.t);
      if (k == 0 || k > frames.size()) continue;
      const ToolFrame& tool = frames[k - 1].tool[Index(role)];
      if (!tool.is_inside()) continue;
      if (last) straight += glm::distance(*last, glm::dvec3(tool.tip));
      last = glm::dvec3(tool.tip);
    }
    std::optional<double> path;
    for (const MetricValue& value : measured)
      if (value.metric->id == "path" && value.part == part) path = value.value;
    values.Give(
        "path_efficiency", part,
        path && *path > kLeastPath ? std::optional(std::min(1.0, straight / *path)) : std::nullopt,
        "the tool did not move in the joint");
  }
}

void MeasureScope(std::span<const AttemptFrame> frames, MetricCollector& values) {
  ValueSum horizon;
  int clear = 0, disturbed = 0, near = 0;
  for (const AttemptFrame& frame : frames) {
    if (frame.is_paused || !ScopeOf(frame).is_inside()) continue;
    horizon.Add(
        std::abs(std::remainder(static_cast<double>(frame.head_roll), 2 * std::numbers::pi)));
    if (InstrumentOf(frame).is_inside() &&
        glm::distance(ScopeOf(frame).drawn_tip, InstrumentOf(frame).drawn_tip) <
            static_cast<float>(kNearLens))
      ++near;
    // The target that is nearest to the centre stands for the picture's middle.
    const PointSight* middle = nullptr;
    for (int i = 0; i < frame.sight.targets; ++i) {
      const PointSight& sight = frame.sight.target[static_cast<std::size_t>(i)];
      if (std::isfinite(sight.centre) && (middle == nullptr || sight.centre < middle->centre))
        middle = &sight;
    }
    if (middle == nullptr) continue;
    ++clear;
    const double lost = 1 - std::exp(-kHazeExtinction * static_cast<double>(frame.haze) *
                                     static_cast<double>(middle->distance));
    disturbed += lost >= kDisturbed ? 1 : 0;
  }
  constexpr std::string_view kWhy = "the scope was never in the joint";
  values.Give("horizon", "scope", horizon.mean(), kWhy);
  values.Give("disturbed_share", "scope",
              clear > 0 ? std::optional(static_cast<double>(disturbed) / clear) : std::nullopt,
              "no target was before the scope");
  values.Give("lens_near", "both",
              horizon.count > 0 ? std::optional(kFrameTime * near) : std::nullopt, kWhy);
}

void MeasureTissue(std::span<const AttemptFrame> frames, const StepEngine& engine,
                   MetricCollector& values) {
  const Exercise& exercise = engine.exercise();
  std::optional<double> share;
  for (std::size_t i = 0; i < exercise.targets.size(); ++i) {
    if (exercise.targets[i].regions.empty() || frames.empty() ||
        static_cast<int>(i) >= frames.back().sight.targets)
      continue;
    const double taken = frames.back().sight.target[i].taken_share;
    share = std::min(share.value_or(1.0), taken);
  }
  double outside = 0;
  for (const AttemptFrame& frame : frames) outside += static_cast<double>(frame.taken_outside);
  values.Give("taken_share", "instrument", share, "the exercise has no regions to remove");
  values.Give("taken_outside", "instrument", outside);
  const auto length = [](float value) {
    return value < 0 ? std::nullopt : std::optional<double>(value);
  };
  constexpr std::string_view kUncut = "no tissue with a region to remove was cut";
  values.Give("rim_min", "instrument", frames.empty() ? std::nullopt : length(frames.back().rim),
              kUncut);
  values.Give("contour_rms", "instrument",
              frames.empty() ? std::nullopt : length(frames.back().contour), kUncut);
  int bites = 0, empty = 0;
  for (const AttemptEvent& event : engine.events())
    if (event.kind == EventKind::kBite) ++(event.value > 0 ? bites : empty);
  values.Give("bites", "instrument", bites);
  values.Give("empty_bites", "instrument", empty);
  values.Give("bites_outside", "instrument", CountOf(engine, EventKind::kCutOutside));
}

void MeasureGhost(std::span<const AttemptFrame> frames, const StepEngine& engine,
                  const GhostPath* ghost, MetricCollector& values) {
  const Exercise& exercise = engine.exercise();
  const bool uses_instrument = std::ranges::any_of(exercise.steps, UsesInstrument);
  const DeviceRole role = uses_instrument ? DeviceRole::kInstrument : DeviceRole::kScope;
  std::optional<double> distance;
  if (ghost != nullptr) distance = GhostDistance(frames, engine.steps(), *ghost, role);
  values.Give("ghost_distance", uses_instrument ? "instrument" : "scope", distance,
              exercise.ghost.empty() ? "the exercise has no recording of an expert"
              : ghost == nullptr     ? "the recording of the expert is not at hand"
                                     : "no step was done that the expert has done");
}

std::optional<double> Share(int part, int all) {
  return all > 0 ? std::optional(static_cast<double>(part) / all) : std::nullopt;
}

}  // namespace

std::vector<MetricValue> MeasureExercise(std::span<const AttemptFrame> frames,
                                         const StepEngine& engine,
                                         const std::vector<std::string>& surfaces,
                                         const MetricLimits& limits, const GhostPath* ghost) {
  std::vector<MetricValue> measured = MeasureAttempt(frames, surfaces, limits);
  MetricCollector values;
  for (const MetricValue& value : measured)
    values.Give(value.metric->id, value.part, value.value, value.why_none);
  MeasureEfficiency(frames, engine, measured, values);
  MeasureLoss(frames, values);
  MeasureTriangulation(frames, engine, values);
  MeasureScope(frames, values);
  MeasureTissue(frames, engine, values);
  MeasureGhost(frames, engine, ghost, values);
  const AttemptMeasures& sums = engine.measures();
  constexpr std::string_view kNoStep = "the exercise has no step that measures it";
  values.Give("look_downs", "both", CountOf(engine, EventKind::kLookDown));
  values.Give("seen_share", "scope", Share(sums.seen, sums.to_see), kNoStep);
  values.Give("probed_share", "instrument", Share(sums.probed, sums.to_probe), kNoStep);
  values.Give("centring", "scope", sums.centring.mean(), kNoStep);
  values.Give("distance_error", "scope", sums.distance_error.mean(), kNoStep);
  values.Give("track_error", "both", sums.track_error.rms(), kNoStep);
  values.Give("line_error", "both", sums.line_error.rms(), kNoStep);
  values.Give("measure_error", "instrument", sums.measure_error.mean(), kNoStep);
  values.Give("band_share", "instrument", Share(sums.in_band, sums.pressed),
              "no target to press was touched");
  values.Give("marked_area", "both", sums.marked_area);
  values.Give("drops", "instrument", CountOf(engine, EventKind::kDrop));
  values.Give("zone_entries", "both", CountOf(engine, EventKind::kZoneIn));
  return std::move(values).InOrder();
}

}  // namespace arthro::simulation
