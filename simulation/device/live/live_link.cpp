#include "simulation/device/live/live_link.h"

#include <algorithm>
#include <cmath>
#include <csignal>
#include <ctime>
#include <pthread.h>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "simulation/core/crash_stack.h"
#include "simulation/device/live/arrival.h"

namespace arthro::simulation {
namespace {

constexpr int kReadTimeout = 20;        // ms
constexpr int kRing = 63;               // reports, capacity of the ring of the system
constexpr int kLongestBurst = 1024;     // reports; bounds the loop at a high rate
constexpr double kServoSilent = 0.010;  // s; then zero is written, which also wakes a board
constexpr double kIdle = 0.050;         // s, poll interval of a writer without commands
constexpr int kZeroReports = 5;         // zero reports before closing
constexpr int kStartTries = 50;         // tries of a feature report, as the Hydra needs
constexpr double kStartPause = 0.05;    // s
constexpr int kPriority = 79;           // SCHED_FIFO priority, below that of the servo

// Raises the priority of a device's thread, so that it does not wait for other programs. Ignored
// where it is not allowed.
void AskForRealTime() noexcept {
  sched_param parameters{};
  parameters.sched_priority = kPriority;
  pthread_setschedparam(pthread_self(), SCHED_FIFO, &parameters);
}

// Waits for a post. Returns false after the timeout.
bool WaitFor(sem_t& semaphore, double seconds) noexcept {
  timespec until{};
  clock_gettime(CLOCK_MONOTONIC, &until);
  const double whole = std::floor(seconds);
  until.tv_sec += static_cast<time_t>(whole);
  until.tv_nsec += static_cast<long>((seconds - whole) * 1e9);
  if (until.tv_nsec >= 1000000000L) {
    until.tv_nsec -= 1000000000L;
    ++until.tv_sec;
  }
  for (;;) {
    if (sem_clockwait(&semaphore, CLOCK_MONOTONIC, &until) == 0) return true;
    if (errno != EINTR) return false;
  }
}

// Blocks signals to the process while the threads of the link are made, which inherit the mask. A
// signal handler that waits for the writer must not interrupt the writer itself.
class BlockSignals {
 public:
  BlockSignals() noexcept {
    sigset_t all;
    sigfillset(&all);
    for (const int fault : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGTRAP, SIGSYS})
      sigdelset(&all, fault);
    pthread_sigmask(SIG_BLOCK, &all, &before_);
  }
  ~BlockSignals() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  BlockSignals(const BlockSignals&) = delete;
  BlockSignals& operator=(const BlockSignals&) = delete;

 private:
  sigset_t before_;
};

}  // namespace

double SteadySeconds() noexcept {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

LiveLink::LiveLink(HidBus& bus, const DeviceRequest& request, const LiveOptions& options)
    : bus_(bus), request_(request), options_(options), serial_(request.serial) {
  if (options_.lock_folder.empty()) options_.lock_folder = DeviceLockFolder();
  KnownDevice device;
  device.family = request.family;
  if (const auto driver = MakeDriver(device, request.model, refusal_)) {
    caps_ = driver->caps();
    hands_ = driver->hands();
  }
  sem_init(&wake_, 0, 0);
  sem_init(&stopped_, 0, 0);
  const BlockSignals blocked;
  writer_ = std::thread([this] { WriteLoop(); });
  reader_ = std::thread([this] { ReadLoop(); });
}

LiveLink::~LiveLink() {
  stop_ = true;
  sem_post(&wake_);
  sem_post(&stopped_);
  // The writer writes zero while the link is open; the reader does not close it meanwhile.
  writer_.join();
  reader_.join();
  driver_.reset();
  link_.reset();
  sem_destroy(&wake_);
  sem_destroy(&stopped_);
}

void LiveLink::Send(const glm::dvec3& force, const glm::dvec3& joints) noexcept {
  sent_ = {force, joints, sent_.number + 1, options_.clock()};
  commands_.Write(sent_);
  sem_post(&wake_);
}

void LiveLink::Release() noexcept {
  is_released_.store(true);
  sem_post(&wake_);
}

LinkCounts LiveLink::counts() const noexcept {
  return {taken_, rejected_, full_rings_, written_, opened_};
}

std::string LiveLink::detail() const {
  const std::scoped_lock lock(detail_mutex_);
  return detail_;
}

void LiveLink::SetDetail(const std::string& text) {
  const std::scoped_lock lock(detail_mutex_);
  detail_ = text;
}

bool LiveLink::Pause(double seconds) noexcept {
  if (!stop_) WaitFor(stopped_, seconds);
  return !stop_;
}

void LiveLink::ReadLoop() noexcept {
  const CrashStack crash_stack;
  if (HasForce(caps_)) AskForRealTime();
  while (!stop_) {
    bool is_open = false;
    try {
      is_open = Open();
    } catch (const std::exception& fault) {  // no memory, no hidapi: absent for now
      is_present_ = false;
      try {
        SetDetail(fault.what());
      } catch (const std::bad_alloc&) {
      }
    }
    if (is_open) {
      Serve();
      if (stop_) return;  // the writer still has to write zero
      Close();
    }
    Pause(options_.list_every);
  }
}

bool LiveLink::Open() {
  const auto known = KnownAmong(bus_.List());
  bool is_there = false;
  DeviceTrouble trouble = DeviceTrouble::kNone;
  std::string detail;
  for (const KnownDevice& device : known) {
    const bool is_it =
        device.family == request_.family && (serial_.empty() || device.node.serial == serial_);
    if (!is_it) continue;
    is_there = true;
    auto driver = MakeDriver(device, request_.model, detail);
    if (!driver) {
      trouble = DeviceTrouble::kUnsupported;
      break;
    }
    const std::string id = device.node.serial.empty()
                               ? std::filesystem::path(device.node.path).filename().string()
                               : device.node.serial;
    auto lock = std::make_unique<DeviceLock>(options_.lock_folder,
                                             std::string(ToString(device.family)) + "-" + id);
    if (lock->is_held_elsewhere()) {
      trouble = DeviceTrouble::kHeldElsewhere;
      detail = fmt::format("{} {} is used by process {}", Name(device.family), id, lock->holder());
      continue;  // the next device may be free where any serial number is allowed
    }
    OpenFault fault = OpenFault::kNone;
    auto link = bus_.Open(device.node, fault);
    if (!link) {
      detail = device.node.path;
      trouble = fault == OpenFault::kNoPermission ? DeviceTrouble::kNoPermission
                                                  : DeviceTrouble::kReadError;
      if (fault == OpenFault::kGone) is_there = false;
      continue;
    }
    driver->Forget();
    if (options_.tap) options_.tap->Opened(options_.clock(), device.node);
    if (!Start(*link, *driver)) {
      detail = fmt::format("{} does not begin to send", Name(device.family));
      trouble = DeviceTrouble::kWriteError;
      continue;
    }
    SetDetail("");
    serial_ = device.node.serial;
    lock_ = std::move(lock);
    const std::scoped_lock guard(link_mutex_);
    link_ = std::move(link);
    driver_ = std::move(driver);
    is_dead_ = wants_home_ = is_zero_written_ = false;
    trouble_ = DeviceTrouble::kNone;
    is_present_ = true;
    opening_ = ++openings_;
    ++opened_;
    return true;
  }
  SetDetail(detail);
  trouble_ = trouble;
  is_present_ = is_there;
  return false;
}

bool LiveLink::Start(HidLink& link, const DeviceDriver& driver) {
  const OutputReport start = driver.StartFeature();
  if (start.size == 0) return true;
  for (int i = 0; i < kStartTries; ++i) {
    if (link.SendFeature(start.span()) == static_cast<int>(start.size)) return true;
    if (!Pause(kStartPause)) return false;
  }
  return false;
}

void LiveLink::Serve() noexcept {
  double empty_at = options_.clock();
  while (!stop_ && !is_dead_) {
    if (asks_home_.exchange(false)) {
      driver_->AskHome();
      if (options_.tap) options_.tap->HomeAsked(options_.clock());
    }
    if (!Drain(empty_at)) return;
  }
}

// Waits for a report, takes all waiting ones and publishes their combined state.
bool LiveLink::Drain(double& empty_at) noexcept {
  std::array<std::uint8_t, kReportRoom> report;
  int count = 0, good = 0, bad = 0;
  double asked_at = 0;
  for (; count < kLongestBurst; ++count) {
    asked_at = options_.clock();
    const int size = link_->Read(report, count == 0 ? kReadTimeout : 0);
    if (size < 0 || size > static_cast<int>(report.size())) {
      trouble_ = DeviceTrouble::kReadError;
      return false;
    }
    if (size == 0) break;
    const ReportBytes bytes{report.data(), static_cast<std::size_t>(size)};
    const ReportNews news = driver_->Take(bytes);
    if (options_.tap) options_.tap->Took(options_.clock(), bytes, news, *driver_);
    good += news == ReportNews::kTaken;
    bad += news == ReportNews::kRejected;
  }
  const double now = options_.clock();
  wants_home_ = driver_->WantsHome();
  if (good > 0) {
    const double t = ArrivalOf(empty_at, now, count, caps_.rate > 0 ? 1 / caps_.rate : 0);
    for (int hand = 0; hand < hands_; ++hand) {
      HandNews news{driver_->Hand(hand), openings_};
      news.reading.sample.t = t;
      news_[static_cast<std::size_t>(hand)].Write(news);
    }
  }
  // After a delay behind an empty read it is unknown when later reports arrived.
  empty_at = count > 0 ? asked_at : std::min(now, asked_at + 1e-3 * kReadTimeout);
  // The counts are written last, so that a reader of them sees the readings too.
  if (count >= kRing) ++full_rings_;
  rejected_ += bad;
  taken_ += good;
  return true;
}

void LiveLink::Close() noexcept {
  if (trouble_ == DeviceTrouble::kNone) trouble_ = DeviceTrouble::kReadError;
  opening_ = 0;
  {
    const std::scoped_lock guard(link_mutex_);
    link_.reset();
    driver_.reset();
  }
  lock_.reset();
  is_present_ = false;
  trouble_ = DeviceTrouble::kNone;
}

void LiveLink::WriteLoop() noexcept {
  const CrashStack crash_stack;
  if (HasForce(caps_)) AskForRealTime();
  const bool has_feedback = caps_.feedback != Feedback::kNone;
  while (!stop_) {
    const bool is_silent = !WaitFor(wake_, has_feedback ? kServoSilent : kIdle);
    while (sem_trywait(&wake_) == 0) {
    }
    if (stop_) break;
    const bool is_released = is_released_;  // a release from here on is for the next turn
    const std::scoped_lock guard(link_mutex_);
    if (link_ && !is_dead_) WriteOne(commands_.Read(), is_silent);
    if (is_released) has_let_go_ = true;
  }
  WriteLastReports();
  has_let_go_ = true;
}

void LiveLink::WriteLastReports() noexcept {
  const std::scoped_lock guard(link_mutex_);
  if (!link_ || is_dead_) return;
  is_released_ = true;
  for (int i = 0; i < kZeroReports && !is_dead_; ++i) {
    is_zero_written_ = wants_home_ = false;
    WriteOne({}, true);
  }
  if (const OutputReport stop = driver_->StopFeature(); stop.size > 0 && !is_dead_)
    link_->SendFeature(stop.span());
}

// `is_silent`: the servo has sent no command for kServoSilent.
void LiveLink::WriteOne(const ForceCommand& command, bool is_silent) noexcept {
  const bool is_new = command.number != written_number_;
  // Skips a command that was written already.
  if (!is_new && !is_silent && (!is_released_ || is_zero_written_)) return;
  const double now = options_.clock();
  // Drops an outdated force after the program was stopped in between.
  const bool is_of_now = is_new && now - command.at <= kServoSilent;
  const glm::dvec3 force = is_of_now && !is_released_ ? command.force : glm::dvec3(0.0);
  const bool is_zero = force == glm::dvec3(0.0);
  if (const double interval = driver_->command_interval(); interval > 0) {
    if (is_zero ? is_zero_written_ : written_at_ >= 0 && now - written_at_ < interval) return;
  }
  const OutputReport report =
      wants_home_ ? driver_->HomeReport() : driver_->ForceReport(force, command.joints);
  if (report.size == 0) return;
  written_number_ = command.number;
  write_began_ = now;
  const int size = link_->Write(report.span());
  write_began_ = 0;
  if (size != static_cast<int>(report.size)) {
    trouble_ = DeviceTrouble::kWriteError;
    is_dead_ = true;  // the reader closes it
    return;
  }
  written_at_ = now;
  is_zero_written_ = is_zero;
  ++written_;
}

}  // namespace arthro::simulation
