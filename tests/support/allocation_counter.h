// Counts the heap allocations of a thread. A program that links this has its counting operator new.
#pragma once

namespace arthro::test {

// Calls of operator new by this thread since it began.
long Allocations() noexcept;

// While it lives, operator new has no memory for this thread.
struct NoMemory {
  NoMemory() noexcept;
  ~NoMemory();
  NoMemory(const NoMemory&) = delete;
  NoMemory& operator=(const NoMemory&) = delete;
};

}  // namespace arthro::test
