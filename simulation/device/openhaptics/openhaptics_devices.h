// Force devices that only their maker's library drives (OpenHaptics: Touch, Touch X and their
// forebears), each as a Device. Built where that library is installed; none of its types is here.
// Its one scheduler, a thread of its own at 1 kHz, reads and writes all of them; the servo takes
// the newest. Where the servo is silent for 10 ms, the handle's guard steps in or this ends, they
// are given no force. Device frame of the library: x right, y up, z towards who sits there; m, N,
// s.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "simulation/device/device.h"

namespace arthro::simulation {

class OpenHapticsDevices {
 public:
  // Each by the name that the maker's setup tool gave it; an empty one is the tool's default.
  // `clock` rises evenly, s. The library has one scheduler a program, so only one of these may live
  // at a time. Throws Error(kDevice), which one and why; none is left open then.
  OpenHapticsDevices(std::span<const std::string> names, double (*clock)() noexcept);
  ~OpenHapticsDevices();  // as Release, five times no force, then closed
  OpenHapticsDevices(const OpenHapticsDevices&) = delete;
  OpenHapticsDevices& operator=(const OpenHapticsDevices&) = delete;

  std::size_t size() const noexcept { return devices_.size(); }
  Device& at(std::size_t i) noexcept;
  // No force any more, for good. Also from a signal handler.
  void Release() noexcept;

  class OneDevice;

 private:
  struct Scheduled;
  std::unique_ptr<Scheduled> scheduled_;
  std::vector<std::unique_ptr<OneDevice>> devices_;
};

}  // namespace arthro::simulation
