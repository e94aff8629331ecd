// What can be told to push no more.
#pragma once

namespace arthro::simulation {

class Releasable {
 public:
  Releasable() = default;
  virtual ~Releasable() = default;
  Releasable(const Releasable&) = delete;
  Releasable& operator=(const Releasable&) = delete;

  // No force any more, for good: the application is about to end. Also from a signal handler.
  virtual void Release() noexcept = 0;
};

}  // namespace arthro::simulation
