// A stack for signal handlers of the calling thread, so that SIGSEGV can be handled after the
// thread's own stack has overflowed. A thread's first local variable, or a member of what is made
// and destroyed by one thread. Allocates no heap memory.
#pragma once

#include <cstddef>
#include <sys/types.h>

namespace arthro {

class CrashStack {
 public:
  static constexpr std::size_t kSize = 1 << 16;  // bytes; a register set with AVX-512 takes 3 kB

  // Does nothing where the thread has a signal stack already, or no memory is left.
  CrashStack() noexcept;
  ~CrashStack();
  CrashStack(const CrashStack&) = delete;
  CrashStack& operator=(const CrashStack&) = delete;

 private:
  void* memory_ = nullptr;
  pid_t thread_ = 0;
};

}  // namespace arthro
