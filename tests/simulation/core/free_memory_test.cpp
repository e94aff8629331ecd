#include "simulation/core/free_memory.h"

#include <cstring>
#include <fstream>
#include <memory>
#include <unistd.h>
#include <vector>

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace arthro
