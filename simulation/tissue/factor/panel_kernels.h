// Dense kernels on columns of a sparse Cholesky factor, column-major. One body with a fixed number
// of lanes is compiled for AVX-512, AVX2 and baseline processors, so all give the same bits. Rows
// are processed in strips of kStrip. Memory must exist up to the end of the last strip; its padding
// may hold any value.
#pragma once

namespace arthro::simulation {

inline constexpr int kStrip = 16;  // rows; one cache line of floats
constexpr int RoundUpToStrip(int rows) { return (rows + kStrip - 1) / kStrip * kStrip; }

// Part of a product that is zero above or below a diagonal, or is not needed. Whole tiles of it are
// skipped; the bits of the rest are the same.
enum class LeftOut { kNothing, kAboveInA, kAboveInB, kBelowInB, kAboveInC };

// Computes c (m×n, stride ldc) = sign · a (m×k, stride lda) · bᵀ (b n×k, stride ldb), or += if
// `adds`.
void MultiplyTransposed(int m, int n, int k, const double* a, int lda, const double* b, int ldb,
                        double* c, int ldc, double sign, bool adds,
                        LeftOut left_out = LeftOut::kNothing) noexcept;

// Replaces a (n×n, lower triangle, stride lda) by its Cholesky factor L and writes L⁻¹ to `inverse`
// (n×n, stride ldi, zeros above the diagonal). `work` has 2 n·RoundUpToStrip(n) entries. Returns
// false if a pivot is not above `least`.
bool FactorAndInvert(int n, double* a, int lda, double* inverse, int ldi, double* work,
                     double least) noexcept;

// Panel P of the factor: `columns` columns of `stride` rows (a multiple of kStrip), 64-byte
// aligned. Its first `columns` rows are lower triangular.
struct Panel {
  const float* value;
  int columns, stride;
};
// Compute t = P x (t has `stride` rows) and x = Pᵀ t.
void MultiplyPanel(const Panel& p, const float* x, float* t) noexcept;
void MultiplyPanelTransposed(const Panel& p, const float* t, float* x) noexcept;

}  // namespace arthro::simulation
