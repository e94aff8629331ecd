#include "authoring/panorama/graph/refinement/selected_inverse.h"

#include <algorithm>
#include <utility>

namespace arthro::authoring {

SelectedInverse::SelectedInverse(const Eigen::SparseMatrix<double>& matrix) : factor_(matrix) {
  if (factor_.info() != Eigen::Success || !(factor_.vectorD().minCoeff() > 0)) return;
  const int size = static_cast<int>(matrix.rows());
  place_of_.resize(static_cast<std::size_t>(size));
  for (int i = 0; i < size; ++i)
    place_of_[static_cast<std::size_t>(i)] = factor_.permutationP().indices()[i];

  // Unit lower factor L of P A P^T = L D L^T, without its diagonal.
  const Eigen::SparseMatrix<double> lower = factor_.matrixL();
  std::vector<double> l;
  start_.push_back(0);
  for (int j = 0; j < size; ++j) {
    for (Eigen::SparseMatrix<double>::InnerIterator it(lower, j); it; ++it)
      if (it.row() > j) {
        row_.push_back(static_cast<int>(it.row()));
        l.push_back(it.value());
      }
    start_.push_back(static_cast<int>(row_.size()));
  }

  // Z = inv(A) from the last column to the first:
  //   Z_ij = -sum_k Z_ik L_kj,  Z_jj = 1 / D_j - sum_k L_kj Z_kj,  over the k > j of column j.
  // The fill of L makes every Z_ik that is asked for an entry that is already known.
  below_.assign(row_.size(), 0.0);
  diagonal_.assign(static_cast<std::size_t>(size), 0.0);
  std::vector<double> column;
  for (int j = size - 1; j >= 0; --j) {
    const int begin = start_[static_cast<std::size_t>(j)];
    const int end = start_[static_cast<std::size_t>(j) + 1];
    const auto count = static_cast<std::size_t>(end - begin);
    column.assign(count, 0.0);
    for (std::size_t c = 0; c < count; ++c) {
      // Entries of column k of Z in the rows of column j: both ascend, so one walk finds them.
      const int k = row_[static_cast<std::size_t>(begin) + c];
      const double lkj = l[static_cast<std::size_t>(begin) + c];
      column[c] -= diagonal_[static_cast<std::size_t>(k)] * lkj;
      std::size_t walk = static_cast<std::size_t>(start_[static_cast<std::size_t>(k)]);
      for (std::size_t r = c + 1; r < count; ++r) {
        const int i = row_[static_cast<std::size_t>(begin) + r];
        while (row_[walk] < i) ++walk;
        column[r] -= below_[walk] * lkj;
        column[c] -= below_[walk] * l[static_cast<std::size_t>(begin) + r];
      }
    }
    double own = 1.0 / factor_.vectorD()[j];
    for (std::size_t c = 0; c < count; ++c) {
      below_[static_cast<std::size_t>(begin) + c] = column[c];
      own -= l[static_cast<std::size_t>(begin) + c] * column[c];
    }
    diagonal_[static_cast<std::size_t>(j)] = own;
  }
  is_valid_ = true;
}

double SelectedInverse::Entry(int row, int col) const {
  int i = place_of_[static_cast<std::size_t>(row)], j = place_of_[static_cast<std::size_t>(col)];
  if (i == j) return diagonal_[static_cast<std::size_t>(i)];
  if (i < j) std::swap(i, j);
  const auto begin = row_.begin() + start_[static_cast<std::size_t>(j)];
  const auto end = row_.begin() + start_[static_cast<std::size_t>(j) + 1];
  const auto found = std::lower_bound(begin, end, i);
  if (found == end || *found != i) return 0.0;
  return below_[static_cast<std::size_t>(found - row_.begin())];
}

}  // namespace arthro::authoring
