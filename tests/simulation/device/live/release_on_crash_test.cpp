// Devices are released before any signal ends the program.
#include "simulation/device/live/release_on_crash.h"

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <memory>
#include <thread>
#include <unistd.h>

#include <gtest/gtest.h>

#include "simulation/core/background_worker.h"
#include "simulation/device/live/release_devices.h"

namespace arthro::simulation {
namespace {

constexpr const char* kReleased = "RELEASED";

// Device with a writer thread, as a real one, that outlives it. The writer gets a core `late` after
// it was asked.
std::atomic<bool> asked{false}, is_written{false};
class FakeDevice final : public Releasable {
 public:
  explicit FakeDevice(std::chrono::milliseconds late = {}) {
    std::thread([late] {
      while (!asked) std::this_thread::sleep_for(std::chrono::milliseconds(1));
      std::this_thread::sleep_for(late);
      if (::write(STDERR_FILENO, kReleased, 8) != 8) std::_Exit(3);
      is_written = true;
      for (;;) std::this_thread::sleep_for(std::chrono::seconds(1));
    }).detach();
  }
  void Release() noexcept override { asked = true; }
  bool IsReleased() const noexcept override { return is_written; }
};

// Recursion that no optimiser can turn into a loop or recognise as endless.
int Overflow(volatile int* depth) {
  volatile char frame[4096];
  frame[0] = static_cast<char>(*depth);
  *depth = *depth + 1;
  return *depth == -1 ? 0 : Overflow(depth) + frame[0];
}

[[maybe_unused]] void OverflowNow() {
  volatile int depth = 0;
  Overflow(&depth);
}

[[noreturn]] void WaitForDeath() {
  std::this_thread::sleep_for(std::chrono::seconds(60));
  std::_Exit(9);
}

class ReleaseOnCrashDeathTest : public testing::Test {
 protected:
  ReleaseOnCrashDeathTest() { GTEST_FLAG_SET(death_test_style, "threadsafe"); }
  ~ReleaseOnCrashDeathTest() override { GTEST_FLAG_SET(death_test_style, "fast"); }
};

class EverySignalDeathTest : public ReleaseOnCrashDeathTest,
                             public testing::WithParamInterface<int> {};

// Signals sent from outside, as by a shell, and raised by an unrelated thread.
TEST_P(EverySignalDeathTest, ReleasesThenEndsTheProgramAsBefore) {
  const int signal = GetParam();
  EXPECT_EXIT(
      {
        const ReleaseOnCrash guard({std::make_shared<FakeDevice>()});
        ::kill(::getpid(), signal);
        WaitForDeath();
      },
      testing::KilledBySignal(signal), kReleased);
  EXPECT_EXIT(
      {
        const ReleaseOnCrash guard({std::make_shared<FakeDevice>()});
        std::thread([signal] { ::raise(signal); }).join();
        WaitForDeath();
      },
      testing::KilledBySignal(signal), kReleased);
}

TEST_F(ReleaseOnCrashDeathTest, ASignalWaitsForAWriterThatGetsItsCoreLate) {
  EXPECT_EXIT(
      {
        const ReleaseOnCrash guard({std::make_shared<FakeDevice>(std::chrono::milliseconds(150))});
        ::kill(::getpid(), SIGTERM);
        WaitForDeath();
      },
      testing::KilledBySignal(SIGTERM), kReleased);
}

TEST_F(ReleaseOnCrashDeathTest, AWriterThatIsBlockedDoesNotKeepTheProgramAlive) {
  EXPECT_EXIT(
      {
        const ReleaseOnCrash guard({std::make_shared<FakeDevice>(std::chrono::seconds(50))});
        ::kill(::getpid(), SIGTERM);
        WaitForDeath();
      },
      testing::KilledBySignal(SIGTERM), "^$");
}

// Only the device of the moment is asked; its writer is not waited for.
TEST(ReleaseDevices, AsksTheDevicesThatThereAre) {
  class Counted final : public Releasable {
   public:
    void Release() noexcept override { ++asked; }
    bool IsReleased() const noexcept override { return false; }
    std::atomic<int> asked{0};
  };
  const auto device = std::make_shared<Counted>();
  ReleaseDevices();
  {
    const ReleaseOnCrash release({device});
    EXPECT_EQ(device->asked, 0);
    ReleaseDevices();
    EXPECT_EQ(device->asked, 1);
  }
  ReleaseDevices();
  EXPECT_EQ(device->asked, 1) << "it is no longer held";
}

INSTANTIATE_TEST_SUITE_P(Signals, EverySignalDeathTest,
                         testing::Values(SIGHUP, SIGINT, SIGQUIT, SIGILL, SIGTRAP, SIGABRT, SIGBUS,
                                         SIGFPE, SIGUSR1, SIGSEGV, SIGUSR2, SIGPIPE, SIGALRM,
                                         SIGTERM, SIGXCPU, SIGXFSZ, SIGVTALRM, SIGSYS),
                         [](const auto& one) {
                           return std::string("SIG") + sigabbrev_np(one.param);
                         });

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
TEST_F(ReleaseOnCrashDeathTest, AStackOverflowOfTheMainThreadReleases) {
  EXPECT_EXIT(
      {
        const ReleaseOnCrash guard({std::make_shared<FakeDevice>()});
        OverflowNow();
      },
      testing::KilledBySignal(SIGSEGV), kReleased);
}

TEST_F(ReleaseOnCrashDeathTest, AStackOverflowOfAWorkerReleases) {
  EXPECT_EXIT(
      {
        const ReleaseOnCrash guard({std::make_shared<FakeDevice>()});
        BackgroundWorker worker(true);
        worker.Start([](void*) noexcept { OverflowNow(); }, nullptr);
        WaitForDeath();
      },
      testing::KilledBySignal(SIGSEGV), kReleased);
}
#endif

TEST_F(ReleaseOnCrashDeathTest, ASecondSignalMeanwhileDoesNotCutTheReleaseShort) {
  EXPECT_EXIT(
      {
        const ReleaseOnCrash guard({std::make_shared<FakeDevice>()});
        std::thread([] { ::raise(SIGSEGV); }).detach();
        ::kill(::getpid(), SIGTERM);
        ::kill(::getpid(), SIGINT);
        WaitForDeath();
      },
      [](int status) { return WIFSIGNALED(status); }, kReleased);
}

TEST_F(ReleaseOnCrashDeathTest, KeepsSignalsThatTheProgramIgnoresOrHandles) {
  EXPECT_EXIT(
      {
        std::signal(SIGPIPE, SIG_IGN);
        static volatile std::sig_atomic_t handled = 0;
        std::signal(SIGUSR1, [](int) { handled = 1; });
        {
          const ReleaseOnCrash guard({std::make_shared<FakeDevice>()});
          ::raise(SIGPIPE);
          ::raise(SIGUSR1);
          // A handler that is installed later stays after the guard is destroyed.
          std::signal(SIGUSR2, SIG_IGN);
        }
        ::raise(SIGUSR2);
        struct sigaction now {};
        sigaction(SIGTERM, nullptr, &now);
        std::_Exit(handled && now.sa_handler == SIG_DFL ? 5 : 6);
      },
      testing::ExitedWithCode(5), "^$");
}

}  // namespace
}  // namespace arthro::simulation
