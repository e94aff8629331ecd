#include "simulation/device/live/release_on_crash.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <csignal>
#include <cstdlib>
#include <ctime>
#include <utility>

namespace arthro::simulation {
namespace {

constexpr std::array kSignals{SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT};
constexpr long kForWriters = 20'000'000;  // ns; ten times what a report takes

std::array<std::atomic<Releasable*>, ReleaseOnCrash::kMost> to_release{};
static_assert(std::atomic<Releasable*>::is_always_lock_free);
std::array<struct sigaction, kSignals.size()> actions_before{};

void RestoreActions() noexcept {
  for (std::size_t i = 0; i < kSignals.size(); ++i)
    sigaction(kSignals[i], &actions_before[i], nullptr);
}

// These call only what a handler may call.
void LetGo() {
  bool is_any = false;
  for (auto& device : to_release)
    if (Releasable* own = device.load()) own->Release(), is_any = true;
  timespec pause{0, kForWriters};
  while (is_any && nanosleep(&pause, &pause) != 0) {
  }
}

void LetGoAndDie(int signal) {
  RestoreActions();
  LetGo();
  raise(signal);
}

}  // namespace

ReleaseOnCrash::ReleaseOnCrash(std::vector<std::shared_ptr<Releasable>> devices)
    : devices_(std::move(devices)) {
  for (std::size_t i = 0; i < std::min(devices_.size(), to_release.size()); ++i)
    to_release[i] = devices_[i].get();
  struct sigaction action {};
  action.sa_handler = LetGoAndDie;
  action.sa_flags = SA_NODEFER;  // what is raised at its end must not wait
  sigemptyset(&action.sa_mask);
  for (std::size_t i = 0; i < kSignals.size(); ++i)
    sigaction(kSignals[i], &action, &actions_before[i]);
  [[maybe_unused]] static const int registered = std::atexit(LetGo);
}

ReleaseOnCrash::~ReleaseOnCrash() {
  RestoreActions();
  for (auto& device : to_release) device = nullptr;
}

}  // namespace arthro::simulation
