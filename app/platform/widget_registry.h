// Items of the last frame: every named one with its rectangle, so that a script can click by
// name, and every text, so that it can say what must be seen. Filled by app/panels/widgets.h while
// a frame is built; window coordinates, x right, y down.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace arthro::app {

// Actions that an item takes.
enum class WidgetKind {
  kButton,   // clicked: buttons, boxes, entries of lists, headers
  kSlider,   // dragged, and typed into after Ctrl+click
  kText,     // typed into
  kCombo,    // opens a list of entries
  kPicture,  // dragged over and scrolled
  kShown     // only looked at
};

struct WidgetRecord {
  std::string name;
  double x0 = 0, y0 = 0, x1 = 0, y1 = 0;  // the part that is not clipped away
  bool visible = false;                   // any of it is on screen
  bool enabled = true;
  std::string value = {};  // value as shown; empty for items without one
  WidgetKind kind = WidgetKind::kButton;
  bool reachable = true;  // no dialog lies over it
  unsigned id = 0;        // ImGui's; 0: it takes no keyboard focus
  bool focused = false;   // the keyboard acts on it
  bool has_tip = false;
  bool is_cut = false;  // its left or right end lies outside of what is shown of its panel
};

// Is it worked by the keyboard, once it has the focus?
inline bool TakesFocus(const WidgetRecord& widget) {
  return widget.id != 0 && widget.enabled && widget.reachable &&
         widget.kind != WidgetKind::kPicture && widget.kind != WidgetKind::kShown;
}

// An item that was used in this frame, by mouse or keyboard; for the record of a session.
struct WidgetAct {
  std::size_t widget = 0;  // index in widgets()
  bool is_set = false;     // its value was changed; else it was clicked
};

class WidgetRegistry {
 public:
  void BeginFrame() {
    widgets_.clear();
    texts_.clear();
    acts_.clear();
  }
  // The last item was used.
  void NoteAct(bool is_set) { NoteAct(is_set, widgets_.size() - 1); }
  void NoteAct(bool is_set, std::size_t widget) { acts_.push_back({widget, is_set}); }
  const std::vector<WidgetAct>& acts() const { return acts_; }

  void NoteTip() {
    if (!widgets_.empty()) widgets_.back().has_tip = true;
  }
  // The item that the keyboard shall act on in the next frame; 0: none.
  void AskFocus(unsigned id) { wanted_focus_ = id; }
  unsigned wanted_focus() const { return wanted_focus_; }
  // Text of a field while it is typed, kept for the frame in which the field is left.
  void KeepDraft(unsigned id, const std::string& text) { draft_id_ = id, draft_ = text; }
  const std::string* DraftOf(unsigned id) const { return id == draft_id_ ? &draft_ : nullptr; }

  // Has the item of this name scrolled to while it is drawn; empty: none.
  void BringIntoView(std::string name) { wanted_ = std::move(name); }
  bool IsWanted(std::string_view name) const { return !wanted_.empty() && name == wanted_; }
  void Record(WidgetRecord record) { widgets_.push_back(std::move(record)); }
  void RecordText(std::string_view text) { texts_.emplace_back(text); }

  // The last one of that name, since a dialog is drawn over what bears the same name below it;
  // NAME#2 is the second one that is visible.
  const WidgetRecord* Find(std::string_view name) const {
    const WidgetRecord* found = nullptr;
    for (const auto& widget : widgets_)
      if (widget.name == name && (found == nullptr || widget.visible || !found->visible))
        found = &widget;
    return found != nullptr ? found : FindNumbered(name);
  }
  // The name under which Find gives this item.
  std::string NameOf(const WidgetRecord& widget) const {
    if (Find(widget.name) == &widget) return widget.name;
    int number = 0;
    for (const auto& other : widgets_) {
      if (other.visible && other.name == widget.name) ++number;
      if (&other == &widget) break;
    }
    return widget.name + "#" + std::to_string(number);
  }
  // Is `part` in any text that was drawn, or the name or value of a visible item?
  bool Shows(std::string_view part) const {
    for (const auto& text : texts_)
      if (text.find(part) != std::string::npos) return true;
    for (const auto& widget : widgets_)
      if (widget.visible && (widget.name.find(part) != std::string::npos ||
                             widget.value.find(part) != std::string::npos))
        return true;
    return false;
  }
  const std::vector<WidgetRecord>& widgets() const { return widgets_; }
  const std::vector<std::string>& texts() const { return texts_; }

 private:
  const WidgetRecord* FindNumbered(std::string_view name) const {
    const std::size_t mark = name.rfind('#');
    if (mark == std::string_view::npos || mark + 1 == name.size()) return nullptr;
    int number = 0;
    for (const char digit : name.substr(mark + 1)) {
      if (digit < '0' || digit > '9' || number > 1000) return nullptr;
      number = 10 * number + (digit - '0');
    }
    for (const auto& widget : widgets_)
      if (widget.visible && widget.name == name.substr(0, mark) && --number == 0) return &widget;
    return nullptr;
  }

  std::vector<WidgetRecord> widgets_;
  std::vector<WidgetAct> acts_;
  std::string wanted_, draft_;
  unsigned wanted_focus_ = 0, draft_id_ = 0;
  std::vector<std::string> texts_;
};

}  // namespace arthro::app
