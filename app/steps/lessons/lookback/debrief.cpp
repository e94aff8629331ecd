// The look back at an attempt: a position in its frames, and the hands as they were there.
#include <algorithm>
#include <cmath>

#include "app/steps/lessons/lessons_step.h"

namespace arthro::app {

const simulation::AttemptFrame* DebriefFrame(const EditorState& state) {
  const LessonsStep& step = *state.steps.lessons;
  if (step.page != LessonPage::kDebrief || !step.finished || step.finished->frames.empty())
    return nullptr;
  const auto& frames = step.finished->frames;
  const auto last = static_cast<double>(frames.size() - 1);
  const double at = std::clamp(std::floor(step.debrief.at / simulation::kFrameTime), 0.0, last);
  return &frames[static_cast<std::size_t>(at)];
}

void PlayDebrief(EditorState& state, double seconds) {
  LessonsStep& step = *state.steps.lessons;
  if (step.page != LessonPage::kDebrief || !step.finished || !step.debrief.plays) return;
  const double end = simulation::kFrameTime * static_cast<double>(step.finished->frames.size());
  step.debrief.at = std::min(end, step.debrief.at + step.debrief.speed * seconds);
  if (step.debrief.at >= end) step.debrief.plays = false;
}

}  // namespace arthro::app
