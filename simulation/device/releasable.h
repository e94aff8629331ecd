// Interface of devices that can be released at the end of the program.
#pragma once

namespace arthro::simulation {

class Releasable {
 public:
  Releasable() = default;
  virtual ~Releasable() = default;
  Releasable(const Releasable&) = delete;
  Releasable& operator=(const Releasable&) = delete;

  // Ends all force permanently, before the application ends. Callable from a signal handler.
  virtual void Release() noexcept = 0;
  // True when zero force was written after Release, or nothing is left that could write. Callable
  // from a signal handler.
  virtual bool IsReleased() const noexcept = 0;
};

}  // namespace arthro::simulation
