// Dense kernels on columns of a sparse Cholesky factor, column-major. Each is built for AVX-512,
// AVX2 and plain processors from one body with lanes of a fixed width, so the bits are the same on
// all of them. Rows are worked in strips of kStrip: what is read and written up to the end of the
// last strip must be there, whatever stands in it.
#pragma once

namespace arthro::simulation {

inline constexpr int kStrip = 16;  // rows; one cache line of floats
constexpr int StripsOf(int rows) { return (rows + kStrip - 1) / kStrip * kStrip; }

// Where a product has nothing but zeros above or below a diagonal, or is not asked for: such parts
// are left out, to whole tiles. The bits of the others are the same.
enum class LeftOut { kNothing, kAboveInA, kAboveInB, kBelowInB, kAboveInC };

// c (m×n, stride ldc) = sign · a (m×k, stride lda) · bᵀ (b n×k, stride ldb), or += where `adds`.
void MultiplyTransposed(int m, int n, int k, const double* a, int lda, const double* b, int ldb,
                        double* c, int ldc, double sign, bool adds,
                        LeftOut left_out = LeftOut::kNothing) noexcept;

// a (n×n, lower triangle, stride lda) becomes its Cholesky factor L, `inverse` (n×n, stride ldi,
// whole) L⁻¹ with zeros above. `work`: 2 n·StripsOf(n). False: a pivot was not above `least`.
bool FactorAndInvert(int n, double* a, int lda, double* inverse, int ldi, double* work,
                     double least) noexcept;

// A panel P of the factor: `columns` columns of `stride` rows (a multiple of kStrip), 64-byte
// aligned; its first `columns` rows are lower triangular.
struct Panel {
  const float* value;
  int columns, stride;
};
// t = P x (t has `stride` rows) and x = Pᵀ t, for `right` vectors at once, 1 or 3: three cost
// little more than one, since P is read once. Vector c begins at c · the given stride.
void MultiplyPanel(const Panel& p, int right, const float* x, int x_stride, float* t,
                   int t_stride) noexcept;
void MultiplyPanelTransposed(const Panel& p, int right, const float* t, int t_stride, float* x,
                             int x_stride) noexcept;

}  // namespace arthro::simulation
