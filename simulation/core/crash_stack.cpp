#include "simulation/core/crash_stack.h"

#include <csignal>
#include <sys/mman.h>
#include <unistd.h>

namespace arthro {

CrashStack::CrashStack() noexcept : thread_(::gettid()) {
  stack_t before{};
  if (::sigaltstack(nullptr, &before) != 0 || (before.ss_flags & SS_DISABLE) == 0) return;
  const auto page = static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
  void* memory = ::mmap(nullptr, kSize + page, PROT_READ | PROT_WRITE,
                        MAP_PRIVATE | MAP_ANONYMOUS | MAP_STACK, -1, 0);
  if (memory == MAP_FAILED) return;
  // Stacks grow down: the lowest page catches what is too much for this one too.
  ::mprotect(memory, page, PROT_NONE);
  stack_t stack{};
  stack.ss_sp = static_cast<char*>(memory) + page;
  stack.ss_size = kSize;
  if (::sigaltstack(&stack, nullptr) == 0)
    memory_ = memory;
  else
    ::munmap(memory, kSize + page);
}

CrashStack::~CrashStack() {
  // Another thread cannot take it away from the one that has it.
  if (memory_ == nullptr || ::gettid() != thread_) return;
  stack_t none{};
  none.ss_flags = SS_DISABLE;
  if (::sigaltstack(&none, nullptr) != 0) return;
  ::munmap(memory_, kSize + static_cast<std::size_t>(::sysconf(_SC_PAGESIZE)));
}

}  // namespace arthro
