// A libhidapi without hardware: link fake_hidapi.cpp and its functions stand before the library's.
// Devices are plugged in and pulled out by a test; each holds its newest reports in a ring of 63
// and drops the next ones when that is full, as hidraw does. Calls that the library forbids are
// counted.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <vector>

namespace arthro::test {

using Bytes = std::vector<std::uint8_t>;

struct FakeHid {
  std::uint16_t vendor = 0x1234, product = 0x0006, usage_page = 0xff00, usage = 1;
  int interface_number = 0;
  bool is_bluetooth = false;
  std::wstring serial = L"A", product_name = L"fake";
  std::string path = "/dev/fake0";
};

// The machine's ports; one at a time lives, and is what hid_… sees.
class FakeUsb {
 public:
  FakeUsb();
  ~FakeUsb();
  FakeUsb(const FakeUsb&) = delete;
  FakeUsb& operator=(const FakeUsb&) = delete;

  void Plug(const FakeHid& device);
  void Unplug(const std::string& path);
  void Send(const std::string& path, const Bytes& report);
  // How reads and writes go from now on.
  void SetReadResult(const std::string& path, int result);   // each read gives that at once
  void SetWriteResult(const std::string& path, int result);  // each write; 0: as it should be
  void SetWriteTime(const std::string& path, int ms);
  void SetReadStall(const std::string& path, int ms);  // the next read that has a report waits
  void RefuseToOpen(const std::string& path, bool is_refused);
  // Hook of the writing thread, called with each report that was taken.
  void OnWrite(const std::string& path, std::function<void(const Bytes&)> answer);

  std::vector<Bytes> Written(const std::string& path);
  std::vector<Bytes> Features(const std::string& path);
  int FailFeatures(const std::string& path,
                   int count);          // makes `count` calls fail; returns how many are left
  int opened(const std::string& path);  // handles, now
  int reads(const std::string& path);
  int listed();
  // Calls that hidapi forbids: closing under a read or write, two writes or reads at once, asking
  // for an error while a handle is open, a buffer under 64 bytes.
  int misuses();

  // The C functions' side.
  struct Port {
    FakeHid device;
    std::deque<Bytes> ring;
    bool is_plugged = false, is_refused = false;
    int read_result = 1, write_result = 0, write_ms = 0, stall_ms = 0, failing_features = 0;
    int opened = 0, reads = 0;
    std::vector<Bytes> written, features;
    std::function<void(const Bytes&)> answer;
  };
  std::mutex mutex_;
  std::condition_variable news_;
  std::map<std::string, Port> ports_;  // key: path; stays after a device is pulled out
  int listed_ = 0, misuses_ = 0;
};

}  // namespace arthro::test
