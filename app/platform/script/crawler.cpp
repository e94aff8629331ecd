#include "app/platform/script/crawler.h"

#include <algorithm>
#include <cctype>

#include <GLFW/glfw3.h>
#include <fmt/format.h>

#include "app/platform/script/script_input.h"

namespace arthro::app {
namespace {

// Shares of all actions.
constexpr double kKeyShare = 0.12, kScrollShare = 0.1;
constexpr double kFar = 4000;  // px; past both ends of any slider

constexpr const char* kBelowLeast = "-1e30";
constexpr const char* kAboveMost = "1e30";

// Words that are not numbers, or too long.
const std::vector<std::string>& NumbersToType() {
  static const std::vector<std::string> texts = {
      "nan", "-inf", "99999999999999999999", "", "1e999", "%s%n", "0x7f", "abc"};
  return texts;
}

const std::vector<std::string>& TextsToType() {
  static const std::vector<std::string> texts = {
      "",  "%s%n%d", std::string(5000, 'x'), "##", "###a", "\xC3\xA9\xE2\x82\xAC\xF0\x9F\x98\x80",
      " ", "a\"b\\c"};
  return texts;
}

enum PictureAction {
  kDragLeft,
  kDragRight,
  kClick,
  kDoubleClick,
  kWheelIn,
  kWheelOut,
  kShiftWheel,
  kCtrlWheel,
  kPictureActions
};

int ActionCount(WidgetKind kind) {
  switch (kind) {
    case WidgetKind::kButton:
    case WidgetKind::kCombo:
      return 1;
    case WidgetKind::kSlider:
      return 2 + static_cast<int>(NumbersToType().size());
    case WidgetKind::kText:
      return static_cast<int>(TextsToType().size());
    case WidgetKind::kPicture:
      return kPictureActions;
    case WidgetKind::kShown:
      return 0;
  }
  return 0;
}

// "Frame 17" and "Frame 18" count as one, so that long lists do not take all the actions.
std::string WithoutNumbers(const std::string& name) {
  std::string words;
  for (const char c : name) {
    const bool is_digit = std::isdigit(static_cast<unsigned char>(c)) != 0;
    if (is_digit && !words.empty() && words.back() == '#') continue;
    words += is_digit ? '#' : c;
  }
  return words;
}

glm::dvec2 MiddleOf(const WidgetRecord& widget) {
  return {(widget.x0 + widget.x1) / 2, (widget.y0 + widget.y1) / 2};
}

std::string UsePicture(const WidgetRecord& widget, int action, InputQueue& input) {
  const glm::dvec2 at = MiddleOf(widget);
  const double side = 0.4 * std::min(widget.x1 - widget.x0, widget.y1 - widget.y0);
  const auto wheel = [&](double notches, int modifier) {
    if (modifier != 0) input.Push(KeyChanged{modifier, true});
    input.Push(WheelTurned{0, notches});
    if (modifier != 0) input.Push(KeyChanged{modifier, false});
  };
  switch (action) {
    case kDragLeft:
    case kDragRight:
      PushDrag(action == kDragRight ? 1 : 0, at, {at, at + side, at - side, at + kFar}, input);
      return "drag over " + widget.name;
    case kDoubleClick:
      PushClick(0, input);
      [[fallthrough]];
    case kClick:
      PushClick(0, input);
      return "click on " + widget.name;
    case kWheelIn:
      wheel(50, 0);
      break;
    case kWheelOut:
      wheel(-50, 0);
      break;
    case kShiftWheel:
      wheel(7, GLFW_KEY_LEFT_SHIFT);
      break;
    default:
      wheel(7, GLFW_KEY_LEFT_CONTROL);
  }
  return "turn the wheel over " + widget.name;
}

}  // namespace

Crawler::Crawler(CrawlOptions options) : options_(std::move(options)), random_(options_.seed) {}

// std::uniform_int_distribution differs between libraries.
std::size_t Crawler::Below(std::size_t count) { return random_() % count; }

std::vector<Crawler::Action> Crawler::ActionsOf(const WidgetRegistry& widgets) const {
  std::vector<Action> actions;
  for (const WidgetRecord& widget : widgets.widgets()) {
    const auto& avoided = options_.avoided;
    if (!widget.visible || !widget.enabled || !widget.reachable ||
        std::find(avoided.begin(), avoided.end(), widget.name) != avoided.end())
      continue;
    for (int i = 0; i < ActionCount(widget.kind); ++i)
      actions.push_back({&widget, WithoutNumbers(widget.name),
                         fmt::format("{}|{}", WithoutNumbers(widget.name), i), i});
  }
  return actions;
}

// Chooses the least used action of the least used item; the first one wins a tie.
const Crawler::Action& Crawler::LeastUsed(const std::vector<Action>& actions) {
  const auto count_of = [&](const std::string& key) {
    const auto found = counts_.find(key);
    return found == counts_.end() ? 0 : found->second;
  };
  int least = count_of(actions.front().item);
  for (const Action& action : actions) least = std::min(least, count_of(action.item));
  std::vector<std::string> items;
  for (const Action& action : actions)
    if (count_of(action.item) == least && (items.empty() || items.back() != action.item))
      items.push_back(action.item);
  const std::string item = items[Below(items.size())];
  const Action* chosen = nullptr;
  for (const Action& action : actions)
    if (action.item == item && (chosen == nullptr || count_of(action.key) < count_of(chosen->key)))
      chosen = &action;
  ++counts_[chosen->item];
  if (counts_[chosen->key]++ == 0) ++distinct_actions_;
  return *chosen;
}

std::string Crawler::PressKeys(InputQueue& input) {
  std::vector<Action> actions;
  for (const CrawlKeys& keys : options_.keys)
    actions.push_back(
        {nullptr, "key " + keys.name, "key|" + keys.name, static_cast<int>(actions.size())});
  const Action& action = LeastUsed(actions);
  const CrawlKeys& keys = options_.keys[static_cast<std::size_t>(action.index)];
  PushKeys(keys.keys, true, input);
  PushKeys(keys.keys, false, input);
  return "press " + keys.name;
}

std::string Crawler::Scroll(const WidgetRegistry& widgets, InputQueue& input) {
  std::vector<const WidgetRecord*> shown;
  for (const WidgetRecord& widget : widgets.widgets())
    if (widget.visible && widget.reachable && widget.kind != WidgetKind::kPicture)
      shown.push_back(&widget);
  if (shown.empty()) return "look";
  const WidgetRecord& widget = *shown[Below(shown.size())];
  const glm::dvec2 at = MiddleOf(widget);
  input.Push(PointerMoved{at.x, at.y});
  const double notches = Below(3) == 0 ? 8 : -4;
  input.Push(WheelTurned{0, notches});
  return fmt::format("scroll by {} over {}", notches, widget.name);
}

std::string Crawler::Act(const WidgetRegistry& widgets, InputQueue& input) {
  const double share = static_cast<double>(Below(1000)) / 1000;
  if (share < kKeyShare && !options_.keys.empty()) return PressKeys(input);
  if (share < kKeyShare + kScrollShare) return Scroll(widgets, input);
  const std::vector<Action> actions = ActionsOf(widgets);
  if (actions.empty()) return options_.keys.empty() ? "look" : PressKeys(input);
  const Action& action = LeastUsed(actions);
  const WidgetRecord& widget = *action.widget;
  const glm::dvec2 at = MiddleOf(widget);
  input.Push(PointerMoved{at.x, at.y});
  const auto index = static_cast<std::size_t>(action.index);
  switch (widget.kind) {
    case WidgetKind::kSlider: {
      if (index == 0) {
        PushDrag(0, at, {at - glm::dvec2(kFar, 0), at + glm::dvec2(kFar, 0)}, input);
        return "drag " + widget.name + " to both ends";
      }
      if (index == 1) {
        PushTyped(kBelowLeast, input);
        PushTyped(kAboveMost, input);
        return fmt::format("type {} and {} into {}", kBelowLeast, kAboveMost, widget.name);
      }
      const std::string& text = NumbersToType()[index - 2];
      PushTyped(text, input);
      return fmt::format("type \"{}\" into {}", text, widget.name);
    }
    case WidgetKind::kText: {
      const std::string& text = TextsToType()[index];
      PushTyped(text, input);
      return fmt::format("type {} bytes (\"{:.12}\") into {}", text.size(), text, widget.name);
    }
    case WidgetKind::kPicture:
      return UsePicture(widget, action.index, input);
    default:
      PushClick(0, input);
      return "click " + widget.name;
  }
}

}  // namespace arthro::app
