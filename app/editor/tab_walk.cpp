#include "app/editor/tab_walk.h"

#include <vector>

namespace arthro::app {

void WalkByTab(WidgetRegistry& widgets, bool backwards) {
  std::vector<unsigned> ids;
  std::size_t now = 0;
  bool has_focus = false;
  for (const WidgetRecord& widget : widgets.widgets()) {
    if (widget.focused) has_focus = true, now = ids.size();
    if (TakesFocus(widget)) ids.push_back(widget.id);
  }
  if (ids.empty()) return;
  const std::size_t count = ids.size();
  // An item that lost its use since it had the focus is left for the one that follows it.
  const bool stands = has_focus && now < count;
  const std::size_t next = !has_focus  ? (backwards ? count - 1 : 0)
                           : backwards ? (now + count - 1) % count
                                       : (stands ? now + 1 : now) % count;
  widgets.AskFocus(ids[next]);
}

}  // namespace arthro::app
