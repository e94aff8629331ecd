#include "tests/support/fake_hidapi.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstring>
#include <thread>
#include <utility>

#include <hidapi.h>

namespace {

arthro::test::FakeUsb* usb = nullptr;
constexpr std::size_t kRing = 63, kSmallestBuffer = 64;

}  // namespace

struct hid_device_ {
  std::string path;
  int plugs = 0;
  std::atomic<int> reading{0}, writing{0};
  bool is_dead = false;
};

namespace arthro::test {

FakeUsb::FakeUsb() { usb = this; }
FakeUsb::~FakeUsb() { usb = nullptr; }

void FakeUsb::Plug(const FakeHid& device) {
  const std::scoped_lock lock(mutex_);
  Port& port = ports_[device.path];
  port.device = device;
  port.is_plugged = true;
  port.ring.clear();
}
void FakeUsb::Unplug(const std::string& path) {
  const std::scoped_lock lock(mutex_);
  ports_[path].is_plugged = false;
  news_.notify_all();
}
void FakeUsb::Send(const std::string& path, const Bytes& report) {
  const std::scoped_lock lock(mutex_);
  Port& port = ports_[path];
  if (!port.is_plugged || port.opened == 0 || port.ring.size() >= kRing) return;
  port.ring.push_back(report);
  news_.notify_all();
}
void FakeUsb::SetReadResult(const std::string& path, int result) {
  const std::scoped_lock lock(mutex_);
  ports_[path].read_result = result;
  news_.notify_all();
}
void FakeUsb::SetWriteResult(const std::string& path, int result) {
  const std::scoped_lock lock(mutex_);
  ports_[path].write_result = result;
}
void FakeUsb::SetWriteTime(const std::string& path, int ms) {
  const std::scoped_lock lock(mutex_);
  ports_[path].write_ms = ms;
}
void FakeUsb::SetReadStall(const std::string& path, int ms) {
  const std::scoped_lock lock(mutex_);
  ports_[path].stall_ms = ms;
}
void FakeUsb::RefuseToOpen(const std::string& path, bool is_refused) {
  const std::scoped_lock lock(mutex_);
  ports_[path].is_refused = is_refused;
}
void FakeUsb::OnWrite(const std::string& path, std::function<void(const Bytes&)> answer) {
  const std::scoped_lock lock(mutex_);
  ports_[path].answer = std::move(answer);
}
std::vector<Bytes> FakeUsb::Written(const std::string& path) {
  const std::scoped_lock lock(mutex_);
  return ports_[path].written;
}
std::vector<Bytes> FakeUsb::Features(const std::string& path) {
  const std::scoped_lock lock(mutex_);
  return ports_[path].features;
}
int FakeUsb::FailFeatures(const std::string& path, int count) {
  const std::scoped_lock lock(mutex_);
  return std::exchange(ports_[path].failing_features, count);
}
int FakeUsb::opened(const std::string& path) {
  const std::scoped_lock lock(mutex_);
  return ports_[path].opened;
}
int FakeUsb::reads(const std::string& path) {
  const std::scoped_lock lock(mutex_);
  return ports_[path].reads;
}
int FakeUsb::listed() {
  const std::scoped_lock lock(mutex_);
  return listed_;
}
int FakeUsb::misuses() {
  const std::scoped_lock lock(mutex_);
  return misuses_;
}

}  // namespace arthro::test

using arthro::test::Bytes;

extern "C" {

int hid_init() { return 0; }
int hid_exit() { return 0; }

hid_device_info* hid_enumerate(unsigned short, unsigned short) {
  const std::scoped_lock lock(usb->mutex_);
  ++usb->listed_;
  hid_device_info* first = nullptr;
  for (const auto& [path, port] : usb->ports_) {
    if (!port.is_plugged) continue;
    auto* info = new hid_device_info{};
    info->path = strdup(path.c_str());
    info->vendor_id = port.device.vendor;
    info->product_id = port.device.product;
    info->usage_page = port.device.usage_page;
    info->usage = port.device.usage;
    info->interface_number = port.device.interface_number;
    info->bus_type = port.device.is_bluetooth ? HID_API_BUS_BLUETOOTH : HID_API_BUS_USB;
    info->serial_number = wcsdup(port.device.serial.c_str());
    info->product_string = wcsdup(port.device.product_name.c_str());
    info->next = first;
    first = info;
  }
  return first;
}

void hid_free_enumeration(hid_device_info* info) {
  while (info) {
    hid_device_info* next = info->next;
    free(info->path);
    free(info->serial_number);
    free(info->product_string);
    delete info;
    info = next;
  }
}

hid_device* hid_open_path(const char* path) {
  const std::scoped_lock lock(usb->mutex_);
  const auto found = usb->ports_.find(path);
  if (found == usb->ports_.end() || !found->second.is_plugged || found->second.is_refused)
    return nullptr;
  ++found->second.opened;
  found->second.ring.clear();
  auto* device = new hid_device_{};
  device->path = path;
  return device;
}

void hid_close(hid_device* device) {
  const std::scoped_lock lock(usb->mutex_);
  if (device->reading || device->writing) ++usb->misuses_;
  --usb->ports_[device->path].opened;
  delete device;
}

int hid_read_timeout(hid_device* device, unsigned char* data, size_t length, int milliseconds) {
  std::unique_lock lock(usb->mutex_);
  if (length < kSmallestBuffer) ++usb->misuses_;
  if (device->reading++) ++usb->misuses_;
  auto& port = usb->ports_[device->path];
  ++port.reads;
  const auto leave = [&](int result) {
    --device->reading;
    return result;
  };
  // A device that was pulled out ends its handle for ever, also when it is plugged in again.
  const auto is_over = [&] { return device->is_dead = device->is_dead || !port.is_plugged; };
  usb->news_.wait_for(lock, std::chrono::milliseconds(milliseconds),
                      [&] { return is_over() || port.read_result <= 0 || !port.ring.empty(); });
  if (is_over()) return leave(-1);
  if (port.read_result < 0) return leave(port.read_result);
  if (port.ring.empty() || port.read_result == 0) {
    if (port.read_result == 0) {
      lock.unlock();
      std::this_thread::sleep_for(std::chrono::milliseconds(std::min(milliseconds, 5)));
      lock.lock();
    }
    return leave(0);
  }
  if (const int stall = std::exchange(port.stall_ms, 0)) {
    lock.unlock();
    std::this_thread::sleep_for(std::chrono::milliseconds(stall));
    lock.lock();
  }
  const Bytes report = port.ring.front();
  port.ring.pop_front();
  const std::size_t count = std::min(length, report.size());
  std::copy_n(report.begin(), count, data);
  return leave(static_cast<int>(count));
}

int hid_write(hid_device* device, const unsigned char* data, size_t length) {
  std::unique_lock lock(usb->mutex_);
  if (device->writing++) ++usb->misuses_;
  auto& port = usb->ports_[device->path];
  if (port.write_ms > 0) {
    const int ms = port.write_ms;
    lock.unlock();
    std::this_thread::sleep_for(std::chrono::milliseconds(ms));
    lock.lock();
  }
  --device->writing;
  if (device->is_dead || !port.is_plugged) return -1;
  if (port.write_result != 0) return port.write_result;
  port.written.emplace_back(data, data + length);
  const auto answer = port.answer;
  lock.unlock();
  if (answer) answer(Bytes(data, data + length));
  return static_cast<int>(length);
}

int hid_send_feature_report(hid_device* device, const unsigned char* data, size_t length) {
  const std::scoped_lock lock(usb->mutex_);
  auto& port = usb->ports_[device->path];
  if (device->writing) ++usb->misuses_;
  if (device->is_dead || !port.is_plugged) return -1;
  if (port.failing_features > 0) {
    --port.failing_features;
    return -1;
  }
  port.features.emplace_back(data, data + length);
  return static_cast<int>(length);
}

int hid_get_feature_report(hid_device*, unsigned char*, size_t) { return -1; }

const wchar_t* hid_error(hid_device* device) {
  const std::scoped_lock lock(usb->mutex_);
  if (device != nullptr) ++usb->misuses_;
  return L"fake";
}

}  // extern "C"
