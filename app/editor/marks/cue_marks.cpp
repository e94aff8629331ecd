#include "app/editor/marks/cue_marks.h"

#include <cmath>
#include <string>

#include <glm/geometric.hpp>
#include <imgui.h>

#include "app/platform/theme.h"
#include "app/steps/lessons/lessons_step.h"
#include "app/steps/lessons/running_attempt.h"

namespace arthro::app {
namespace {

constexpr unsigned kCue = 0xFF60E8F8;    // yellow
constexpr unsigned kOther = 0xFFE8D8C8;  // targets that are not chosen

// Draws over the picture's own window.
class Marks {
 public:
  Marks(Ui& ui, const Area& picture, const simulation::ScopeView& view,
        const simulation::ScopeOptics& optics, unsigned colour = kCue)
      : ui_(ui), picture_(picture), view_(view), optics_(optics), colour_(colour) {}

  void Mark(const glm::dvec3& x_in_portal, const std::string& name) const {
    const glm::dvec3 way = x_in_portal - view_.tip;
    const glm::dvec2 place = simulation::PlaceOf(optics_, view_, way);
    const double from_centre = glm::length(place);
    if (from_centre <= 1.0)
      Ring(place, name);
    else
      Arrow(std::isfinite(from_centre) ? place / from_centre : glm::dvec2(0, 1));
  }

 private:
  ImVec2 At(const glm::dvec2& place) const {
    const double radius = 0.5 * picture_.width;
    return {static_cast<float>(picture_.x + radius * (1 + place.x)),
            static_cast<float>(picture_.y + radius * (1 - place.y))};
  }
  void Ring(const glm::dvec2& place, const std::string& name) const {
    ImDrawList* draw = ImGui::GetWindowDrawList();
    const ImVec2 at = At(place);
    draw->AddCircle(at, ui_.Px(14), kMarkShadow, 32, ui_.Px(4));
    draw->AddCircle(at, ui_.Px(14), colour_, 32, ui_.Px(2));
    draw->AddText({at.x + ui_.Px(18) + 1, at.y - ui_.Px(8) + 1}, kMarkShadow, name.c_str());
    draw->AddText({at.x + ui_.Px(18), at.y - ui_.Px(8)}, colour_, name.c_str());
  }
  void Arrow(const glm::dvec2& towards) const {
    const glm::dvec2 across(-towards.y, towards.x);
    ImGui::GetWindowDrawList()->AddTriangleFilled(At(0.97 * towards),
                                                  At(0.88 * towards + 0.05 * across),
                                                  At(0.88 * towards - 0.05 * across), colour_);
  }

  Ui& ui_;
  const Area& picture_;
  const simulation::ScopeView& view_;
  const simulation::ScopeOptics& optics_;
  unsigned colour_;
};

// Targets of the step under way, while its cue is due.
void Cue(const Marks& marks, const RunningAttempt& running) {
  const auto& strip = running.engine.strip();
  if (strip.goal) marks.Mark(*strip.goal, "");
  if (!strip.is_cue_due || strip.step < 0 || running.frames.empty()) return;
  const Exercise& exercise = running.engine.exercise();
  const auto& wanted = BaseOf(exercise.steps[static_cast<std::size_t>(strip.step)]).targets;
  const auto& sight = running.frames.back().sight;
  for (std::size_t i = 0; i < exercise.targets.size(); ++i)
    if (std::find(wanted.begin(), wanted.end(), exercise.targets[i].id) != wanted.end() &&
        !sight.target[i].is_gone)
      marks.Mark(glm::dvec3(sight.target[i].place), exercise.targets[i].id);
}

}  // namespace

void MarkTargets(Ui& ui, const EditorState& state, const Area& window, const Area& picture,
                 const simulation::ScopeView& view, const simulation::ScopeOptics& optics) {
  const LessonsStep& step = *state.steps.lessons;
  if (!step.running) return;
  const FixedWindow same(ui, "picture", window, kPictureWindow);
  Cue(Marks(ui, picture, view, optics), *step.running);
}

void MarkTarget(Ui& ui, const Area& picture, const simulation::ScopeView& view,
                const simulation::ScopeOptics& optics, const glm::dvec3& x_in_portal,
                const std::string& name, bool is_bright) {
  Marks(ui, picture, view, optics, is_bright ? kCue : kOther).Mark(x_in_portal, name);
}

}  // namespace arthro::app
