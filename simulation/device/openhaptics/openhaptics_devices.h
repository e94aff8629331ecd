// Force devices that only their maker's library drives (OpenHaptics: Touch, Touch X and their
// forebears). Built where that library is installed; none of its types is here. Its one scheduler,
// a thread of its own at 1 kHz, reads and writes all of them; a servo takes the newest. Where no
// servo spoke for 10 ms, the handle's guard steps in or this ends, they are given no force. Device
// frame of the library: x right, y up, z towards who sits there; m, N, s.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "simulation/device/device.h"
#include "simulation/device/releasable.h"

namespace arthro::simulation {

// As in rig files, and for a person.
inline constexpr const char* kOpenHapticsWord = "openhaptics";
inline constexpr const char* kOpenHapticsName = "OpenHaptics device";

// Whether this program was built with the library; a sentence where it was not.
bool HasOpenHaptics() noexcept;
inline constexpr const char* kNoOpenHaptics =
    "this program was built without OpenHaptics, through which a Touch and its kin speak; install "
    "it (HD/hd.h, libHD) and build this program again";

class OpenHapticsDevices final : public Releasable {
 public:
  // Each by the name that the maker's setup tool gave it; an empty one is the tool's default. Opens
  // those that are there. `clock` rises evenly, s. The library has one scheduler a program, so only
  // one of these may live at a time.
  OpenHapticsDevices(const std::vector<std::string>& names, double (*clock)() noexcept);
  ~OpenHapticsDevices() override;  // as Release, five times no force, then closed

  std::size_t size() const noexcept;
  // Tries again what is not open, or was lost. All of them are without force meanwhile, and it may
  // take a second: not while a servo runs.
  void OpenMissing();
  // What a servo reads and commands, no force to begin with; this must outlive it. Its caps are
  // those that the device says; one that is not open now is absent as long as the hand lives, since
  // nobody knows what it bears.
  std::unique_ptr<Device> Hand(std::size_t i);
  // While no servo reads it.
  DeviceStatus Look(std::size_t i) noexcept;
  // More than a state says: why it is not open, and what to do. Empty: it is open.
  std::string detail(std::size_t i) const;
  bool is_open(std::size_t i) const noexcept;
  // Frames of the scheduler in which the device was read, so far.
  long frames(std::size_t i) const noexcept;

  void Release() noexcept override;

  class Line;
  class OneHand;

 private:
  struct Scheduled;
  void Start();
  void Stop() noexcept;
  std::unique_ptr<Scheduled> scheduled_;
  std::vector<std::unique_ptr<Line>> lines_;
};

}  // namespace arthro::simulation
