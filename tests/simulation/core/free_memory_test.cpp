#include "simulation/core/free_memory.h"

#include <cstring>
#include <fstream>
#include <memory>
#include <thread>
#include <unistd.h>
#include <vector>

#include <gtest/gtest.h>

#include "simulation/core/process_cost.h"

namespace arthro {
namespace {

double ResidentMb() {
  std::ifstream file("/proc/self/statm");
  double pages = 0, resident = 0;
  file >> pages >> resident;
  return 1e-6 * resident * static_cast<double>(::sysconf(_SC_PAGESIZE));
}

// One block in a hundred stays, so that the allocator cannot give back the rest by itself.
TEST(ReturnFreeMemory, GivesBackWhatLiesBetweenBlocksInUse) {
#if !defined(__GLIBC__) || defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "the allocator is not glibc's";
#endif
  constexpr std::size_t kBlock = 64'000, kBlocks = 1'500;  // 96 MB
  const double before = ResidentMb();
  std::vector<std::unique_ptr<char[]>> blocks(kBlocks);
  for (auto& block : blocks) {
    block = std::make_unique<char[]>(kBlock);
    std::memset(block.get(), 1, kBlock);
  }
  for (std::size_t i = 0; i < kBlocks; ++i)
    if (i % 100 != 99) blocks[i].reset();
  ASSERT_GT(ResidentMb() - before, 80) << "freed, and still the process's";
  ReturnFreeMemory();
  EXPECT_LT(ResidentMb() - before, 10);
  EXPECT_EQ(blocks[99][kBlock - 1], 1);
}

// Blocks of many sizes, some freed and taken again, get few new pages.
TEST(TakeMemoryAhead, LaterBlocksGetFewPagesFromTheSystem) {
#if !defined(__GLIBC__) || defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "the allocator is not glibc's";
#endif
  constexpr std::size_t kPage = 4096;
  const auto use = [](std::size_t bytes) {
    const long before = ThreadPageFaults();
    std::vector<std::unique_ptr<char[]>> blocks;
    for (std::size_t taken = 0, size = kPage; taken < bytes; taken += size) {
      size = size >= 4'000'000 ? kPage : 3 * size;
      blocks.push_back(std::make_unique<char[]>(size));
      std::memset(blocks.back().get(), 1, size);
      if (blocks.size() % 3 == 0) blocks.front().reset();
    }
    return ThreadPageFaults() - before;
  };
  ReturnFreeMemory();
  constexpr std::size_t kUsed = 30'000'000;
  EXPECT_GT(use(kUsed), 4'000) << "of 7,324 pages";
  ReturnFreeMemory();
  TakeMemoryAhead(40'000'000);
  for (int round = 0; round < 3; ++round) EXPECT_LT(use(kUsed), 200) << round;
  ReturnFreeMemory();
}

// On a thread of its own, whose blocks have a place of their own.
TEST(TakeMemoryAhead, ServesTheThreadThatCallsIt) {
#if !defined(__GLIBC__) || defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "the allocator is not glibc's";
#endif
  long faults = 0;
  std::thread([&] {
    TakeMemoryAhead(std::size_t{1} << 40);  // the most it may take
    const long before = ThreadPageFaults();
    std::vector<char> block(20'000'000, 1);
    faults = ThreadPageFaults() - before;
    EXPECT_EQ(block.back(), 1);
  }).join();
  EXPECT_LT(faults, 200);
}

}  // namespace
}  // namespace arthro
