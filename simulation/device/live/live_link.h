// Link to a plugged-in device: finds it by family and serial number, opens, reads and writes it,
// and finds it again when it comes back. It has two threads. The reader opens the device, reads all
// waiting reports and publishes the newest; while the device is absent it searches every 0.5 s. The
// writer writes the newest force, so that a slow endpoint delays neither the servo nor the other
// device; when the servo is silent for 10 ms it writes zero. Before closing it writes zero five
// times. Device frame, m, N, s.
#pragma once

#include <array>
#include <atomic>
#include <filesystem>
#include <memory>
#include <mutex>
#include <semaphore.h>
#include <string>
#include <thread>

#include "simulation/core/latest_value.h"
#include "simulation/device/device_state.h"
#include "simulation/device/driver/drivers.h"
#include "simulation/device/hid/hid_link.h"
#include "simulation/device/live/device_lock.h"
#include "simulation/device/live/report_tap.h"
#include "simulation/device/releasable.h"

namespace arthro::simulation {

// Clock of live devices: s, monotonic.
double SteadySeconds() noexcept;

struct DeviceRequest {
  DeviceFamily family = DeviceFamily::kSpaceMouse;
  std::string serial;  // empty: any; then that of the device opened first
  std::string model;   // WoodenHaptics only
};

struct LiveOptions {
  double (*clock)() noexcept = SteadySeconds;
  double list_every = 0.5;            // s
  std::filesystem::path lock_folder;  // empty: DeviceLockFolder()
  ReportTap* tap = nullptr;           // must outlive the link
};

// Counters since construction.
struct LinkCounts {
  long taken = 0, rejected = 0;  // reports
  long full_rings = 0;           // bursts in which reports must have been lost
  long written = 0, opened = 0;
};

// Newest reading of a hand, and the number of the opening that it belongs to.
struct HandNews {
  HandReading reading;
  int opening = 0;
};

class LiveLink final : public Releasable {
 public:
  static constexpr int kMostHands = 2;

  // `bus` must outlive this. The reader opens the device later.
  LiveLink(HidBus& bus, const DeviceRequest& request, const LiveOptions& options = {});
  ~LiveLink() override;

  const DeviceCaps& caps() const noexcept { return caps_; }
  const DeviceRequest& request() const noexcept { return request_; }
  int hands() const noexcept { return hands_; }

  // Called by the servo; none of these waits. Each hand is read by one thread.
  const HandNews& Newest(int hand) noexcept { return news_[static_cast<std::size_t>(hand)].Read(); }
  bool is_present() const noexcept { return is_present_.load(std::memory_order_acquire); }
  // Number of the present opening; 0: closed.
  int opening() const noexcept { return opening_.load(std::memory_order_acquire); }
  DeviceTrouble trouble() const noexcept { return trouble_.load(std::memory_order_acquire); }
  // Start time of the running write; 0: none.
  double write_began() const noexcept { return write_began_.load(std::memory_order_acquire); }
  void Send(const glm::dvec3& force, const glm::dvec3& joints) noexcept;

  // Homes the device: its handle is in its rest. Any thread.
  void AskHome() noexcept { asks_home_.store(true); }
  void Release() noexcept override;
  bool IsReleased() const noexcept override { return has_let_go_.load(); }

  // Callable from any thread; these may wait.
  LinkCounts counts() const noexcept;
  std::string detail()
      const;  // detail beyond the state: the program that holds it, or why it is not driven

 private:
  struct ForceCommand {
    glm::dvec3 force{0.0}, joints{0.0};
    long number = 0;
    double at = 0;  // s, time of the command
  };
  void ReadLoop() noexcept;
  void WriteLoop() noexcept;
  bool Open();
  bool Start(HidLink& link, const DeviceDriver& driver);
  void Serve() noexcept;
  void Close() noexcept;
  bool Drain(double& empty_at) noexcept;
  void WriteOne(const ForceCommand& command, bool is_silent) noexcept;
  void WriteLastReports() noexcept;
  bool Pause(double seconds) noexcept;  // false: the link is stopping
  void SetDetail(const std::string& text);

  HidBus& bus_;
  DeviceRequest request_;
  LiveOptions options_;
  DeviceCaps caps_;
  int hands_ = 1;
  std::string refusal_;  // reason why it is never driven

  // Used by the reader only.
  std::string serial_;  // serial number of the device opened first
  int openings_ = 0;
  std::unique_ptr<DeviceLock> lock_;

  std::mutex
      link_mutex_;  // held by the writer while it writes, by the reader while it exchanges both
  std::unique_ptr<HidLink> link_;
  std::unique_ptr<DeviceDriver> driver_;

  std::array<LatestValue<HandNews>, kMostHands> news_;
  LatestValue<ForceCommand> commands_;
  ForceCommand sent_;        // used by the servo
  long written_number_ = 0;  // used by the writer
  double written_at_ = -1;   // used by the writer
  bool is_zero_written_ = false;
  std::atomic<bool> is_present_{false}, is_dead_{false}, wants_home_{false}, asks_home_{false},
      is_released_{false}, has_let_go_{false}, stop_{false};
  std::atomic<int> opening_{0};
  std::atomic<DeviceTrouble> trouble_{DeviceTrouble::kNone};
  std::atomic<double> write_began_{0};
  std::atomic<long> taken_{0}, rejected_{0}, full_rings_{0}, written_{0}, opened_{0};
  mutable std::mutex detail_mutex_;
  std::string detail_;
  sem_t wake_, stopped_;  // posted at commands; posted at the end
  std::thread reader_, writer_;
};

}  // namespace arthro::simulation
