#include "simulation/device/log/device_log.h"

#include <cerrno>
#include <chrono>
#include <fcntl.h>
#include <unistd.h>

#include "simulation/core/atomic_file.h"
#include "simulation/core/crash_stack.h"
#include "simulation/core/error.h"
#include "simulation/device/log/log_format.h"

namespace arthro::simulation {
namespace {

constexpr std::size_t kBlock = 1 << 16;  // bytes; a block of this size is written at once
static_assert(kBlock + kLargestRecord < kLargestBlock);

// Opens the file and returns a descriptor, or -1 and errno. A new file is private to its owner,
// since its content can identify a person. Devices and pipes are opened too; a file with content is
// kept.
int Open(const std::filesystem::path& file) {
  constexpr int kFlags = O_WRONLY | O_CREAT | O_CLOEXEC;
  constexpr mode_t kPrivate = 0600;
  const int created = ::open(file.c_str(), kFlags | O_EXCL, kPrivate);
  if (created >= 0 || errno != EEXIST) return created;
  std::error_code ignored;
  if (std::filesystem::is_regular_file(file, ignored) &&
      std::filesystem::file_size(file, ignored) > 0)
    throw Error(Code::kFile, "this file exists and would be lost; name another one", file);
  return ::open(file.c_str(), kFlags | O_TRUNC, kPrivate);
}

}  // namespace

void LogChannel::Push(const LogRecord& record) noexcept {
  LogRecord numbered = record;
  numbered.number = number_++;
  if (!records_.Push(numbered)) dropped_.fetch_add(1, std::memory_order_relaxed);
}

DeviceLog::DeviceLog(const std::filesystem::path& file, std::vector<LogSource> sources,
                     const DeviceLogOptions& options)
    : file_(file), options_(options) {
  payload_.reserve(kBlock + kLargestRecord);
  descriptor_ = Open(file);
  error_ = descriptor_ < 0 ? errno : 0;
  if (error_ == 0) Write(LogHead(sources));
  if (error_ != 0) {
    if (descriptor_ >= 0) ::close(descriptor_);
    throw Error(Code::kFile, "could not be written: " + WhyNotWritten(error_), file_);
  }
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
  if (::close(descriptor_) != 0 && error_ == 0) error_ = errno;
  if (error_ != 0)
    throw Error(Code::kFile, "could not be written to its end: " + WhyNotWritten(error_), file_);
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
  Write(LogEnd(pushed));
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
  if (count_ > 0) Write(LogBlock(payload_, count_));
  payload_.clear();
  count_ = 0;
}

// Writes nothing after a fault, so that the file stays readable up to there.
void DeviceLog::Write(const std::string& bytes) {
  for (std::size_t done = 0; done < bytes.size() && error_ == 0;) {
    const ssize_t count = ::write(descriptor_, bytes.data() + done, bytes.size() - done);
    if (count > 0)
      done += static_cast<std::size_t>(count);
    else if (errno != EINTR)
      error_ = errno;
  }
}

}  // namespace arthro::simulation
