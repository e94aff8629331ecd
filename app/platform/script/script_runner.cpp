#include "app/platform/script/script_runner.h"

#include <algorithm>
#include <cstdio>

#include <GLFW/glfw3.h>
#include <fmt/format.h>
#include <glm/vec2.hpp>

#include "app/platform/script/script_input.h"

namespace arthro::app {
namespace {

// Dear ImGui sizes new windows over two frames, and a click may open one.
constexpr int kSettleFrames = 3;
constexpr int kDragSteps = 4;
constexpr double kCrawlLimit = 60;  // s between two actions of a crawl

}  // namespace

ScriptRunner::ScriptRunner(std::vector<ScriptLine> lines, double scale)
    : lines_(std::move(lines)), scale_(scale), frames_to_wait_(kSettleFrames) {}

int ScriptRunner::line_number() const {
  return lines_.empty() ? 0 : lines_[std::min(next_, lines_.size() - 1)].number;
}

ScriptState ScriptRunner::AfterFrame(WidgetRegistry& widgets, bool busy, InputQueue& input,
                                     const SavePicture& save_picture) {
  if (state_ != ScriptState::kRunning || !input.empty()) return state_;
  if (stroke_button_ >= 0) {
    GoOnWithStroke(input);
    return state_;
  }
  if (frames_to_wait_ > 0) {
    --frames_to_wait_;
    return state_;
  }
  if (!held_keys_.empty()) {
    PushKeys(held_keys_, false, input);
    held_keys_.clear();
    frames_to_wait_ = kSettleFrames;
    return state_;
  }
  if (walks_) {
    Walk(widgets, input);
    return state_;
  }
  if (crawler_) {
    Crawl(widgets, input);
    return state_;
  }
  if (next_ == lines_.size()) return state_ = ScriptState::kFinished;
  Run(lines_[next_], widgets, busy, input, save_picture);
  return state_;
}

void ScriptRunner::Crawl(const WidgetRegistry& widgets, InputQueue& input) {
  const auto now = std::chrono::steady_clock::now();
  const double seconds = std::chrono::duration<double>(now - crawled_at_).count();
  if (crawl_steps_done_ > 0 && seconds > kCrawlLimit)
    return Fail(lines_[next_ - 1], fmt::format("no answer for {:.0f} s", seconds));
  crawled_at_ = now;
  if (crawl_steps_done_ == crawl_steps_) {
    std::fprintf(stderr, "crawl: %d actions, %d of them different\n", crawl_steps_done_,
                 crawler_->distinct_actions());
    crawler_.reset();
    return;
  }
  // Told before it is done: the last line is what a crash came from.
  std::fprintf(stderr, "crawl %d: %s\n", ++crawl_steps_done_,
               crawler_->Act(widgets, input).c_str());
}

void ScriptRunner::Fail(const ScriptLine& line, const std::string& sentence) {
  failure_ = fmt::format("script line {}: {}", line.number, sentence);
  state_ = ScriptState::kFailed;
}

const WidgetRecord* ScriptRunner::Target(const ScriptLine& line, const WidgetRegistry& widgets) {
  const WidgetRecord* target = widgets.Find(line.name);
  if (target != nullptr && target->visible) return target;
  std::string shown;
  for (const auto& widget : widgets.widgets())
    if (widget.visible) shown += (shown.empty() ? "" : ", ") + widget.name;
  Fail(line, fmt::format("\"{}\" is {}; shown are: {}", line.name,
                         target == nullptr ? "not there" : "scrolled out of sight", shown));
  return nullptr;
}

// An item out of sight is scrolled to before its line runs. False while that is under way.
bool ScriptRunner::IsScrolledTo(const ScriptLine& line, WidgetRegistry& widgets) {
  const WidgetRecord* const target = line.name.empty() ? nullptr : widgets.Find(line.name);
  if (target == nullptr || target->visible || is_scrolled_) {
    widgets.BringIntoView("");
    is_scrolled_ = false;
    return true;
  }
  widgets.BringIntoView(target->name);
  is_scrolled_ = true;
  frames_to_wait_ = kSettleFrames;
  return false;
}

// One point per frame, as a hand gave them.
void ScriptRunner::GoOnWithStroke(InputQueue& input) {
  if (!stroke_.empty()) {
    input.Push(stroke_.front());
    stroke_.erase(stroke_.begin());
    return;
  }
  input.Push(ButtonChanged{stroke_button_, false});
  PushKeys(held_keys_, false, input);
  held_keys_.clear();
  stroke_button_ = -1;
  frames_to_wait_ = kSettleFrames;
}

// The walk is over when an item has the focus for the second time.
void ScriptRunner::Walk(const WidgetRegistry& widgets, InputQueue& input) {
  const ScriptLine& line = lines_[next_ - 1];
  bool is_new = walked_.empty(), has_focus = false;
  for (const WidgetRecord& widget : widgets.widgets())
    if (widget.focused) {
      has_focus = true;
      is_new = walked_.insert(widget.id).second || is_new;
    }
  if (!walked_.empty() && !has_focus) return Fail(line, "Tab lost the keyboard's focus");
  if (is_new) {
    PushKeys({GLFW_KEY_TAB}, true, input);
    PushKeys({GLFW_KEY_TAB}, false, input);
    frames_to_wait_ = kSettleFrames;
    return;
  }
  walks_ = false;
  std::string missed;
  for (const WidgetRecord& widget : widgets.widgets())
    if (TakesFocus(widget) && !walked_.contains(widget.id))
      missed += (missed.empty() ? "" : ", ") + widget.name;
  if (!missed.empty()) Fail(line, "Tab does not reach: " + missed);
}

void ScriptRunner::ExpectTips(const ScriptLine& line, const WidgetRegistry& widgets) {
  std::string bare;
  for (const WidgetRecord& widget : widgets.widgets()) {
    const bool is_value = widget.kind == WidgetKind::kSlider || widget.kind == WidgetKind::kText ||
                          widget.kind == WidgetKind::kCombo;
    if (is_value && widget.reachable && !widget.has_tip)
      bare += (bare.empty() ? "" : ", ") + widget.name;
  }
  if (!bare.empty()) Fail(line, "these have no tip: " + bare);
}

void ScriptRunner::ExpectLayout(const ScriptLine& line, const WidgetRegistry& widgets) {
  constexpr double kSlack = 2;  // px at scale 1; borders of neighbours may touch
  std::vector<const WidgetRecord*> controls;
  std::string cut, over;
  for (const WidgetRecord& widget : widgets.widgets()) {
    const bool is_control =
        widget.kind != WidgetKind::kPicture && widget.kind != WidgetKind::kShown;
    if (!widget.visible || !widget.reachable || !is_control) continue;
    if (widget.is_cut) cut += (cut.empty() ? "" : ", ") + widget.name;
    for (const WidgetRecord* other : controls)
      if (std::min(widget.x1, other->x1) - std::max(widget.x0, other->x0) > kSlack * scale_ &&
          std::min(widget.y1, other->y1) - std::max(widget.y0, other->y0) > kSlack * scale_)
        over += (over.empty() ? "" : ", ") + other->name + " and " + widget.name;
    controls.push_back(&widget);
  }
  if (controls.empty()) Fail(line, "there are no controls");
  if (!cut.empty()) Fail(line, "these are cut off: " + cut);
  if (!over.empty()) Fail(line, "these lie over each other: " + over);
}

void ScriptRunner::Act(const ScriptLine& line) {
  std::string failure = "a script can do this only in the editor's window";
  if (line.verb == ScriptVerb::kDo && actions_.run)
    failure = actions_.run(line.name, line.arguments);
  if (line.verb == ScriptVerb::kChoose && actions_.choose) failure = actions_.choose(line.text);
  if (line.verb == ScriptVerb::kPose && actions_.pose)
    failure = actions_.pose(line.name == "scope", line.numbers);
  if (line.verb == ScriptVerb::kExpectTranslated && actions_.translated)
    failure = actions_.translated(line.text);
  if (!failure.empty()) Fail(line, failure);
}

void ScriptRunner::Run(const ScriptLine& line, WidgetRegistry& widgets, bool busy,
                       InputQueue& input, const SavePicture& save_picture) {
  // A job is waited for over many frames; all else is done in one go.
  if (line.verb == ScriptVerb::kWaitJob && busy) {
    const auto now = std::chrono::steady_clock::now();
    if (waiting_since_ == std::chrono::steady_clock::time_point{}) waiting_since_ = now;
    if (now - waiting_since_ > job_limit_)
      Fail(line, fmt::format("the job did not end within {} s", job_limit_.count()));
    return;
  }
  waiting_since_ = {};
  if (line.verb != ScriptVerb::kDo && line.verb != ScriptVerb::kPose &&
      !IsScrolledTo(line, widgets))
    return;
  ++next_;
  frames_to_wait_ = kSettleFrames;

  // Items are pointed at first.
  const WidgetRecord* target = nullptr;
  glm::dvec2 middle(0.0);
  std::vector<PointerMoved> points;
  std::vector<int> modifiers;
  switch (line.verb) {
    case ScriptVerb::kClick:
    case ScriptVerb::kDoubleClick:
    case ScriptVerb::kRightClick:
    case ScriptVerb::kHover:
      target = Target(line, widgets);
      if (target == nullptr) return;
      input.Push(PointerMoved{(target->x0 + target->x1) / 2 + line.x * scale_,
                              (target->y0 + target->y1) / 2 + line.y * scale_});
      break;
    case ScriptVerb::kDrag:
    case ScriptVerb::kWheel:
    case ScriptVerb::kStroke:
    case ScriptVerb::kSet:
      target = Target(line, widgets);
      if (target == nullptr) return;
      middle = {(target->x0 + target->x1) / 2, (target->y0 + target->y1) / 2};
      if (line.numbers.empty()) input.Push(PointerMoved{middle.x, middle.y});
      for (std::size_t i = 0; i + 1 < line.numbers.size(); i += 2)
        points.push_back(
            {middle.x + line.numbers[i] * scale_, middle.y + line.numbers[i + 1] * scale_});
      if (line.ctrl) modifiers.push_back(GLFW_KEY_LEFT_CONTROL);
      if (line.shift) modifiers.push_back(GLFW_KEY_LEFT_SHIFT);
      break;
    case ScriptVerb::kExpectValue:
    case ScriptVerb::kExpectEnabled:
    case ScriptVerb::kExpectDisabled:
    case ScriptVerb::kExpectFocus:
      target = Target(line, widgets);
      if (target == nullptr) return;
      break;
    default:
      break;
  }

  switch (line.verb) {
    case ScriptVerb::kDoubleClick:
      PushClick(0, input);
      [[fallthrough]];
    case ScriptVerb::kClick:
      PushClick(0, input);
      break;
    case ScriptVerb::kRightClick:
      PushClick(1, input);
      break;
    case ScriptVerb::kHover:
      break;
    case ScriptVerb::kDrag: {
      const int button = line.right_button ? 1 : 0;
      const glm::dvec2 from = {(target->x0 + target->x1) / 2, (target->y0 + target->y1) / 2};
      std::vector<glm::dvec2> way;
      for (int step = 1; step <= kDragSteps; ++step)
        way.push_back(from +
                      scale_ * static_cast<double>(step) / kDragSteps * glm::dvec2(line.x, line.y));
      PushDrag(button, from, way, input);
      break;
    }
    case ScriptVerb::kWheel:
      for (const PointerMoved& point : points) input.Push(point);
      PushKeys(modifiers, true, input);
      input.Push(WheelTurned{0, line.y});
      held_keys_ = modifiers;
      break;
    case ScriptVerb::kStroke:
      PushKeys(modifiers, true, input);
      held_keys_ = modifiers;
      input.Push(points.front());
      input.Push(ButtonChanged{line.button, true});
      stroke_.assign(points.begin() + 1, points.end());
      stroke_button_ = line.button;
      break;
    case ScriptVerb::kDo:
    case ScriptVerb::kChoose:
    case ScriptVerb::kPose:
    case ScriptVerb::kExpectTranslated:
      Act(line);
      break;
    case ScriptVerb::kSet:
      PushTyped(line.text, input);
      break;
    case ScriptVerb::kType:
      PushText(line.text, input);
      break;
    case ScriptVerb::kKey: {
      const auto keys = KeysFromWords(line.text);
      PushKeys(keys, true, input);
      PushKeys(keys, false, input);
      break;
    }
    case ScriptVerb::kHold:
      held_keys_ = KeysFromWords(line.text);
      PushKeys(held_keys_, true, input);
      frames_to_wait_ = static_cast<int>(line.x);
      break;
    case ScriptVerb::kWaitFrames:
      frames_to_wait_ = static_cast<int>(line.x);
      break;
    case ScriptVerb::kWaitJob:
      break;
    case ScriptVerb::kShot:
    case ScriptVerb::kShotTrainee:
      save_picture(line.text, line.verb == ScriptVerb::kShotTrainee);
      break;
    case ScriptVerb::kMark:
      mark_ = line.text;
      break;
    case ScriptVerb::kExpect:
      if (!widgets.Shows(line.text)) Fail(line, fmt::format("\"{}\" is not shown", line.text));
      break;
    case ScriptVerb::kExpectNot:
      if (widgets.Shows(line.text)) Fail(line, fmt::format("\"{}\" is shown", line.text));
      break;
    case ScriptVerb::kExpectValue:
      if (target->value != line.text)
        Fail(line,
             fmt::format("\"{}\" shows \"{}\", not \"{}\"", line.name, target->value, line.text));
      break;
    case ScriptVerb::kExpectEnabled:
    case ScriptVerb::kExpectDisabled:
      if (target->enabled != (line.verb == ScriptVerb::kExpectEnabled))
        Fail(line,
             fmt::format("\"{}\" is {}", line.name, target->enabled ? "enabled" : "disabled"));
      break;
    case ScriptVerb::kExpectFocus:
      if (!target->focused) Fail(line, fmt::format("\"{}\" has no focus", line.name));
      break;
    case ScriptVerb::kExpectLayout:
      ExpectLayout(line, widgets);
      break;
    case ScriptVerb::kExpectTips:
      ExpectTips(line, widgets);
      break;
    case ScriptVerb::kWalk:
      walked_.clear();
      walks_ = true;
      break;
    case ScriptVerb::kDrop:
      input.Push(FilesDropped{{line.text}});
      break;
    case ScriptVerb::kResize:
      input.Push(SizeAsked{static_cast<int>(line.x), static_cast<int>(line.y)});
      break;
    case ScriptVerb::kCrawl:
      crawler_.emplace(CrawlOptions{static_cast<unsigned>(line.x), crawl_keys_});
      crawl_steps_ = static_cast<int>(line.y);
      crawl_steps_done_ = 0;
      std::fprintf(stderr, "crawl: seed %u, %d actions\n", static_cast<unsigned>(line.x),
                   crawl_steps_);
      break;
    case ScriptVerb::kClose:
      input.Push(CloseRequested{});
      break;
    case ScriptVerb::kQuit:
      state_ = ScriptState::kFinished;
      break;
  }
}

}  // namespace arthro::app
