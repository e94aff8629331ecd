// Element kernel with eight doubles per vector (AVX-512).
#if defined(__x86_64__)
#include <cmath>
#include <immintrin.h>
#include <limits>
#include <utility>

#include "simulation/tissue/fem/element_kernel.h"

namespace arthro::simulation::avx512 {
namespace {

#define ARTHRO_INLINE __attribute__((always_inline, target("avx512f,avx512dq"))) inline
#define ARTHRO_FUNCTION __attribute__((target("avx512f,avx512dq")))

#define ARTHRO_WIDTH 8
constexpr int kWidth = ARTHRO_WIDTH;
constexpr const char* kName = "AVX-512";
typedef double V __attribute__((vector_size(8 * kWidth)));
// The masked form avoids a g++ 12 warning about an uninitialised value in the plain one.
ARTHRO_INLINE V Sqrt(V a) { return V(_mm512_maskz_sqrt_pd(0xFF, a)); }
ARTHRO_INLINE bool IsAnyAbove(V a, double limit) {
  return _mm512_cmp_pd_mask(a, V{} + limit, _CMP_GT_OQ) != 0;
}

ARTHRO_INLINE V LoadThree(const double* x) { return V(_mm512_maskz_loadu_pd(7, x)); }
typedef long long Index __attribute__((vector_size(8 * kWidth)));
constexpr Index kColumnOf[1] = {{0, 1, 2, 0, 1, 2, 0, 1}};  // columns of a block's entries

#include "simulation/tissue/fem/kernel/element_kernel.inc"

}  // namespace

const ElementKernel* Kernel() noexcept { return &kKernel; }

}  // namespace arthro::simulation::avx512
#endif
