#include "app/editor/pictures/picture_rest.h"

namespace arthro::app {

int PictureRest::RaysDue(bool has_changed, double seconds) {
  if (has_changed || rays_ == 0) {
    changed_ = seconds;
    return rays_ = 1;
  }
  if (rays_ == 2 || seconds - changed_ < kWait) return 0;
  return rays_ = 2;
}

}  // namespace arthro::app
