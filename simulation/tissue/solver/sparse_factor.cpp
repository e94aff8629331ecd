#include "simulation/tissue/solver/sparse_factor.h"

#include <algorithm>
#include <cmath>

#include "simulation/tissue/solver/panel_kernels.h"

namespace arthro::simulation {

SparseFactor::SparseFactor(std::shared_ptr<const FactorPlan> plan) : plan_(std::move(plan)) {
  const FactorPlan& p = *plan_;
  storage_.assign(static_cast<std::size_t>(p.panel_size_) + 2 * kStrip, 0.0f);
  panels_ = storage_.data();
  while (reinterpret_cast<std::uintptr_t>(panels_) % 64) ++panels_;
  vector_.resize(static_cast<std::size_t>(p.size_));
  strip_.resize(static_cast<std::size_t>(StripsOf(p.tallest_)) + kStrip);
  short_.resize(static_cast<std::size_t>(p.widest_) + kStrip);
}

double SparseFactor::Factor(const BlockMatrix& a, std::span<const double> added) {
  const FactorPlan& p = *plan_;
  const auto widest = static_cast<std::size_t>(p.widest_),
             tallest = static_cast<std::size_t>(StripsOf(p.tallest_));
  work_.resize(static_cast<std::size_t>(p.panel_size_) + kStrip);
  inverse_.resize(widest * static_cast<std::size_t>(StripsOf(p.widest_)) + kStrip);
  right_.resize(inverse_.size());
  product_.resize(
      std::max(widest * tallest, 2 * widest * static_cast<std::size_t>(StripsOf(p.widest_))) +
      kStrip);
  map_.resize(static_cast<std::size_t>(p.size_));
  head_.resize(p.supernode_.size());
  next_.resize(p.supernode_.size());
  position_.resize(p.supernode_.size());
  if (TryFactor(a, added, 0.0)) return 0.0;
  for (double shift = 1e-6; shift < 1e3; shift *= 10.0)
    if (TryFactor(a, added, shift)) return shift;
  return -1.0;
}

bool SparseFactor::TryFactor(const BlockMatrix& a, std::span<const double> added, double shift) {
  const FactorPlan& p = *plan_;
  // The matrix into the panels.
  std::fill(work_.begin(), work_.end(), 0.0);
  for (const FactorPlan::Entry& e : p.entry_)
    work_[static_cast<std::size_t>(e.to)] =
        a.block[static_cast<std::size_t>(e.from / 9)][static_cast<std::size_t>(e.from % 9)];
  double largest = 0;
  for (const FactorPlan::Supernode& s : p.supernode_)
    for (int j = 0; j < s.columns; ++j) {
      double& diagonal =
          work_[static_cast<std::size_t>(s.value + static_cast<std::int64_t>(j) * s.stride + j)];
      if (!added.empty())
        diagonal +=
            added[static_cast<std::size_t>(p.axis_[static_cast<std::size_t>(s.first + j)] / 3)];
      diagonal += shift * std::abs(diagonal);
      largest = std::max(largest, diagonal);
    }
  if (!std::isfinite(largest)) return false;
  for (const FactorPlan::Supernode& s : p.supernode_)
    for (int j = 0; j < s.columns && shift > 0; ++j)
      work_[static_cast<std::size_t>(s.value + static_cast<std::int64_t>(j) * s.stride + j)] +=
          1e-3 * shift * largest;
  constexpr double kLeastPivot = 1e-14;  // of the largest diagonal entry: below is rounding
  const double least = kLeastPivot * largest;

  const int count = static_cast<int>(p.supernode_.size());
  std::fill(head_.begin(), head_.end(), -1);
  for (int i = 0; i < count; ++i) {
    const FactorPlan::Supernode& s = p.supernode_[static_cast<std::size_t>(i)];
    const int* rows = p.row_.data() + s.row;
    double* panel = work_.data() + s.value;
    for (int r = 0; r < s.rows; ++r) map_[static_cast<std::size_t>(rows[r])] = r;
    // What finished supernodes that have rows among these columns take away.
    for (int d = head_[static_cast<std::size_t>(i)]; d >= 0;) {
      const int following = next_[static_cast<std::size_t>(d)];
      const FactorPlan::Supernode& from = p.supernode_[static_cast<std::size_t>(d)];
      const int* from_rows = p.row_.data() + from.row;
      const int begin = position_[static_cast<std::size_t>(d)];
      int end = begin;
      while (end < from.rows && from_rows[end] < s.first + s.columns) ++end;
      const int m = from.rows - begin, n = end - begin, stride = StripsOf(m);
      const double* source = work_.data() + from.value + begin;
      MultiplyTransposed(m, n, from.columns, source, from.stride, source, from.stride,
                         product_.data(), stride, 1.0, false);
      for (int c = 0; c < n; ++c) {
        double* to = panel + static_cast<std::int64_t>(from_rows[begin + c] - s.first) * s.stride;
        const double* column = product_.data() + static_cast<std::int64_t>(c) * stride;
        for (int r = c; r < m; ++r)
          to[map_[static_cast<std::size_t>(from_rows[begin + r])]] -= column[r];
      }
      if (end < from.rows) {
        position_[static_cast<std::size_t>(d)] = end;
        int& head =
            head_[static_cast<std::size_t>(p.owner_[static_cast<std::size_t>(from_rows[end])])];
        next_[static_cast<std::size_t>(d)] = head;
        head = d;
      }
      d = following;
    }
    // L₁₁ and its inverse; L₂₁ = A₂₁ L₁₁⁻ᵀ.
    const int n = s.columns, m = s.rows - n, ldi = StripsOf(n);
    if (!FactorAndInvert(n, panel, s.stride, inverse_.data(), ldi, product_.data(), least))
      return false;
    float* kept = panels_ + s.value;
    for (int j = 0; j < n; ++j)
      for (int r = 0; r < n; ++r)
        kept[static_cast<std::int64_t>(j) * s.stride + r] =
            static_cast<float>(inverse_[static_cast<std::size_t>(j * ldi + r)]);
    if (m > 0) {
      const int stride = StripsOf(m);
      MultiplyTransposed(m, n, n, panel + n, s.stride, inverse_.data(), ldi, product_.data(),
                         stride, 1.0, false);
      for (int j = 0; j < n; ++j)
        std::copy_n(product_.data() + static_cast<std::int64_t>(j) * stride, m,
                    panel + static_cast<std::int64_t>(j) * s.stride + n);
      // And what is kept of it: L₂₁ L₁₁⁻¹.
      for (int j = 0; j < n; ++j)
        for (int r = 0; r < n; ++r)
          right_[static_cast<std::size_t>(r * ldi + j)] =
              inverse_[static_cast<std::size_t>(j * ldi + r)];
      MultiplyTransposed(m, n, n, panel + n, s.stride, right_.data(), ldi, product_.data(), stride,
                         1.0, false);
      for (int j = 0; j < n; ++j)
        for (int r = 0; r < m; ++r)
          kept[static_cast<std::int64_t>(j) * s.stride + n + r] = static_cast<float>(
              product_[static_cast<std::size_t>(static_cast<std::int64_t>(j) * stride + r)]);
      position_[static_cast<std::size_t>(i)] = n;
      int& head = head_[static_cast<std::size_t>(p.owner_[static_cast<std::size_t>(rows[n])])];
      next_[static_cast<std::size_t>(i)] = head;
      head = i;
    }
  }
  return true;
}

void SparseFactor::Solve(std::span<const glm::dvec3> b, std::span<glm::dvec3> x) noexcept {
  const FactorPlan& p = *plan_;
  float* v = vector_.data();
  float* t = strip_.data();
  // One scale for the whole vector, so that neither tiny nor huge forces leave float's range.
  double largest = 0;
  for (const glm::dvec3& bi : b)
    largest = std::max(largest, std::max(std::abs(bi.x), std::max(std::abs(bi.y), std::abs(bi.z))));
  std::fill(x.begin(), x.end(), glm::dvec3(0.0));
  if (!(largest > 0) || !std::isfinite(largest)) return;
  const double* from = &b[0].x;
  for (int i = 0; i < p.size_; ++i)
    v[i] = static_cast<float>(from[p.axis_[static_cast<std::size_t>(i)]] / largest);
  for (const FactorPlan::Supernode& s : p.supernode_) {
    MultiplyPanel({panels_ + s.value, s.columns, s.stride}, v + s.first, t);
    std::copy_n(t, s.columns, v + s.first);
    const int* rows = p.row_.data() + s.row;
    for (int r = s.columns; r < s.rows; ++r) v[rows[r]] -= t[r];
  }
  for (auto s = p.supernode_.rbegin(); s != p.supernode_.rend(); ++s) {
    std::copy_n(v + s->first, s->columns, t);
    const int* rows = p.row_.data() + s->row;
    for (int r = s->columns; r < s->rows; ++r) t[r] = -v[rows[r]];
    std::fill(t + s->rows, t + s->stride, 0.0f);
    MultiplyPanelTransposed({panels_ + s->value, s->columns, s->stride}, t, short_.data());
    std::copy_n(short_.data(), s->columns, v + s->first);
  }
  double* to = &x[0].x;
  for (int i = 0; i < p.size_; ++i)
    to[p.axis_[static_cast<std::size_t>(i)]] = largest * static_cast<double>(v[i]);
}

}  // namespace arthro::simulation
