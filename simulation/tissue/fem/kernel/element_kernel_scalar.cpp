// Element kernel with one double: the reference for the others and the only one on other
// processors.
#include <cmath>
#include <limits>
#include <utility>

#include "simulation/tissue/fem/element_kernel.h"

namespace arthro::simulation::scalar {
namespace {

#define ARTHRO_INLINE __attribute__((always_inline)) inline
#define ARTHRO_FUNCTION

#define ARTHRO_WIDTH 1
constexpr int kWidth = ARTHRO_WIDTH;
constexpr const char* kName = "scalar";
using V = double;
ARTHRO_INLINE V Sqrt(V a) { return std::sqrt(a); }
ARTHRO_INLINE bool IsAnyAbove(V a, double limit) { return a > limit; }

#include "simulation/tissue/fem/kernel/element_kernel.inc"

}  // namespace

const ElementKernel* Kernel() noexcept { return &kKernel; }

}  // namespace arthro::simulation::scalar
