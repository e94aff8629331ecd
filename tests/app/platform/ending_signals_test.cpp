#include "app/platform/ending_signals.h"

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <optional>
#include <thread>
#include <unistd.h>

#include <gtest/gtest.h>

namespace arthro::app {
namespace {

// In a process of its own: it shall die of the signal, and not before what it has is put away.
void HeedOne(int signal) {
  {
    std::atomic<int> woken{0};
    const EndingSignals signals([&] { ++woken; });
    std::thread beside([signal] { ::kill(::getpid(), signal); });
    beside.join();
    for (int i = 0; i < 10000 && woken == 0; ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    if (!signals.HasCome() || woken != 1) std::_Exit(1);
    std::fputs("put away", stderr);
  }
  std::_Exit(2);
}

TEST(EndingSignalsDeathTest, ASignalIsHeededThenEndsTheProgramAsItWouldHave) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  for (const int signal : {SIGINT, SIGQUIT, SIGTERM, SIGHUP})
    EXPECT_EXIT(HeedOne(signal), testing::KilledBySignal(signal), "put away");
}

TEST(EndingSignalsDeathTest, ASecondOneEndsItAtOnce) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(
      {
        const EndingSignals signals([] {});
        ::kill(::getpid(), SIGTERM);
        while (!signals.HasCome()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
        ::kill(::getpid(), SIGTERM);
        std::this_thread::sleep_for(std::chrono::minutes(10));
        std::_Exit(1);
      },
      testing::KilledBySignal(SIGTERM), "");
}

// Devices let go in a handler that is installed meanwhile.
TEST(EndingSignalsDeathTest, ASecondOneRunsTheHandlerThatWasInstalledMeanwhile) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(
      {
        const EndingSignals signals([] {});
        std::signal(SIGTERM, [](int) { std::_Exit(7); });
        ::kill(::getpid(), SIGTERM);
        while (!signals.HasCome()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
        ::kill(::getpid(), SIGTERM);
        std::this_thread::sleep_for(std::chrono::seconds(30));
        std::_Exit(1);
      },
      testing::ExitedWithCode(7), "");
}

TEST(EndingSignalsDeathTest, OneThatTheProgramWasStartedToIgnoreStaysIgnored) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(
      {
        std::signal(SIGHUP, SIG_IGN);
        {
          const EndingSignals signals([] {});
          ::kill(::getpid(), SIGHUP);
          std::this_thread::sleep_for(std::chrono::milliseconds(50));
          if (signals.HasCome()) std::_Exit(1);
        }
        std::_Exit(8);
      },
      testing::ExitedWithCode(8), "");
}

TEST(EndingSignals, WithoutOneNothingHappens) {
  std::optional<EndingSignals> signals;
  signals.emplace([] { ADD_FAILURE(); });
  EXPECT_FALSE(signals->HasCome());
  signals.reset();
}

}  // namespace
}  // namespace arthro::app
