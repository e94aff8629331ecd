#include "simulation/tissue/fem/element_kernel.h"

namespace arthro::simulation {

namespace scalar {
const ElementKernel* Kernel() noexcept;
}

const ElementKernel* KernelOf(InstructionSet set) noexcept {
  switch (set) {
    case InstructionSet::kScalar:
      return scalar::Kernel();
    default:
      return nullptr;
  }
}

const ElementKernel& BestKernel() noexcept {
  static const ElementKernel* const best = [] {
    for (const InstructionSet set :
         {InstructionSet::kAvx512, InstructionSet::kAvx2, InstructionSet::kPlain})
      if (const ElementKernel* kernel = KernelOf(set)) return kernel;
    return scalar::Kernel();
  }();
  return *best;
}

}  // namespace arthro::simulation
