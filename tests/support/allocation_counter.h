// Counts what a thread takes from the heap: link allocation_counter.cpp, which replaces operator
// new.
#pragma once

namespace arthro::test {

// Calls of operator new by this thread since it began.
long Allocations() noexcept;

}  // namespace arthro::test
