#include "simulation/device/log/device_log.h"

#include <chrono>

#include "simulation/core/crash_stack.h"
#include "simulation/core/error.h"
#include "simulation/device/log/log_format.h"

namespace arthro::simulation {
namespace {

constexpr std::size_t kBlock = 1 << 16;  // bytes; a block of this size is written at once
static_assert(kBlock + kLargestRecord < kLargestBlock);

}  // namespace

void LogChannel::Push(const LogRecord& record) noexcept {
  LogRecord numbered = record;
  numbered.number = number_++;
  if (!records_.Push(numbered)) dropped_.fetch_add(1, std::memory_order_relaxed);
}

DeviceLog::DeviceLog(const std::filesystem::path& file, std::vector<LogSource> sources,
                     const DeviceLogOptions& options)
    : options_(options), file_(file, LogHead(sources)) {
  payload_.reserve(kBlock + kLargestRecord);
  thread_ = std::thread([this] { Run(); });
}

DeviceLog::~DeviceLog() {
  try {
    Close();
  } catch (const Error&) {  // Close reports the error
  }
}

LogChannel& DeviceLog::AddChannel() {
  const std::scoped_lock lock(mutex_);
  return *channels_.emplace_back(std::make_unique<LogChannel>(options_.ring));
}

void DeviceLog::Close() {
  if (!thread_.joinable()) return;
  {
    const std::scoped_lock lock(mutex_);
    has_ended_ = true;
  }
  ended_.notify_one();
  thread_.join();
  file_.Close();
}

long DeviceLog::dropped() const {
  const std::scoped_lock lock(mutex_);
  long dropped = 0;
  for (const auto& channel : channels_) dropped += channel->dropped();
  return dropped;
}

void DeviceLog::Run() {
  const CrashStack crash_stack;
  const auto pause = std::chrono::duration<double>(options_.write_every);
  std::unique_lock lock(mutex_);
  do {
    ended_.wait_for(lock, pause, [this] { return has_ended_; });
    WriteOut();
  } while (!has_ended_);
  std::uint64_t pushed = 0;
  for (const auto& channel : channels_) pushed += channel->pushed();
  file_.Write(LogEnd(pushed));
}

void DeviceLog::WriteOut() {
  for (const auto& channel : channels_)
    while (const LogRecord* record = channel->records_.Front()) {
      Append(*record, payload_);
      channel->records_.Pop();
      ++count_;
      if (payload_.size() >= kBlock) WriteBlock();
    }
  WriteBlock();
}

void DeviceLog::WriteBlock() {
  if (count_ > 0) file_.Write(LogBlock(payload_, count_));
  payload_.clear();
  count_ = 0;
}

}  // namespace arthro::simulation
