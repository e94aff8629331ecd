#include "simulation/core/free_memory.h"

#include <algorithm>
#include <cstdlib>
#include <new>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace arthro {
namespace {

constexpr std::size_t kBlock = std::size_t{64} << 10, kPage = 4096;  // bytes

}  // namespace

void ReturnFreeMemory() noexcept {
#ifdef __GLIBC__
  ::malloc_trim(0);
#endif
}

void TakeMemoryAhead(std::size_t bytes) noexcept {
#ifdef __GLIBC__
  // Both limits are words that other threads may read at any time; glibc locks the rest. Half of it
  // is the largest block that can be kept.
  constexpr int kKept = 64 << 20;
  // NOLINTBEGIN(concurrency-mt-unsafe)
  ::mallopt(M_TRIM_THRESHOLD, kKept);
  ::mallopt(M_MMAP_THRESHOLD, kKept / 2);
  // NOLINTEND(concurrency-mt-unsafe)
#endif
  // Each block holds the address of the one before.
  void* last = nullptr;
  for (std::size_t taken = 0; taken < std::min(bytes, kMostMemoryAhead); taken += kBlock) {
    auto* block = static_cast<char*>(::operator new(kBlock, std::nothrow));
    if (block == nullptr) break;
    for (std::size_t i = 0; i < kBlock; i += kPage) static_cast<volatile char*>(block)[i] = 0;
    last = new (block) void*(last);
  }
  while (last != nullptr) {
    void* before = *static_cast<void**>(last);
    ::operator delete(last);
    last = before;
  }
}

}  // namespace arthro
