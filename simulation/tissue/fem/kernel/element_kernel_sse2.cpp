// Element kernel with two doubles per vector (SSE2), which every x86-64 processor has.
#if defined(__x86_64__)
#include <cmath>
#include <immintrin.h>
#include <limits>
#include <utility>

#include "simulation/tissue/fem/element_kernel.h"

namespace arthro::simulation::sse2 {
namespace {

#define ARTHRO_INLINE __attribute__((always_inline)) inline
#define ARTHRO_FUNCTION

#define ARTHRO_WIDTH 2
constexpr int kWidth = ARTHRO_WIDTH;
constexpr const char* kName = "SSE2";
typedef double V __attribute__((vector_size(8 * kWidth)));
ARTHRO_INLINE V Sqrt(V a) { return V(_mm_sqrt_pd(a)); }
ARTHRO_INLINE bool IsAnyAbove(V a, double limit) {
  return _mm_movemask_pd(__m128d(a > (V{} + limit))) != 0;
}
typedef long long Index __attribute__((vector_size(8 * kWidth)));

#include "simulation/tissue/fem/kernel/element_kernel.inc"

}  // namespace

const ElementKernel* Kernel() noexcept { return &kKernel; }

}  // namespace arthro::simulation::sse2
#endif
