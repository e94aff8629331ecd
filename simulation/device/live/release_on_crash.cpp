#include "simulation/device/live/release_on_crash.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <csignal>
#include <cstdlib>
#include <ctime>
#include <mutex>
#include <utility>

#include "simulation/device/live/release_devices.h"

namespace arthro::simulation {
namespace {

constexpr std::array kFaults{SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGTRAP, SIGSYS};
// Signals whose default action does not end a process, and those that cannot be handled.
constexpr std::array kEndNothing{SIGKILL,  SIGSTOP, SIGCHLD, SIGCONT, SIGURG,
                                 SIGWINCH, SIGTSTP, SIGTTIN, SIGTTOU};
// The signal waits until every writer has written zero. A report takes 2 ms; on a busy machine a
// writer may wait for a core much longer: more than 500 ms twice, on a virtual machine whose other
// core did not run. A writer that is blocked for good writes nothing, whether the program lives or
// not.
constexpr long kLookAtWriters = 1'000'000, kMostForWriters = 2'000'000'000;  // ns

std::array<std::atomic<Releasable*>, ReleaseOnCrash::kMost> to_release{};
std::mutex to_release_changes;  // held by threads, never by a handler
static_assert(std::atomic<Releasable*>::is_always_lock_free);

// Indexed by signal number; set for handled signals.
std::array<struct sigaction, NSIG> actions_before{};
std::array<bool, NSIG> is_handled{};

void LetGoAndDie(int signal);

// Keeps handlers that were installed later by others.
void RestoreActions() noexcept {
  for (std::size_t i = 1; i < is_handled.size(); ++i) {
    if (!is_handled[i]) continue;
    struct sigaction now {};
    const int signal = static_cast<int>(i);
    if (sigaction(signal, nullptr, &now) == 0 && now.sa_handler == LetGoAndDie)
      sigaction(signal, &actions_before[i], nullptr);
  }
}

// These functions call only async-signal-safe functions.
void LetGo() {
  for (auto& device : to_release)
    if (Releasable* own = device.load()) own->Release();
  const auto is_released = [](const auto& device) {
    const Releasable* own = device.load();
    return own == nullptr || own->IsReleased();
  };
  const timespec pause{0, kLookAtWriters};
  for (long waited = 0; waited < kMostForWriters && !std::ranges::all_of(to_release, is_released);
       waited += kLookAtWriters)
    nanosleep(&pause, nullptr);
}

// A signal in another thread meanwhile waits for the writers too, since the actions are restored
// last. A fault of this function ends the process at once, since all signals are blocked.
void LetGoAndDie(int signal) {
  LetGo();
  RestoreActions();
  sigset_t own;
  sigemptyset(&own);
  sigaddset(&own, signal);
  raise(signal);
  pthread_sigmask(SIG_UNBLOCK, &own, nullptr);
}

bool MustHandle(int signal) {
  if (std::ranges::find(kEndNothing, signal) != kEndNothing.end()) return false;
  if (std::ranges::find(kFaults, signal) != kFaults.end()) return true;
  struct sigaction now {};
  return sigaction(signal, nullptr, &now) == 0 && (now.sa_flags & SA_SIGINFO) == 0 &&
         now.sa_handler == SIG_DFL;
}

}  // namespace

ReleaseOnCrash::ReleaseOnCrash(std::vector<std::shared_ptr<Releasable>> devices)
    : devices_(std::move(devices)) {
  {
    const std::scoped_lock lock(to_release_changes);
    for (std::size_t i = 0; i < std::min(devices_.size(), to_release.size()); ++i)
      to_release[i] = devices_[i].get();
  }
  struct sigaction action {};
  action.sa_handler = LetGoAndDie;
  action.sa_flags = SA_ONSTACK;
  sigfillset(&action.sa_mask);
  for (int signal = 1; signal < NSIG; ++signal) {
    const auto i = static_cast<std::size_t>(signal);
    // The C library reserves two signals and refuses them.
    is_handled[i] = MustHandle(signal) && sigaction(signal, &action, &actions_before[i]) == 0;
  }
  [[maybe_unused]] static const int registered = std::atexit(LetGo);
}

ReleaseOnCrash::~ReleaseOnCrash() {
  RestoreActions();
  is_handled.fill(false);
  const std::scoped_lock lock(to_release_changes);
  for (auto& device : to_release) device = nullptr;
}

void ReleaseDevices() noexcept {
  const std::scoped_lock lock(to_release_changes);
  for (auto& device : to_release)
    if (Releasable* own = device.load()) own->Release();
}

}  // namespace arthro::simulation
