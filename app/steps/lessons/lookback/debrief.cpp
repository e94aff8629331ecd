// The look back at an attempt: a position in its frames, and the hands as they were there.
#include <algorithm>
#include <cmath>

#include "app/steps/lessons/lessons_step.h"
#include "app/steps/lessons/lookback/expert.h"
#include "app/steps/lessons/running_attempt.h"
#include "simulation/training/steps/exercise_index.h"
#include "simulation/training/steps/same_moment.h"

namespace arthro::app {
namespace {

// Frame that ends after `t`, or the last one; `frames` has one at least.
const simulation::AttemptFrame& FrameAt(const std::vector<simulation::AttemptFrame>& frames,
                                        double t) {
  const auto last = static_cast<double>(frames.size() - 1);
  const double at = std::clamp(std::floor(t / simulation::kFrameTime), 0.0, last);
  return frames[static_cast<std::size_t>(at)];
}

const Expert* ShownExpert(const EditorState& state) {
  const Expert* expert = state.steps.lessons->debrief.expert.get();
  return DebriefFrame(state) != nullptr && expert != nullptr && !expert->frames.empty() ? expert
                                                                                        : nullptr;
}

double MomentOfExpert(const EditorState& state, const Expert& expert) {
  return simulation::SameMoment(state.steps.lessons->finished->result.steps, expert.steps,
                                state.steps.lessons->debrief.at);
}

}  // namespace

const simulation::AttemptFrame* DebriefFrame(const EditorState& state) {
  const LessonsStep& step = *state.steps.lessons;
  if (step.page != LessonPage::kDebrief || !step.finished || step.finished->frames.empty())
    return nullptr;
  return &FrameAt(step.finished->frames, step.debrief.at);
}

const simulation::WorldPicture* DebriefTissues(const EditorState& state) {
  if (DebriefFrame(state) == nullptr) return nullptr;
  const FinishedAttempt& attempt = *state.steps.lessons->finished;
  return attempt.track ? &attempt.track->At(state.steps.lessons->debrief.at) : nullptr;
}

const simulation::AttemptFrame* ExpertFrame(const EditorState& state) {
  const Expert* expert = ShownExpert(state);
  return expert != nullptr ? &FrameAt(expert->frames, MomentOfExpert(state, *expert)) : nullptr;
}

const simulation::WorldPicture* ExpertTissues(const EditorState& state) {
  const Expert* expert = ShownExpert(state);
  if (expert == nullptr || !expert->track) return nullptr;
  return &expert->track->At(MomentOfExpert(state, *expert));
}

std::vector<Ball> ShownLooseBodies(const EditorState& state) {
  const LessonsStep& step = *state.steps.lessons;
  if (const simulation::AttemptFrame* frame = DebriefFrame(state))
    return simulation::LooseBodiesIn(step.finished->exercise.targets, *frame);
  if (!step.running || step.running->frames.empty()) return {};
  return simulation::LooseBodiesIn(step.running->engine.exercise().targets,
                                   step.running->frames.back());
}

std::vector<Ball> ExpertLooseBodies(const EditorState& state) {
  const simulation::AttemptFrame* frame = ExpertFrame(state);
  if (frame == nullptr) return {};
  return simulation::LooseBodiesIn(state.steps.lessons->finished->exercise.targets, *frame);
}

void PlayDebrief(EditorState& state, double seconds) {
  LessonsStep& step = *state.steps.lessons;
  if (step.page != LessonPage::kDebrief || !step.finished || !step.debrief.plays) return;
  const double end = simulation::kFrameTime * static_cast<double>(step.finished->frames.size());
  step.debrief.at = std::min(end, step.debrief.at + step.debrief.speed * seconds);
  if (step.debrief.at >= end) step.debrief.plays = false;
}

}  // namespace arthro::app
