// Only file that uses hidapi (0.13 of Debian 12). Reading and writing share one error text there,
// so it is never queried while a link is open.
#include <cerrno>
#include <cstdlib>
#include <cwchar>
#include <mutex>
#include <unistd.h>

#include <hidapi.h>

#include "simulation/core/error.h"
#include "simulation/device/hid/hid_link.h"

namespace arthro::simulation {
namespace {

// Converts wchar_t code points to UTF-8; an invalid one becomes a question mark.
std::string Utf8(const wchar_t* text) {
  std::string utf8;
  for (; text && *text; ++text) {
    // A whole code point, also where wchar_t has a sign.
    const auto code = static_cast<std::uint32_t>(static_cast<char32_t>(*text));
    const auto put = [&](std::uint32_t byte) { utf8 += static_cast<char>(byte); };
    if (code < 0x20) continue;
    if (code < 0x80) {
      put(code);
    } else if (code < 0x800) {
      put(0xc0 | code >> 6), put(0x80 | (code & 0x3f));
    } else if (code < 0x10000 && (code < 0xd800 || code > 0xdfff)) {
      put(0xe0 | code >> 12), put(0x80 | (code >> 6 & 0x3f)), put(0x80 | (code & 0x3f));
    } else if (code >= 0x10000 && code < 0x110000) {
      put(0xf0 | code >> 18), put(0x80 | (code >> 12 & 0x3f));
      put(0x80 | (code >> 6 & 0x3f)), put(0x80 | (code & 0x3f));
    } else {
      put('?');
    }
  }
  return utf8;
}

class HidapiLink final : public HidLink {
 public:
  explicit HidapiLink(hid_device* device) : device_(device) {}
  ~HidapiLink() override { hid_close(device_); }

  int Read(std::span<std::uint8_t> report, int timeout_ms) noexcept override {
    const int count = hid_read_timeout(device_, report.data(), report.size(), timeout_ms);
    return count < 0 ? kLinkIsDead : count;
  }
  int Write(ReportBytes report) noexcept override {
    const int count = hid_write(device_, report.data(), report.size());
    return count < 0 ? kLinkIsDead : count;
  }
  int SendFeature(ReportBytes report) noexcept override {
    const int count = hid_send_feature_report(device_, report.data(), report.size());
    return count < 0 ? kLinkIsDead : count;
  }
  int GetFeature(std::span<std::uint8_t> report) noexcept override {
    const int count = hid_get_feature_report(device_, report.data(), report.size());
    return count < 0 ? kLinkIsDead : count;
  }

 private:
  hid_device* device_;
};

class HidapiBus final : public HidBus {
 public:
  HidapiBus() {
    if (hid_init() != 0)
      throw Error(Code::kDevice, "HID devices cannot be looked for: hidapi does not start");
  }

  std::vector<HidNode> List() override {
    const std::scoped_lock lock(mutex_);
    std::vector<HidNode> nodes;
    hid_device_info* const first = hid_enumerate(0, 0);
    for (const hid_device_info* info = first; info; info = info->next) {
      if (!info->path) continue;
      HidNode& node = nodes.emplace_back();
      node.vendor = info->vendor_id;
      node.product = info->product_id;
      node.usage_page = info->usage_page;
      node.usage = info->usage;
      node.interface_number = info->interface_number;
      node.is_bluetooth = info->bus_type == HID_API_BUS_BLUETOOTH;
      node.serial = Utf8(info->serial_number);
      node.product_name = Utf8(info->product_string);
      node.path = info->path;
    }
    hid_free_enumeration(first);
    return nodes;
  }

  std::unique_ptr<HidLink> Open(const HidNode& node, OpenFault& fault) override {
    const std::scoped_lock lock(mutex_);
    fault = OpenFault::kNone;
    if (hid_device* device = hid_open_path(node.path.c_str()))
      return std::make_unique<HidapiLink>(device);
    // hidapi gives no reason, but the file system does.
    if (access(node.path.c_str(), R_OK | W_OK) == 0)
      fault = OpenFault::kRefused;
    else
      fault = errno == EACCES || errno == EPERM ? OpenFault::kNoPermission : OpenFault::kGone;
    return nullptr;
  }

 private:
  // Listing and opening share one error text in hidapi. hidapi is not closed again, since other
  // buses may be open.
  std::mutex mutex_;
};

}  // namespace

std::unique_ptr<HidBus> MachineHidBus() { return std::make_unique<HidapiBus>(); }

}  // namespace arthro::simulation
