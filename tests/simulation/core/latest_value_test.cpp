#include "simulation/core/latest_value.h"

#include <thread>

#include <gtest/gtest.h>

namespace arthro {
namespace {

TEST(LatestValue, ReadsTheNewestAndSkipsTheRest) {
  LatestValue<int> slot(7);
  EXPECT_EQ(slot.Read(), 7);
  slot.Write(1);
  slot.Write(2);
  EXPECT_TRUE(slot.HasNew());
  EXPECT_EQ(slot.Read(), 2);
  EXPECT_FALSE(slot.HasNew());
  EXPECT_EQ(slot.Read(), 2);
}

// A torn value would show halves that differ; a stale one would run backwards.
TEST(LatestValue, NeverTearsAndNeverRunsBackwards) {
  struct Pair {
    long a = 0, b = 0;
  };
  LatestValue<Pair> slot;
  constexpr long kLast = 200000;
  std::thread writer([&] {
    for (long i = 1; i <= kLast; ++i) slot.Write({i, -i});
  });
  long last = 0;
  while (last < kLast) {
    const Pair& pair = slot.Read();
    ASSERT_EQ(pair.a, -pair.b);
    ASSERT_GE(pair.a, last);
    last = pair.a;
  }
  writer.join();
}

}  // namespace
}  // namespace arthro
