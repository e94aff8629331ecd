// Element kernel with four doubles per vector (AVX2).
#if defined(__x86_64__)
#include <cmath>
#include <immintrin.h>
#include <limits>
#include <utility>

#include "simulation/tissue/fem/element_kernel.h"

namespace arthro::simulation::avx2 {
namespace {

#define ARTHRO_INLINE __attribute__((always_inline, target("avx2"))) inline
#define ARTHRO_FUNCTION __attribute__((target("avx2")))

#define ARTHRO_WIDTH 4
constexpr int kWidth = ARTHRO_WIDTH;
constexpr const char* kName = "AVX2";
typedef double V __attribute__((vector_size(8 * kWidth)));
ARTHRO_INLINE V Sqrt(V a) { return V(_mm256_sqrt_pd(a)); }
ARTHRO_INLINE bool IsAnyAbove(V a, double limit) {
  return _mm256_movemask_pd(__m256d(a > (V{} + limit))) != 0;
}

ARTHRO_INLINE V LoadThree(const double* x) {
  return V(_mm256_maskload_pd(x, _mm256_setr_epi64x(-1, -1, -1, 0)));
}
typedef long long Index __attribute__((vector_size(8 * kWidth)));
constexpr Index kColumnOf[2] = {{0, 1, 2, 0}, {1, 2, 0, 1}};  // columns of a block's entries

#include "simulation/tissue/fem/kernel/element_kernel.inc"

}  // namespace

const ElementKernel* Kernel() noexcept { return &kKernel; }

}  // namespace arthro::simulation::avx2
#endif
