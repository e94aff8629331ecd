#include "simulation/tissue/fem/element_kernel.h"

namespace arthro::simulation {

namespace scalar {
const ElementKernel* Kernel() noexcept;
}
#if defined(__x86_64__)
namespace sse2 {
const ElementKernel* Kernel() noexcept;
}
namespace avx2 {
const ElementKernel* Kernel() noexcept;
}
namespace avx512 {
const ElementKernel* Kernel() noexcept;
}
#endif

const ElementKernel* KernelOf(InstructionSet set) noexcept {
  switch (set) {
    case InstructionSet::kScalar:
      return scalar::Kernel();
#if defined(__x86_64__)
    case InstructionSet::kSse2:
      return sse2::Kernel();
    case InstructionSet::kAvx2:
      return __builtin_cpu_supports("avx2") ? avx2::Kernel() : nullptr;
    case InstructionSet::kAvx512:
      return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq")
                 ? avx512::Kernel()
                 : nullptr;
#endif
    default:
      return nullptr;
  }
}

const ElementKernel& BestKernel() noexcept {
  static const ElementKernel* const best = [] {
    for (const InstructionSet set :
         {InstructionSet::kAvx512, InstructionSet::kAvx2, InstructionSet::kSse2})
      if (const ElementKernel* kernel = KernelOf(set)) return kernel;
    return KernelOf(InstructionSet::kScalar);
  }();
  return *best;
}

}  // namespace arthro::simulation
