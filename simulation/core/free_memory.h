// Memory that was freed but still belongs to the process.
#pragma once

namespace arthro {

// Gives freed pages back to the system, where the C library can (glibc). Its allocator keeps what
// lies below a block in use, so that a session that cuts and resets tissues grows although its
// blocks do not. Takes milliseconds and holds the allocator's locks; not for a thread that is
// timed.
void ReturnFreeMemory() noexcept;

}  // namespace arthro
