#include "simulation/core/background_worker.h"

#include <chrono>
#include <thread>

#include <gtest/gtest.h>

namespace arthro {
namespace {

struct Sum {
  int value = 0;
  std::thread::id by;
};

void AddOne(void* subject) noexcept {
  auto* sum = static_cast<Sum*>(subject);
  std::this_thread::sleep_for(std::chrono::milliseconds(1));
  ++sum->value;
  sum->by = std::this_thread::get_id();
}

TEST(BackgroundWorker, WorkIsDoneOnceItIsWaitedFor) {
  for (const bool has_thread : {false, true}) {
    Sum sum;
    BackgroundWorker worker(has_thread);
    worker.Wait();  // for nothing: returns
    for (int i = 0; i < 5; ++i) {
      worker.Start(&AddOne, &sum);
      worker.Wait();
      EXPECT_EQ(sum.value, i + 1);
    }
    EXPECT_EQ(sum.by == std::this_thread::get_id(), !has_thread);
  }
}

TEST(BackgroundWorker, StartWaitsForTheWorkBefore) {
  Sum sum;
  {
    BackgroundWorker worker(true);
    for (int i = 0; i < 5; ++i) worker.Start(&AddOne, &sum);
  }  // and so does its end
  EXPECT_EQ(sum.value, 5);
}

}  // namespace
}  // namespace arthro
