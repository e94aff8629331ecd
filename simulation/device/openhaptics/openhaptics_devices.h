// Force devices that only the library of their maker drives (OpenHaptics: Touch, Touch X and their
// predecessors). Built where that library is installed; none of its types appears here. Its single
// scheduler, a thread at 1 kHz, reads and writes all devices; a servo reads the newest sample. They
// get no force where no servo sent a command for 10 ms, where the protection of the handle trips,
// and at the end. Device frame of the library: x right, y up, z towards the user; m, N, s.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "simulation/device/device.h"
#include "simulation/device/releasable.h"

namespace arthro::simulation {

// Text in rig files, and for the user.
inline constexpr const char* kOpenHapticsWord = "openhaptics";
inline constexpr const char* kOpenHapticsName = "OpenHaptics device";

// True where this program was built with the library; and the sentence where it was not.
bool HasOpenHaptics() noexcept;
inline constexpr const char* kNoOpenHaptics =
    "this program was built without OpenHaptics, through which a Touch and its kin speak; install "
    "it (HD/hd.h, libHD) and build this program again";

class OpenHapticsDevices final : public Releasable {
 public:
  // Opens the devices that are present. Each is given by the name from the setup tool of its maker;
  // an empty name is the default of the tool. `clock` is monotonic, s. The library has one
  // scheduler per program, so only one of these may exist at a time.
  OpenHapticsDevices(const std::vector<std::string>& names, double (*clock)() noexcept);
  ~OpenHapticsDevices() override;  // releases, writes zero force five times, then closes

  std::size_t size() const noexcept;
  // Opens devices again that are not open or were lost. All devices are without force meanwhile,
  // and it may take a second: not while a servo runs.
  void OpenMissing();
  // Makes the device for a servo, without force at first; this must outlive it. Its capabilities
  // are those that the device reports. A device that is not open now stays absent while the
  // returned object lives, since its limits are unknown.
  std::unique_ptr<Device> Hand(std::size_t i);
  // Polls the status while no servo reads the device.
  DeviceStatus Look(std::size_t i) noexcept;
  // Detail beyond the state: why it is not open and what to do; empty where it is open.
  std::string detail(std::size_t i) const;
  bool is_open(std::size_t i) const noexcept;
  // Number of scheduler frames in which the device was read.
  long frames(std::size_t i) const noexcept;

  void Release() noexcept override;
  bool IsReleased() const noexcept override;

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
