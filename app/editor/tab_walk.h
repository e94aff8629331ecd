// Tab and Shift+Tab walk through all controls of the window in the order in which they are drawn;
// of a dialog only through its own.
#pragma once

#include "app/platform/widget_registry.h"

namespace arthro::app {

// After the panels of a frame in which Tab went down. `backwards`: with Shift.
void WalkByTab(WidgetRegistry& widgets, bool backwards);

}  // namespace arthro::app
