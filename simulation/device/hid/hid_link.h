// An open line to one HID device: reports in and out, as bytes. Of a link one thread may read while
// one other writes; all else is one call at a time, and it is closed when neither is under way
// [devices.md, hidapi].
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "simulation/device/codec/report_bytes.h"
#include "simulation/device/hid/hid_node.h"

namespace arthro::simulation {

inline constexpr std::size_t kReportRoom = 128;  // bytes; what does not fit in is lost unseen
inline constexpr int kLinkIsDead = -1;

class HidLink {
 public:
  HidLink() = default;
  virtual ~HidLink() = default;  // closes
  HidLink(const HidLink&) = delete;
  HidLink& operator=(const HidLink&) = delete;

  // Bytes of the next report; 0: none came in time; kLinkIsDead: none will come any more. Give it
  // kReportRoom.
  virtual int Read(std::span<std::uint8_t> report, int timeout_ms) noexcept = 0;
  // Bytes that were taken, the report's number included (0 where it has none), or kLinkIsDead.
  // That they were taken does not prove that the device knows the report.
  virtual int Write(ReportBytes report) noexcept = 0;
  virtual int SendFeature(ReportBytes report) noexcept = 0;
  virtual int GetFeature(std::span<std::uint8_t> report) noexcept = 0;
};

enum class OpenFault { kNone, kGone, kNoPermission, kRefused };

// Where devices are plugged in. Both may take some 10 ms; any thread.
class HidBus {
 public:
  virtual ~HidBus() = default;
  virtual std::vector<HidNode> List() = 0;
  // nullptr: `fault` says why.
  virtual std::unique_ptr<HidLink> Open(const HidNode& node, OpenFault& fault) = 0;
};

// This machine's, through hidapi.
std::unique_ptr<HidBus> MachineHidBus();

}  // namespace arthro::simulation
