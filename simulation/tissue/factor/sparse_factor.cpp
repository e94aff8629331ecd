#include "simulation/tissue/factor/sparse_factor.h"

#include <algorithm>
#include <cmath>

#include "simulation/tissue/factor/panel_kernels.h"

namespace arthro::simulation {
SparseFactor::SparseFactor(std::shared_ptr<const FactorPlan> plan) : plan_(std::move(plan)) {
  const FactorPlan& p = *plan_;
  storage_.assign(p.panel_size_ + 2 * kStrip, 0.0f);
  panels_ = storage_.data();
  while (reinterpret_cast<std::uintptr_t>(panels_) % 64) ++panels_;
  vector_.resize(p.size_);
  strip_.resize(RoundUpToStrip(p.tallest_));
  short_.resize(p.widest_);
}

void SparseFactor::TakeWorkMemory(SparseFactor& other) noexcept {
  for (auto buffer : {&SparseFactor::work_, &SparseFactor::inverse_, &SparseFactor::product_,
                      &SparseFactor::right_})
    std::swap(this->*buffer, other.*buffer);
}

void SparseFactor::TakeRoom() {
  const FactorPlan& p = *plan_;
  const std::int64_t widest = p.widest_, tallest = RoundUpToStrip(p.tallest_);
  work_.resize(p.panel_size_ + kStrip);
  inverse_.resize(widest * RoundUpToStrip(p.widest_) + kStrip);
  right_.resize(inverse_.size());
  product_.resize(std::max(widest * tallest, 2 * widest * RoundUpToStrip(p.widest_)) + kStrip);
  map_.resize(p.size_);
  head_.resize(p.supernode_.size());
  next_.resize(p.supernode_.size());
  position_.resize(p.supernode_.size());
}

double SparseFactor::FactorWithin(const BlockMatrix& a, std::span<const double> added,
                                  double shift) {
  TakeRoom();
  if (TryFactor(a, added, 0.0)) return 0.0;
  return TryFactor(a, added, shift) ? shift : -1.0;
}

double SparseFactor::Factor(const BlockMatrix& a, std::span<const double> added) {
  TakeRoom();
  if (TryFactor(a, added, 0.0)) return 0.0;
  for (double shift = 1e-6; shift < 1e3; shift *= 10.0)
    if (TryFactor(a, added, shift)) return shift;
  return -1.0;
}

bool SparseFactor::TryFactor(const BlockMatrix& a, std::span<const double> added, double shift) {
  const FactorPlan& p = *plan_;
  // Copies the matrix into the panels.
  std::fill(work_.begin(), work_.end(), 0.0);
  for (const FactorPlan::Entry& e : p.entry_) work_[e.to] = a.block[e.from / 9][e.from % 9];
  double largest = 0;
  for (const FactorPlan::Supernode& s : p.supernode_)
    for (int j = 0; j < s.columns; ++j) {
      double& diagonal = work_[s.value + static_cast<std::int64_t>(j) * s.stride + j];
      if (!added.empty())
        diagonal +=
            added[p.axis_[static_cast<std::size_t>(s.first) + static_cast<std::size_t>(j)] / 3];
      diagonal += shift * std::abs(diagonal);
      largest = std::max(largest, diagonal);
    }
  if (!std::isfinite(largest)) return false;
  for (const FactorPlan::Supernode& s : p.supernode_)
    for (int j = 0; j < s.columns && shift > 0; ++j)
      work_[s.value + static_cast<std::int64_t>(j) * s.stride + j] += 1e-3 * shift * largest;
  constexpr double kLeastPivot = 1e-14;  // relative to the largest diagonal entry
  const double least = kLeastPivot * largest;

  const int count = static_cast<int>(p.supernode_.size());
  std::fill(head_.begin(), head_.end(), -1);
  for (int i = 0; i < count; ++i) {
    const FactorPlan::Supernode& s = p.supernode_[i];
    const int* rows = p.row_.data() + s.row;
    double* panel = work_.data() + s.value;
    for (int r = 0; r < s.rows; ++r) map_[rows[r]] = r;
    // Subtracts the contributions of finished supernodes with rows among these columns.
    for (int d = head_[i]; d >= 0;) {
      const int following = next_[d];
      const FactorPlan::Supernode& from = p.supernode_[d];
      const int* from_rows = p.row_.data() + from.row;
      const int begin = position_[d];
      int end = begin;
      while (end < from.rows && from_rows[end] < s.first + s.columns) ++end;
      const int m = from.rows - begin, n = end - begin, stride = RoundUpToStrip(m);
      const double* source = work_.data() + from.value + begin;
      MultiplyTransposed(m, n, from.columns, source, from.stride, source, from.stride,
                         product_.data(), stride, 1.0, false, LeftOut::kAboveInC);
      // Rows that are consecutive there are mostly consecutive here, so they are handled in runs.
      for (int r = 0; r < m;) {
        const int first = map_[from_rows[begin + r]], r0 = r++;
        while (r < m && map_[from_rows[begin + r]] == first + r - r0) ++r;
        for (int c = 0; c < std::min(n, r); ++c) {
          const int top = std::max(r0, c);
          double* to = panel + first + top - r0 +
                       static_cast<std::int64_t>(from_rows[begin + c] - s.first) * s.stride;
          const double* column = product_.data() + static_cast<std::int64_t>(c) * stride + top;
          for (int row = 0; row < r - top; ++row) to[row] -= column[row];
        }
      }
      if (end < from.rows) {
        position_[d] = end;
        int& head = head_[p.owner_[static_cast<std::size_t>(from_rows[end])]];
        next_[d] = head;
        head = d;
      }
      d = following;
    }
    // Computes L₁₁ and its inverse, then L₂₁ = A₂₁ L₁₁⁻ᵀ.
    const int n = s.columns, m = s.rows - n, ldi = RoundUpToStrip(n);
    if (!FactorAndInvert(n, panel, s.stride, inverse_.data(), ldi, product_.data(), least))
      return false;
    float* kept = panels_ + s.value;
    for (int j = 0; j < n; ++j)
      for (int r = 0; r < n; ++r)
        kept[static_cast<std::int64_t>(j) * s.stride + r] =
            static_cast<float>(inverse_[j * ldi + r]);
    if (m > 0) {
      const int stride = RoundUpToStrip(m);
      MultiplyTransposed(m, n, n, panel + n, s.stride, inverse_.data(), ldi, product_.data(),
                         stride, 1.0, false, LeftOut::kAboveInB);
      for (int j = 0; j < n; ++j)
        std::copy_n(product_.data() + static_cast<std::int64_t>(j) * stride, m,
                    panel + static_cast<std::int64_t>(j) * s.stride + n);
      // Computes the stored form L₂₁ L₁₁⁻¹.
      for (int j = 0; j < n; ++j)
        for (int r = 0; r < n; ++r) right_[r * ldi + j] = inverse_[j * ldi + r];
      MultiplyTransposed(m, n, n, panel + n, s.stride, right_.data(), ldi, product_.data(), stride,
                         1.0, false, LeftOut::kBelowInB);
      for (int j = 0; j < n; ++j)
        for (int r = 0; r < m; ++r)
          kept[static_cast<std::int64_t>(j) * s.stride + n + r] =
              static_cast<float>(product_[static_cast<std::int64_t>(j) * stride + r]);
      position_[i] = n;
      int& head = head_[p.owner_[static_cast<std::size_t>(rows[n])]];
      next_[i] = head;
      head = i;
    }
  }
  return true;
}

void SparseFactor::Solve(std::span<const glm::dvec3> b, std::span<glm::dvec3> x) noexcept {
  const FactorPlan& p = *plan_;
  float *v = vector_.data(), *strip = strip_.data();
  // Scales the vector, so that neither tiny nor huge forces leave the range of float.
  double largest = 0;
  for (const glm::dvec3& bi : b)
    largest = std::max({largest, std::abs(bi.x), std::abs(bi.y), std::abs(bi.z)});
  std::fill(x.begin(), x.end(), glm::dvec3(0.0));
  const double scale = largest > 0 && std::isfinite(largest) ? largest : 0.0;
  if (p.size_ == 0 || scale == 0) return;
  const double* from = &b[0].x;
  for (int i = 0; i < p.size_; ++i) v[i] = static_cast<float>(from[p.axis_[i]] / largest);
  for (const FactorPlan::Supernode& s : p.supernode_) {
    MultiplyPanel({panels_ + s.value, s.columns, s.stride}, v + s.first, strip);
    const int* rows = p.row_.data() + s.row;
    std::copy_n(strip, s.columns, v + s.first);
    for (int r = s.columns; r < s.rows; ++r) v[rows[r]] -= strip[r];
  }
  for (auto s = p.supernode_.rbegin(); s != p.supernode_.rend(); ++s) {
    const int* rows = p.row_.data() + s->row;
    std::copy_n(v + s->first, s->columns, strip);
    for (int r = s->columns; r < s->rows; ++r) strip[r] = -v[rows[r]];
    std::fill(strip + s->rows, strip + s->stride, 0.0f);
    MultiplyPanelTransposed({panels_ + s->value, s->columns, s->stride}, strip, short_.data());
    std::copy_n(short_.data(), s->columns, v + s->first);
  }
  double* to = &x[0].x;
  for (int i = 0; i < p.size_; ++i) to[p.axis_[i]] = scale * static_cast<double>(v[i]);
}

}  // namespace arthro::simulation
