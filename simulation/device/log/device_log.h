// A device log that is being recorded. Threads that must not wait hand it records through channels,
// each a ring of its own; a thread of the log writes them out, in blocks. What finds its ring full
// is dropped and counted.
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
#include "simulation/device/log/log_record.h"

namespace arthro::simulation {

struct DeviceLogOptions {
  std::size_t ring = 4096;    // records a channel; four seconds at 1 kHz
  double write_every = 0.25;  // s; what is lost if the machine goes off
};

// From one thread to the log's. Push neither waits nor allocates.
class LogChannel {
 public:
  explicit LogChannel(std::size_t ring) : records_(ring) {}
  // The number is written here.
  void Push(const LogRecord& record) noexcept;
  long dropped() const noexcept { return dropped_.load(std::memory_order_relaxed); }
  // Dropped or not.
  std::uint64_t pushed() const noexcept {
    return records_.pushed() + static_cast<std::uint64_t>(dropped());
  }

 private:
  friend class DeviceLog;
  BoundedQueue<LogRecord> records_;
  std::atomic<long> dropped_{0};
  std::uint64_t number_ = 0;  // who pushes
};

class DeviceLog {
 public:
  // Refuses a file that has content. Throws Error(kFile), also where it cannot be written.
  DeviceLog(const std::filesystem::path& file, std::vector<LogSource> sources,
            const DeviceLogOptions& options = {});
  ~DeviceLog();
  DeviceLog(const DeviceLog&) = delete;
  DeviceLog& operator=(const DeviceLog&) = delete;

  // Lives as long as the log. Not on the servo path.
  LogChannel& AddChannel();
  // Writes what is left, and the end; no channel may be pushed to any more. Throws Error(kFile)
  // where something could not be written: then the file ends before that.
  void Close();
  long dropped() const;

 private:
  void Run();
  void WriteOut();
  void WriteBlock();
  void Write(const std::string& bytes);

  std::filesystem::path file_;
  DeviceLogOptions options_;
  int descriptor_ = -1, error_ = 0;
  std::string payload_;
  std::uint32_t count_ = 0;
  mutable std::mutex mutex_;  // channels, and the end; never held by who pushes
  std::condition_variable ended_;
  bool has_ended_ = false;
  std::vector<std::unique_ptr<LogChannel>> channels_;
  std::thread thread_;
};

}  // namespace arthro::simulation
