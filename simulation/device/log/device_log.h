// Device log under recording. Threads that must not wait push records into channels, one ring each;
// a thread of the log writes them in blocks. A record that finds its ring full is dropped and
// counted.
#pragma once

#include <atomic>
#include <condition_variable>
#include <filesystem>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "simulation/core/bounded_queue.h"
#include "simulation/device/log/log_file.h"
#include "simulation/device/log/log_record.h"

namespace arthro::simulation {

struct DeviceLogOptions {
  std::size_t ring = 4096;    // records per channel; four seconds at 1 kHz
  double write_every = 0.25;  // s; lost where the machine loses power
};

// Channel from one thread to that of the log. Push neither waits nor allocates.
class LogChannel {
 public:
  explicit LogChannel(std::size_t ring) : records_(ring) {}
  // Pushes a record and sets its number.
  void Push(const LogRecord& record) noexcept;
  long dropped() const noexcept { return dropped_.load(std::memory_order_relaxed); }
  // Number of pushed records, dropped ones included.
  std::uint64_t pushed() const noexcept {
    return records_.pushed() + static_cast<std::uint64_t>(dropped());
  }

 private:
  friend class DeviceLog;
  BoundedQueue<LogRecord> records_;
  std::atomic<long> dropped_{0};
  std::uint64_t number_ = 0;  // used by the pushing thread
};

class DeviceLog {
 public:
  // Creates the log. Throws Error(kFile) where the file has content or cannot be written.
  DeviceLog(const std::filesystem::path& file, std::vector<LogSource> sources,
            const DeviceLogOptions& options = {});
  ~DeviceLog();
  DeviceLog(const DeviceLog&) = delete;
  DeviceLog& operator=(const DeviceLog&) = delete;

  // Adds a channel, which lives as long as the log. Not on the servo path.
  LogChannel& AddChannel();
  // Writes the remaining records and the end; call after the last Push. Throws Error(kFile) where a
  // write failed; the file then ends before that write.
  void Close();
  long dropped() const;

 private:
  void Run();
  void WriteOut();
  void WriteBlock();

  DeviceLogOptions options_;
  LogFile file_;
  std::string payload_;
  std::uint32_t count_ = 0;
  mutable std::mutex mutex_;  // guards the channels and the end; never locked by Push
  std::condition_variable ended_;
  bool has_ended_ = false;
  std::vector<std::unique_ptr<LogChannel>> channels_;
  std::thread thread_;
};

}  // namespace arthro::simulation
