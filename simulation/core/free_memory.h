// Memory that was freed but still belongs to the process.
#pragma once

#include <cstddef>

namespace arthro {

// Gives freed pages back to the system, where the C library can (glibc). Its allocator keeps what
// lies below a block in use, so that a session that cuts and resets tissues grows although its
// blocks do not. Takes milliseconds and holds the allocator's locks; not for a thread that is
// timed.
void ReturnFreeMemory() noexcept;

// Largest memory that TakeMemoryAhead gets: glibc keeps the blocks of a thread in heaps of 64 MB
// and unmaps a second one as soon as it is free.
inline constexpr std::size_t kMostMemoryAhead = std::size_t{56} << 20;  // bytes

// Takes the pages for the next allocations of this thread, up to `bytes` together, from the system,
// and lets the whole process keep its freed pages (glibc), up to 64 MB, until ReturnFreeMemory. A
// page that is first written costs some 10 µs in a virtual machine: the factor of a body after a
// cut took 25 ms with 1,600 new pages and 3.4 ms without. Ends early where memory is short.
void TakeMemoryAhead(std::size_t bytes) noexcept;

}  // namespace arthro
