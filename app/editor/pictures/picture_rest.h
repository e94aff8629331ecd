// When the picture of the scope is drawn again: at once while anything changes, with one ray per
// pixel, and once more with four rays when nothing has changed for a moment. After that nothing is
// drawn until something changes. Plain values; time comes in as an argument.
#pragma once

namespace arthro::app {

class PictureRest {
 public:
  static constexpr double kWait = 0.1;       // s without a change before the final picture
  static constexpr double kConverged = 0.3;  // s after which the picture must be final

  // Returns the rays per pixel and axis of the picture that is due at `seconds`; 0: none is.
  int RaysDue(bool has_changed, double seconds);
  // False while a finer picture is still to come.
  bool is_final() const { return rays_ == 2; }

 private:
  int rays_ = 0;  // rays of the last picture
  double changed_ = 0;
};

}  // namespace arthro::app
