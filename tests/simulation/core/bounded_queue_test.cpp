#include "simulation/core/bounded_queue.h"

#include <thread>

#include <gtest/gtest.h>

namespace arthro {
namespace {

TEST(BoundedQueue, GivesBackInOrderAndTakesNoMoreThanItHolds) {
  BoundedQueue<int> queue(3);
  EXPECT_EQ(queue.Front(), nullptr);
  for (int round = 0; round < 5; ++round) {
    for (int i = 0; i < 3; ++i) EXPECT_TRUE(queue.Push(10 * round + i));
    EXPECT_FALSE(queue.Push(99));
    for (int i = 0; i < 3; ++i) {
      ASSERT_NE(queue.Front(), nullptr);
      EXPECT_EQ(*queue.Front(), 10 * round + i);
      queue.Pop();
    }
    EXPECT_EQ(queue.Front(), nullptr);
  }
}

TEST(BoundedQueue, HandsAllThatItTookFromOneThreadToAnother) {
  BoundedQueue<long> queue(64);
  constexpr long kCount = 100000;
  std::thread pusher([&] {
    for (long i = 0; i < kCount;)
      if (queue.Push(i))
        ++i;
      else
        std::this_thread::yield();
  });
  bool is_in_order = true;
  for (long expected = 0; expected < kCount;) {
    const long* front = queue.Front();
    if (front == nullptr) {
      std::this_thread::yield();
      continue;
    }
    is_in_order = is_in_order && *front == expected++;
    queue.Pop();
  }
  pusher.join();
  EXPECT_TRUE(is_in_order);
}

}  // namespace
}  // namespace arthro
