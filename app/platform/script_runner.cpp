#include "app/platform/script_runner.h"

#include <GLFW/glfw3.h>
#include <fmt/format.h>

namespace arthro::app {
namespace {

// Dear ImGui sizes new windows over two frames, and a click may open one.
constexpr int kSettleFrames = 3;
constexpr auto kJobLimit = std::chrono::seconds(120);
constexpr int kDragSteps = 4;

// UTF-8 to code points; a malformed byte becomes U+FFFD.
std::u32string CodePoints(const std::string& text) {
  std::u32string points;
  for (std::size_t i = 0; i < text.size();) {
    const auto lead = static_cast<unsigned char>(text[i]);
    const int length = lead < 0x80         ? 1
                       : (lead >> 5) == 6  ? 2
                       : (lead >> 4) == 14 ? 3
                       : (lead >> 3) == 30 ? 4
                                           : 0;
    if (length == 0 || i + static_cast<std::size_t>(length) > text.size()) {
      points += U'\uFFFD';
      ++i;
      continue;
    }
    char32_t point = length == 1 ? lead : lead & (0x7F >> length);
    for (int k = 1; k < length; ++k)
      point =
          (point << 6) | (static_cast<unsigned char>(text[i + static_cast<std::size_t>(k)]) & 0x3F);
    points += point;
    i += static_cast<std::size_t>(length);
  }
  return points;
}

void PushText(const std::string& text, InputQueue& input) {
  for (const char32_t point : CodePoints(text)) input.Push(CharacterTyped{point});
}

void PushKeys(const std::vector<int>& keys, bool down, InputQueue& input) {
  if (down)
    for (const int key : keys) input.Push(KeyChanged{key, true});
  else
    for (auto key = keys.rbegin(); key != keys.rend(); ++key) input.Push(KeyChanged{*key, false});
}

void PushClick(int button, InputQueue& input) {
  input.Push(ButtonChanged{button, true});
  input.Push(ButtonChanged{button, false});
}

}  // namespace

ScriptRunner::ScriptRunner(std::vector<ScriptLine> lines, double scale)
    : lines_(std::move(lines)), scale_(scale), frames_to_wait_(kSettleFrames) {}

int ScriptRunner::line_number() const {
  return lines_.empty() ? 0 : lines_[std::min(next_, lines_.size() - 1)].number;
}

ScriptState ScriptRunner::AfterFrame(const WidgetRegistry& widgets, bool busy, InputQueue& input,
                                     const SavePicture& save_picture) {
  if (state_ != ScriptState::kRunning || !input.empty()) return state_;
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
  if (next_ == lines_.size()) return state_ = ScriptState::kFinished;
  Run(lines_[next_], widgets, busy, input, save_picture);
  return state_;
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

void ScriptRunner::Run(const ScriptLine& line, const WidgetRegistry& widgets, bool busy,
                       InputQueue& input, const SavePicture& save_picture) {
  // A job is waited for over many frames; all else is done in one go.
  if (line.verb == ScriptVerb::kWaitJob && busy) {
    const auto now = std::chrono::steady_clock::now();
    if (waiting_since_ == std::chrono::steady_clock::time_point{}) waiting_since_ = now;
    if (now - waiting_since_ > kJobLimit) Fail(line, "the job did not end within two minutes");
    return;
  }
  waiting_since_ = {};
  ++next_;
  frames_to_wait_ = kSettleFrames;

  // Items are pointed at first.
  const WidgetRecord* target = nullptr;
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
    case ScriptVerb::kSet:
      target = Target(line, widgets);
      if (target == nullptr) return;
      input.Push(PointerMoved{(target->x0 + target->x1) / 2, (target->y0 + target->y1) / 2});
      break;
    case ScriptVerb::kExpectValue:
    case ScriptVerb::kExpectEnabled:
    case ScriptVerb::kExpectDisabled:
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
      const double x = (target->x0 + target->x1) / 2, y = (target->y0 + target->y1) / 2;
      input.Push(ButtonChanged{button, true});
      for (int step = 1; step <= kDragSteps; ++step) {
        const double share = static_cast<double>(step) / kDragSteps;
        input.Push(PointerMoved{x + share * line.x * scale_, y + share * line.y * scale_});
      }
      input.Push(ButtonChanged{button, false});
      break;
    }
    case ScriptVerb::kWheel:
      input.Push(WheelTurned{0, line.y});
      break;
    case ScriptVerb::kSet:
      // A slider becomes a text field on Ctrl+click, its text selected.
      input.Push(KeyChanged{GLFW_KEY_LEFT_CONTROL, true});
      PushClick(0, input);
      input.Push(KeyChanged{GLFW_KEY_A, true});
      input.Push(KeyChanged{GLFW_KEY_A, false});
      input.Push(KeyChanged{GLFW_KEY_LEFT_CONTROL, false});
      PushText(line.text, input);
      input.Push(KeyChanged{GLFW_KEY_ENTER, true});
      input.Push(KeyChanged{GLFW_KEY_ENTER, false});
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
    case ScriptVerb::kDrop:
      input.Push(FilesDropped{{line.text}});
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
