// Writes down what is done in the window as lines of a script (app/state/script_record.h), once per
// frame: items that were used by name; what was done over a picture as points from its middle;
// hands that were moved as poses, in full precision, before the next act that depends on them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <glm/vec2.hpp>

#include "app/platform/widget_registry.h"
#include "app/state/editor_state.h"

namespace arthro::app {

// Mouse of a frame, in window coordinates.
struct FramePointer {
  glm::dvec2 place{0.0};
  bool down[3] = {false, false, false};
  double wheel = 0;
  bool shift = false, ctrl = false;
  bool enter = false, escape = false;  // go down
};

class ScriptRecorder {
 public:
  // After the panels of a frame. `busy`: work runs beside the window. `width`, `height`: of the
  // window at scale 1. `keeps_stroke`: a drag over the scope's picture does more than swing it.
  void Follow(EditorState& state, const WidgetRegistry& widgets, const FramePointer& pointer,
              double scale, int width, int height, bool busy, bool keeps_stroke);

 private:
  struct Stroke {
    std::string name;
    int button = 0;
    bool shift = false, ctrl = false;
    glm::dvec2 middle{0.0};  // middle of the picture, window coordinates
    std::vector<glm::dvec2> points;
    long long state_id = 0;  // state of the history when it began
  };
  void Begin(EditorState& state, int width, int height);
  void AddPose(ScriptRecord& record, const EditorState& state);
  void FollowPicture(EditorState& state, const WidgetRegistry& widgets, const FramePointer& pointer,
                     double scale, bool keeps_stroke);
  void EndStroke(EditorState& state, double scale, bool keeps_stroke);

  bool is_on_ = false, was_busy_ = false, needs_wait_ = false, had_dialog_ = false,
       had_any_dialog_ = false;
  std::optional<Stroke> stroke_;
  FramePointer last_;
  std::optional<simulation::RodPose> scope_, instrument_;  // the last that were written
};

}  // namespace arthro::app
