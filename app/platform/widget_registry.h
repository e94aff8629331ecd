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
};

class WidgetRegistry {
 public:
  void BeginFrame() {
    widgets_.clear();
    texts_.clear();
  }
  void Record(WidgetRecord record) { widgets_.push_back(std::move(record)); }
  void RecordText(std::string_view text) { texts_.emplace_back(text); }

  // The last one of that name, since a dialog is drawn over what bears the same name below it.
  const WidgetRecord* Find(std::string_view name) const {
    const WidgetRecord* found = nullptr;
    for (const auto& widget : widgets_)
      if (widget.name == name && (found == nullptr || widget.visible || !found->visible))
        found = &widget;
    return found;
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
  std::vector<WidgetRecord> widgets_;
  std::vector<std::string> texts_;
};

}  // namespace arthro::app
