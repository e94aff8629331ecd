// Open link to one HID device: input and output reports as bytes. One thread may read while another
// writes; all other calls are one at a time, and the link is closed when neither is running
// [devices.md, hidapi].
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "simulation/device/codec/report_bytes.h"
#include "simulation/device/hid/hid_node.h"

namespace arthro::simulation {

inline constexpr std::size_t kReportRoom = 128;  // bytes; the rest of a longer report is lost
inline constexpr int kLinkIsDead = -1;

class HidLink {
 public:
  HidLink() = default;
  virtual ~HidLink() = default;  // closes the link
  HidLink(const HidLink&) = delete;
  HidLink& operator=(const HidLink&) = delete;

  // Reads the next report into at least kReportRoom bytes and returns its size; 0: none came in
  // time; kLinkIsDead: the link is lost.
  virtual int Read(std::span<std::uint8_t> report, int timeout_ms) noexcept = 0;
  // Writes a report, its number first (0 where it has none), and returns the bytes taken or
  // kLinkIsDead. A report that was taken need not be known to the device.
  virtual int Write(ReportBytes report) noexcept = 0;
  virtual int SendFeature(ReportBytes report) noexcept = 0;
  virtual int GetFeature(std::span<std::uint8_t> report) noexcept = 0;
};

enum class OpenFault { kNone, kGone, kNoPermission, kRefused };

// Bus of plugged-in devices. Both functions may take 10 ms; callable from any thread.
class HidBus {
 public:
  virtual ~HidBus() = default;
  virtual std::vector<HidNode> List() = 0;
  // nullptr: `fault` is the reason.
  virtual std::unique_ptr<HidLink> Open(const HidNode& node, OpenFault& fault) = 0;
};

// Returns the bus of this machine, through hidapi.
std::unique_ptr<HidBus> MachineHidBus();

}  // namespace arthro::simulation
