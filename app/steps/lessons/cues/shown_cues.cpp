#include "app/steps/lessons/cues/shown_cues.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>

#include "app/steps/lessons/lookback/expert.h"
#include "app/steps/lessons/running_attempt.h"
#include "simulation/training/steps/path_pieces.h"

namespace arthro::app {
namespace {

using simulation::AttemptFrame;

constexpr double kPause = 1.0;            // s between two showings of the expert's way
constexpr std::size_t kGhostFrames = 4;   // frames between two points of it
constexpr double kUsualDistance = 0.015;  // m, of what a view shows where no target tells it

const ExerciseTarget& TargetOf(const Exercise& exercise, int target) {
  return exercise.targets[static_cast<std::size_t>(target)];
}

CueMark MarkOf(const Exercise& exercise, const glm::dvec3& place, int target, CueKind kind) {
  const ExerciseTarget& of = TargetOf(exercise, target);
  return {kind, {place, of.radius}, of.id, !of.regions.empty()};
}

// Bodies of the tissue now; without them the surface of the scene.
void AddBorder(const EditorState& state, const ExerciseTarget& target, ShownCues& shown) {
  const authoring::Document& document = state.document();
  const auto& tissues = document.scene.tissues;
  const auto owner = std::ranges::find(tissues, target.on, &Tissue::name);
  if (owner == tissues.end()) return;
  const auto index = static_cast<int>(owner - tissues.begin());
  std::vector<Ball> balls;
  for (const Region& region : owner->regions)
    if (std::ranges::find(target.regions, region.name) != target.regions.end())
      balls.push_back(Scaled(region.ball, owner->pose.scale));
  const Rigid3 portal_from_body{owner->pose.quaternion, owner->pose.position};
  std::vector<OutlinePiece> border;
  const simulation::WorldPicture* world = state.practice ? state.practice->tissues() : nullptr;
  const simulation::BodyPicture* body = nullptr;
  if (world != nullptr)
    for (const simulation::BodyPicture& each : world->bodies)
      if (each.tissue == index && each.skin != nullptr) body = &each;
  if (body != nullptr) {
    border = BorderOnSkin(body->skin->surface, body->positions, balls, portal_from_body);
  } else {
    SurfaceMesh rest = OrEmpty(document.surfaces[static_cast<std::size_t>(index)]);
    for (glm::dvec3& x : rest.vertices) x *= owner->pose.scale;
    border = BorderOnSkin(rest, rest.vertices, balls, portal_from_body);
  }
  shown.remove.insert(shown.remove.end(), border.begin(), border.end());
}

// Corners of a path that a tip or a view follows; empty for other steps, and while one is unknown.
std::vector<glm::dvec3> PathOf(const Exercise& exercise, const AttemptFrame& frame,
                               const ExerciseStep& step) {
  std::vector<glm::dvec3> path;
  if (!std::holds_alternative<TrackStep>(step) && !std::holds_alternative<FollowStep>(step))
    return path;
  for (const int target : simulation::TargetsOf(exercise, step)) {
    const auto place = simulation::PlaceOf(exercise, frame, target);
    if (!place) return {};
    path.push_back(*place);
  }
  return path;
}

// Place that a frame of the expert shows: the tip of the instrument, or what the view is centred
// on, as far away as the target.
std::optional<glm::dvec3> GhostIn(const AttemptFrame& frame, bool uses_tip, int target) {
  const auto& tool = frame.tool[Index(uses_tip ? simulation::DeviceRole::kInstrument
                                               : simulation::DeviceRole::kScope)];
  if (!tool.is_inside()) return std::nullopt;
  if (uses_tip) return glm::dvec3(tool.drawn_tip);
  const simulation::Pointer view = simulation::ViewPointer(frame);
  double distance = kUsualDistance;
  if (target >= 0 && target < frame.sight.targets)
    if (const double seen = frame.sight.target[static_cast<std::size_t>(target)].distance; seen > 0)
      distance = seen;
  return view.origin + distance * *view.axis;
}

void AddGhost(const Expert& expert, const RunningAttempt& running, const simulation::StripCue& cue,
              ShownCues& shown) {
  const ExerciseStep& step = running.engine.exercise().steps[static_cast<std::size_t>(cue.step)];
  const auto result = std::ranges::find(expert.steps, BaseOf(step).id, &simulation::StepResult::id);
  if (result == expert.steps.end() || !result->ended || expert.frames.empty()) return;
  const auto frame_at = [&](double t) {
    const double last = static_cast<double>(expert.frames.size() - 1);
    return static_cast<std::size_t>(std::clamp(t / simulation::kFrameTime, 0.0, last));
  };
  const bool uses_tip = simulation::UsesInstrument(step);
  const std::size_t first = frame_at(result->began), last = frame_at(*result->ended);
  for (std::size_t k = first; k <= last; k += kGhostFrames)
    if (const auto place = GhostIn(expert.frames[k], uses_tip, cue.target))
      shown.ghost.push_back(*place);
  // It is shown again and again, at the speed of the expert.
  const double took = *result->ended - result->began;
  const double since = std::fmod(running.engine.strip().time, took + kPause);
  shown.ghost_now =
      GhostIn(expert.frames[frame_at(result->began + std::min(since, took))], uses_tip, cue.target);
}

}  // namespace

std::vector<OutlinePiece> BorderOnSkin(const SurfaceMesh& rest, std::span<const glm::dvec3> now,
                                       std::span<const Ball> balls,
                                       const Rigid3& portal_from_body) {
  std::vector<OutlinePiece> border;
  if (balls.empty() || now.size() != rest.vertices.size()) return border;
  // Distance from the nearest ball's surface; negative inside.
  std::vector<double> outside(rest.vertices.size(), std::numeric_limits<double>::infinity());
  for (std::size_t v = 0; v < outside.size(); ++v)
    for (const Ball& ball : balls)
      outside[v] = std::min(outside[v], glm::distance(rest.vertices[v], ball.centre) - ball.radius);
  for (const std::array<int, 3>& triangle : rest.triangles) {
    std::array<glm::dvec3, 3> crossing;
    std::size_t crossings = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto p = static_cast<std::size_t>(triangle[i]),
                 q = static_cast<std::size_t>(triangle[(i + 1) % 3]);
      if ((outside[p] < 0) == (outside[q] < 0)) continue;
      crossing[crossings++] = glm::mix(now[p], now[q], outside[p] / (outside[p] - outside[q]));
    }
    if (crossings != 2) continue;
    const auto x = [&](std::size_t i) { return now[static_cast<std::size_t>(triangle[i])]; };
    const glm::dvec3 across = glm::cross(x(1) - x(0), x(2) - x(0));
    const double area = glm::length(across);
    if (!(area > 0)) continue;
    border.push_back({portal_from_body * crossing[0], portal_from_body * crossing[1],
                      portal_from_body.rotation * (across / area)});
  }
  return border;
}

ShownCues CuesOf(const EditorState& state) {
  ShownCues shown;
  const LessonsStep& lessons = *state.steps.lessons;
  if (!lessons.running || lessons.running->frames.empty()) return shown;
  const RunningAttempt& running = *lessons.running;
  const Exercise& exercise = running.engine.exercise();
  const AttemptFrame& frame = running.frames.back();
  const simulation::StripState& strip = running.engine.strip();
  shown.goal = strip.goal;
  bool spares = !strip.cues.empty();
  for (const simulation::OpenStep& open : strip.open) {
    const ExerciseStep& step = exercise.steps[static_cast<std::size_t>(open.step)];
    if (std::vector<glm::dvec3> path = PathOf(exercise, frame, step); path.size() > 1)
      shown.paths.push_back(std::move(path));
    if (!std::holds_alternative<ResectStep>(step)) continue;
    spares = true;
    for (const int target : simulation::TargetsOf(exercise, step))
      AddBorder(state, TargetOf(exercise, target), shown);
  }
  const Expert* expert = running.expert.get();
  for (const simulation::StripCue& cue : strip.cues) {
    if (cue.kind == CueKind::kGhost && expert != nullptr && shown.ghost.empty())
      AddGhost(*expert, running, cue, shown);
    if (cue.kind == CueKind::kGhost && !shown.ghost.empty()) continue;
    // Without an expert the outline stands in for the ghost.
    const CueKind kind = cue.kind == CueKind::kGhost ? CueKind::kOutline : cue.kind;
    if (const auto place = simulation::PlaceOf(exercise, frame, cue.target))
      shown.cues.push_back(MarkOf(exercise, *place, cue.target, kind));
  }
  if (!spares) return shown;
  for (const AvoidZone& zone : exercise.avoid) {
    const int target = simulation::TargetIndex(exercise, zone.target);
    if (const auto place = simulation::PlaceOf(exercise, frame, target))
      shown.spare.push_back(MarkOf(exercise, *place, target, CueKind::kOutline));
  }
  return shown;
}

}  // namespace arthro::app
