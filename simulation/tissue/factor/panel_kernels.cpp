#include "simulation/tissue/factor/panel_kernels.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace arthro::simulation {
namespace {

typedef double Doubles __attribute__((vector_size(64)));
typedef float Floats __attribute__((vector_size(64)));
#define ARTHRO_INLINE __attribute__((always_inline)) inline

// NOLINTBEGIN(bugprone-macro-parentheses): names and attributes take no parentheses
// Loads and stores memory that is aligned only to its numbers.
#define ARTHRO_LOAD(V, name, from) \
  V name;                          \
  std::memcpy(&name, from, sizeof name)
#define ARTHRO_STORE(name, to) std::memcpy(to, &name, sizeof name)
// NOLINTEND(bugprone-macro-parentheses)

// Computes 16 rows of kColumns columns of c at once, in registers.
template <int kColumns>
ARTHRO_INLINE void Tile(int k, const double* a, int lda, const double* b, int ldb, double* c,
                        int ldc, double sign, bool adds) {
  Doubles low[kColumns] = {}, high[kColumns] = {};
  for (int p = 0; p < k; ++p) {
    ARTHRO_LOAD(Doubles, a0, a);
    ARTHRO_LOAD(Doubles, a1, a + 8);
#pragma GCC unroll 8
    for (int j = 0; j < kColumns; ++j) {
      low[j] += a0 * b[j];
      high[j] += a1 * b[j];
    }
    a += lda;
    b += ldb;
  }
#pragma GCC unroll 8
  for (int j = 0; j < kColumns; ++j, c += ldc) {
    low[j] *= sign;
    high[j] *= sign;
    if (adds) {
      ARTHRO_LOAD(Doubles, c0, c);
      ARTHRO_LOAD(Doubles, c1, c + 8);
      low[j] += c0;
      high[j] += c1;
    }
    ARTHRO_STORE(low[j], c);
    ARTHRO_STORE(high[j], c + 8);
  }
}

ARTHRO_INLINE void MultiplyBody(int m, int n, int k, const double* a, int lda, const double* b,
                                int ldb, double* c, int ldc, double sign, bool adds,
                                LeftOut left_out) {
  for (int j = 0; j < n; j += 6) {
    const int begin = left_out == LeftOut::kBelowInB ? j : 0;
    const int end = left_out == LeftOut::kAboveInB ? std::min(k, j + 6) : k;
    const double* bj = b + j + static_cast<long>(begin) * ldb;
    const double* aj = a + static_cast<long>(begin) * lda;
    double* cj = c + static_cast<long>(j) * ldc;
    const int top = left_out == LeftOut::kAboveInC ? j / kStrip * kStrip : 0;
    for (int i = top; i < m; i += kStrip) {
      const int steps = (left_out == LeftOut::kAboveInA ? std::min(end, i + kStrip) : end) - begin;
      switch (n - j) {
        case 1:
          Tile<1>(steps, aj + i, lda, bj, ldb, cj + i, ldc, sign, adds);
          break;
        case 2:
          Tile<2>(steps, aj + i, lda, bj, ldb, cj + i, ldc, sign, adds);
          break;
        case 3:
          Tile<3>(steps, aj + i, lda, bj, ldb, cj + i, ldc, sign, adds);
          break;
        case 4:
          Tile<4>(steps, aj + i, lda, bj, ldb, cj + i, ldc, sign, adds);
          break;
        case 5:
          Tile<5>(steps, aj + i, lda, bj, ldb, cj + i, ldc, sign, adds);
          break;
        default:
          Tile<6>(steps, aj + i, lda, bj, ldb, cj + i, ldc, sign, adds);
      }
    }
  }
}

// Adds the product of kColumns columns of a panel, strip by strip.
template <int kColumns>
ARTHRO_INLINE void AddColumns(const float* p, int stride, int first, const float* x, float* t) {
  for (int i = first; i < stride; i += kStrip) {
    ARTHRO_LOAD(Floats, sum, t + i);
#pragma GCC unroll 8
    for (int j = 0; j < kColumns; ++j) {
      ARTHRO_LOAD(Floats, pij, p + static_cast<long>(j) * stride + i);
      sum += pij * x[j];
    }
    ARTHRO_STORE(sum, t + i);
  }
}

ARTHRO_INLINE void PanelBody(const Panel& panel, const float* x, float* t) {
  const int stride = panel.stride;
  std::fill_n(t, stride, 0.0f);
  int j = 0;
  const float* p = panel.value;
  for (; j + 6 <= panel.columns; j += 6, p += 6L * stride)
    AddColumns<6>(p, stride, j / kStrip * kStrip, x + j, t);
  for (; j + 3 <= panel.columns; j += 3, p += 3L * stride)
    AddColumns<3>(p, stride, j / kStrip * kStrip, x + j, t);
  for (; j < panel.columns; ++j, p += stride)
    AddColumns<1>(p, stride, j / kStrip * kStrip, x + j, t);
}

template <int kColumns>
ARTHRO_INLINE void DotColumns(const float* p, int stride, int first, const float* t, float* x) {
  Floats sum[kColumns] = {};
  for (int i = first; i < stride; i += kStrip) {
    ARTHRO_LOAD(Floats, ti, t + i);
#pragma GCC unroll 8
    for (int j = 0; j < kColumns; ++j) {
      ARTHRO_LOAD(Floats, pij, p + static_cast<long>(j) * stride + i);
      sum[j] += pij * ti;
    }
  }
  for (int j = 0; j < kColumns; ++j) {
    float half[8];
    for (int l = 0; l < 8; ++l) half[l] = sum[j][l] + sum[j][l + 8];
    x[j] =
        ((half[0] + half[4]) + (half[1] + half[5])) + ((half[2] + half[6]) + (half[3] + half[7]));
  }
}

ARTHRO_INLINE void PanelTransposedBody(const Panel& panel, const float* t, float* x) {
  const int stride = panel.stride;
  int j = 0;
  const float* p = panel.value;
  for (; j + 6 <= panel.columns; j += 6, p += 6L * stride)
    DotColumns<6>(p, stride, j / kStrip * kStrip, t, x + j);
  for (; j + 3 <= panel.columns; j += 3, p += 3L * stride)
    DotColumns<3>(p, stride, j / kStrip * kStrip, t, x + j);
  for (; j < panel.columns; ++j, p += stride)
    DotColumns<1>(p, stride, j / kStrip * kStrip, t, x + j);
}

struct Kernels {
  void (*multiply)(int, int, int, const double*, int, const double*, int, double*, int, double,
                   bool, LeftOut) noexcept;
  void (*panel)(const Panel&, const float*, float*) noexcept;
  void (*panel_transposed)(const Panel&, const float*, float*) noexcept;
};

// NOLINTBEGIN(bugprone-macro-parentheses): names and attributes take no parentheses
#define ARTHRO_KERNELS(NAME, ATTRIBUTE)                                                            \
  struct NAME {                                                                                    \
    ATTRIBUTE static void Multiply(int m, int n, int k, const double* a, int lda, const double* b, \
                                   int ldb, double* c, int ldc, double sign, bool adds,            \
                                   LeftOut left_out) noexcept {                                    \
      MultiplyBody(m, n, k, a, lda, b, ldb, c, ldc, sign, adds, left_out);                         \
    }                                                                                              \
    ATTRIBUTE static void Forward(const Panel& p, const float* x, float* t) noexcept {             \
      PanelBody(p, x, t);                                                                          \
    }                                                                                              \
    ATTRIBUTE static void Backward(const Panel& p, const float* t, float* x) noexcept {            \
      PanelTransposedBody(p, t, x);                                                                \
    }                                                                                              \
    static constexpr Kernels kAll{Multiply, Forward, Backward};                                    \
  };
// NOLINTEND(bugprone-macro-parentheses)
#if defined(__x86_64__)
ARTHRO_KERNELS(Wide, __attribute__((target("avx512f,avx512dq"))))
ARTHRO_KERNELS(Middle, __attribute__((target("avx2"))))
#endif
ARTHRO_KERNELS(Plain, )

Kernels Chosen() {
#if defined(__x86_64__)
  __builtin_cpu_init();
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq")) return Wide::kAll;
  if (__builtin_cpu_supports("avx2")) return Middle::kAll;
#endif
  return Plain::kAll;
}
const Kernels kKernels = Chosen();

// Size up to which plain loops are as fast as tiles.
constexpr int kSmall = 12;

bool FactorSmall(int n, double* a, int lda, double* inverse, int ldi, double least) {
  for (int j = 0; j < n; ++j) {
    double* column = a + static_cast<long>(j) * lda;
    if (!(column[j] > least) || !std::isfinite(column[j])) return false;
    const double pivot = std::sqrt(column[j]);
    column[j] = pivot;
    for (int i = j + 1; i < n; ++i) column[i] /= pivot;
    for (int k = j + 1; k < n; ++k) {
      double* next = a + static_cast<long>(k) * lda;
      for (int i = k; i < n; ++i) next[i] -= column[i] * column[k];
    }
  }
  // Computes L⁻¹ column by column: L y = e_j.
  for (int j = 0; j < n; ++j) {
    double* y = inverse + static_cast<long>(j) * ldi;
    for (int i = 0; i < n; ++i) y[i] = 0.0;
    y[j] = 1.0;
    for (int k = j; k < n; ++k) {
      const double* column = a + static_cast<long>(k) * lda;
      y[k] /= column[k];
      for (int i = k + 1; i < n; ++i) y[i] -= column[i] * y[k];
    }
  }
  return true;
}

}  // namespace

void MultiplyTransposed(int m, int n, int k, const double* a, int lda, const double* b, int ldb,
                        double* c, int ldc, double sign, bool adds, LeftOut left_out) noexcept {
  kKernels.multiply(m, n, k, a, lda, b, ldb, c, ldc, sign, adds, left_out);
}

void MultiplyPanel(const Panel& p, const float* x, float* t) noexcept { kKernels.panel(p, x, t); }

void MultiplyPanelTransposed(const Panel& p, const float* t, float* x) noexcept {
  kKernels.panel_transposed(p, t, x);
}

// Divides the matrix into halves: L₂₁ = A₂₁ L₁₁⁻ᵀ, A₂₂ −= L₂₁ L₂₁ᵀ, and (L⁻¹)₂₁ = −L₂₂⁻¹ L₂₁ L₁₁⁻¹.
// Products are computed in `work` and copied, because whole strips would overwrite adjacent memory.
bool FactorAndInvert(int n, double* a, int lda, double* inverse, int ldi, double* work,
                     double least) noexcept {
  if (n <= kSmall) return FactorSmall(n, a, lda, inverse, ldi, least);
  const int n1 = n / 2, n2 = n - n1, stride = RoundUpToStrip(n2);
  if (!FactorAndInvert(n1, a, lda, inverse, ldi, work, least)) return false;
  double* a21 = a + n1;
  double* a22 = a + static_cast<long>(n1) * lda + n1;
  const auto copy = [&](double* to, int ld) {
    for (int j = 0; j < n1; ++j)
      std::copy_n(work + static_cast<long>(j) * stride, n2, to + static_cast<long>(j) * ld);
  };
  MultiplyTransposed(n2, n1, n1, a21, lda, inverse, ldi, work, stride, 1.0, false,
                     LeftOut::kAboveInB);
  copy(a21, lda);
  MultiplyTransposed(n2, n2, n1, a21, lda, a21, lda, work, stride, -1.0, false, LeftOut::kAboveInC);
  for (int j = 0; j < n2; ++j)
    for (int i = j; i < n2; ++i)
      a22[static_cast<long>(j) * lda + i] += work[static_cast<long>(j) * stride + i];
  double* inverse22 = inverse + static_cast<long>(n1) * ldi + n1;
  if (!FactorAndInvert(n2, a22, lda, inverse22, ldi, work, least)) return false;
  // First L₂₁ L₁₁⁻¹, with the transpose of L₁₁⁻¹ stored after the product.
  double* transposed = work + static_cast<long>(n1) * stride;
  const int stride1 = RoundUpToStrip(n1);
  for (int j = 0; j < n1; ++j)
    for (int i = 0; i < n1; ++i)
      transposed[static_cast<long>(j) * stride1 + i] = inverse[static_cast<long>(i) * ldi + j];
  MultiplyTransposed(n2, n1, n1, a21, lda, transposed, stride1, work, stride, 1.0, false,
                     LeftOut::kBelowInB);
  // Transposes it as the right operand of the kernel.
  double* right = transposed;
  for (int j = 0; j < n2; ++j)
    for (int i = 0; i < n1; ++i)
      right[static_cast<long>(j) * stride1 + i] = work[static_cast<long>(i) * stride + j];
  MultiplyTransposed(n2, n1, n2, inverse22, ldi, right, stride1, work, stride, -1.0, false,
                     LeftOut::kAboveInA);
  copy(inverse + n1, ldi);
  for (int j = 0; j < n2; ++j)
    for (int i = 0; i < n1; ++i) inverse[static_cast<long>(n1 + j) * ldi + i] = 0.0;
  return true;
}

}  // namespace arthro::simulation
