// Monitor that a window stands on, as the system describes it.
#pragma once

namespace arthro::app {

struct MonitorSize {
  double content_scale = 1;        // at least 1
  int width_px = 0, width_mm = 0;  // 0: not known
};

}  // namespace arthro::app
