#include "app/editor/script_recorder.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "app/platform/script/script.h"

namespace arthro::app {
namespace {

constexpr double kClickSlack = 4;  // px; a press that moves further is a drag

// The picture under the pointer, unless another item or a dialog lies over it.
const WidgetRecord* PictureAt(const WidgetRegistry& widgets, const glm::dvec2& place) {
  const WidgetRecord* found = nullptr;
  for (const WidgetRecord& widget : widgets.widgets())
    if (widget.visible && widget.reachable && place.x >= widget.x0 && place.x < widget.x1 &&
        place.y >= widget.y0 && place.y < widget.y1)
      if (found == nullptr || found->kind == WidgetKind::kPicture) found = &widget;
  return found != nullptr && found->kind == WidgetKind::kPicture ? found : nullptr;
}

// The number that a slider or field shows, without its unit; a text as it is.
std::string Typed(const WidgetRecord& widget) {
  if (widget.kind == WidgetKind::kText) return widget.value;
  const std::size_t end = widget.value.find_first_not_of("+-.0123456789eE");
  const std::string number = widget.value.substr(0, end);
  return number.empty() ? widget.value : number;
}

std::string PoseLine(const char* hand, const simulation::RodPose& pose) {
  return fmt::format("pose {} {} {} {} {}", hand, pose.depth, pose.latitude, pose.longitude,
                     pose.roll);
}

bool IsSame(const std::optional<simulation::RodPose>& a, const simulation::RodPose& b) {
  return a && a->depth == b.depth && a->latitude == b.latitude && a->longitude == b.longitude &&
         a->roll == b.roll;
}

bool HasFileDialog(const EditorState& state) {
  return !state.dialogs.empty() && std::holds_alternative<BrowseDialog>(state.dialogs.back());
}

bool MayBeginWork(const std::string& line) {
  return line.starts_with("do ") && !line.starts_with("do step-") && line != "do undo" &&
         line != "do redo";
}

std::string Modifiers(bool shift, bool ctrl) {
  return std::string(shift ? " shift" : "") + (ctrl ? " ctrl" : "");
}

}  // namespace

void ScriptRecorder::Begin(EditorState& state, int width, int height) {
  is_on_ = true;
  was_busy_ = needs_wait_ = had_dialog_ = false;
  stroke_.reset();
  scope_.reset(), instrument_.reset();
  auto& lines = state.record.lines;
  // After the comment at the top.
  lines.insert(lines.begin() + 1, fmt::format("resize {} {}", width, height));
  state.record.pending.clear();
  state.record.command_words.clear();
}

// Only where the hands are the author's: those of a practice follow time.
void ScriptRecorder::AddPose(ScriptRecord& record, const EditorState& state) {
  if (state.practice) return;
  if (!IsSame(scope_, state.scope)) record.lines.push_back(PoseLine("scope", state.scope));
  if (!IsSame(instrument_, state.instrument))
    record.lines.push_back(PoseLine("instrument", state.instrument));
  scope_ = state.scope, instrument_ = state.instrument;
}

void ScriptRecorder::EndStroke(EditorState& state, double scale, bool keeps_stroke) {
  const Stroke stroke = std::move(*stroke_);
  stroke_.reset();
  double furthest = 0;
  for (const glm::dvec2& point : stroke.points)
    furthest = std::max(
        furthest, std::hypot(point.x - stroke.points.front().x, point.y - stroke.points.front().y));
  const bool is_click = furthest <= kClickSlack;
  // The scope was swung: its pose says so.
  if (stroke.name == "Picture" && !is_click && !keeps_stroke &&
      stroke.state_id == state.history.StateId())
    return;
  const auto place = [&](const glm::dvec2& point) {
    return fmt::format(" {:g} {:g}", (point.x - stroke.middle.x) / scale,
                       (point.y - stroke.middle.y) / scale);
  };
  const std::string name = ScriptWord(stroke.name);
  if (is_click && !stroke.shift && !stroke.ctrl && stroke.button < 2) {
    state.record.lines.push_back((stroke.button == 0 ? "click " : "right-click ") + name +
                                 place(stroke.points.back()));
    return;
  }
  std::string line = "stroke " + name;
  if (stroke.button > 0) line += stroke.button == 1 ? " right" : " middle";
  line += Modifiers(stroke.shift, stroke.ctrl);
  for (const glm::dvec2& point : stroke.points) line += place(point);
  state.record.lines.push_back(line);
}

void ScriptRecorder::FollowPicture(EditorState& state, const WidgetRegistry& widgets,
                                   const FramePointer& pointer, double scale, bool keeps_stroke) {
  if (stroke_) {
    stroke_->points.push_back(pointer.place);
    if (!pointer.down[stroke_->button]) {
      stroke_->points.pop_back();  // let go where the last frame had it
      EndStroke(state, scale, keeps_stroke);
    }
    return;
  }
  const WidgetRecord* const picture = PictureAt(widgets, pointer.place);
  if (picture == nullptr) return;
  const glm::dvec2 middle = {(picture->x0 + picture->x1) / 2, (picture->y0 + picture->y1) / 2};
  const glm::dvec2 place = (pointer.place - middle) / scale;
  for (int button = 0; button < 3; ++button)
    if (pointer.down[button] && !last_.down[button]) {
      AddPose(state.record, state);
      stroke_ = Stroke{
          widgets.NameOf(*picture), button, pointer.shift, pointer.ctrl, middle, {pointer.place},
          state.history.StateId()};
      return;
    }
  // Over the scope's picture the wheel moves a hand, which its pose tells.
  if (pointer.wheel != 0 && picture->name != "Picture") {
    AddPose(state.record, state);
    state.record.lines.push_back(
        fmt::format("wheel {} {:g} {:g} {:g}{}", ScriptWord(widgets.NameOf(*picture)),
                    pointer.wheel, place.x, place.y, Modifiers(pointer.shift, pointer.ctrl)));
  }
}

void ScriptRecorder::Follow(EditorState& state, const WidgetRegistry& widgets,
                            const FramePointer& pointer, double scale, int width, int height,
                            bool busy, bool keeps_stroke) {
  ScriptRecord& record = state.record;
  if (!record.is_on) {
    is_on_ = false;
    last_ = pointer;
    return;
  }
  if (!is_on_) {
    Begin(state, width, height);
    last_ = pointer;
    return;
  }
  std::vector<WidgetAct> acts = widgets.acts();
  std::stable_sort(acts.begin(), acts.end(),
                   [](const auto& a, const auto& b) { return a.widget < b.widget; });
  const bool in_file_dialog = had_dialog_ || HasFileDialog(state);
  had_dialog_ = HasFileDialog(state);
  const std::size_t before = record.lines.size();
  const bool is_key = (pointer.escape || (pointer.enter && had_any_dialog_)) && acts.empty() &&
                      record.pending.empty() && !in_file_dialog;
  had_any_dialog_ = !state.dialogs.empty();
  if (is_key) record.lines.push_back(pointer.enter ? "key enter" : "key escape");
  if (!in_file_dialog) {
    for (const WidgetAct& act : acts) {
      const WidgetRecord& widget = widgets.widgets()[act.widget];
      if (std::find(record.command_words.begin(), record.command_words.end(), widget.name) !=
          record.command_words.end())
        continue;
      AddPose(record, state);
      const std::string name = ScriptWord(widgets.NameOf(widget));
      record.lines.push_back(act.is_set ? "set " + name + " " + ScriptWord(Typed(widget))
                                        : "click " + name);
    }
    FollowPicture(state, widgets, pointer, scale, keeps_stroke);
  }
  if (!record.pending.empty()) AddPose(record, state);
  // Work that a command began may have ended within its frame; it is waited for all the same.
  const bool begins_work =
      !had_dialog_ && std::any_of(record.pending.begin(), record.pending.end(), MayBeginWork);
  record.lines.insert(record.lines.end(), record.pending.begin(), record.pending.end());
  record.pending.clear();
  record.command_words.clear();
  // Work that ended between two acts is waited for.
  if (record.lines.size() > before) {
    if (needs_wait_)
      record.lines.insert(record.lines.begin() + static_cast<std::ptrdiff_t>(before), "wait job");
    was_busy_ = needs_wait_ = false;
  }
  was_busy_ = was_busy_ || busy || begins_work;
  // An act may begin work of its own in its frame, so that the end of the work before is noted
  // here.
  if (was_busy_ && !busy) needs_wait_ = true;
  last_ = pointer;
}

}  // namespace arthro::app
