// Connection to an X server that dies. Devices that are pushed let go at that moment [FILE-14].
#include "app/platform/x_display.h"

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <thread>

#include <gtest/gtest.h>

#include "tests/support/own_display.h"
#include "tests/support/run_window.h"
#include "tests/support/temp_folder.h"

namespace arthro::app {
namespace {

TEST(DisplayWatch, TellsThatTheServerIsGoneWithoutARequest) {
  ARTHRO_REQUIRE_XVFB();
  const test::TempFolder folder;
  test::XServer server(folder / "log");
  ASSERT_FALSE(server.name().empty());
  ::setenv("DISPLAY", server.name().c_str(), 1);
  std::atomic<int> lost{0};
  const DisplayWatch watch([&] { ++lost; });
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  EXPECT_EQ(lost, 0) << "while it lives";
  server.Kill();
  EXPECT_TRUE(test::Eventually([&] { return lost == 1; }));
}

TEST(DisplayWatch, EndsWhileTheServerLives) {
  ARTHRO_REQUIRE_XVFB();
  const test::TempFolder folder;
  const test::XServer server(folder / "log");
  ASSERT_FALSE(server.name().empty());
  ::setenv("DISPLAY", server.name().c_str(), 1);
  std::atomic<int> lost{0};
  {
    const DisplayWatch watch([&] { ++lost; });
  }
  EXPECT_EQ(lost, 0);
}

TEST(DisplayWatch, DoesNothingWithoutADisplay) {
  ::unsetenv("DISPLAY");
  std::atomic<int> lost{0};
  {
    const DisplayWatch watch([&] { ++lost; });
  }
  EXPECT_EQ(lost, 0);
}

}  // namespace
}  // namespace arthro::app
