// Entries of the inverse of a sparse symmetric matrix within the pattern of its Cholesky factor,
// the diagonal blocks among them, without computing the rest [Takahashi et al. 1973].
#pragma once

#include <vector>

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

namespace arthro::authoring {

class SelectedInverse {
 public:
  explicit SelectedInverse(const Eigen::SparseMatrix<double>& matrix);

  bool is_valid() const { return is_valid_; }  // false: the matrix is not positive definite

  // The requested entries must lie in the matrix's own pattern.
  template <int kSize>
  Eigen::Matrix<double, kSize, kSize> Block(int row, int col) const {
    Eigen::Matrix<double, kSize, kSize> block;
    for (int r = 0; r < kSize; ++r)
      for (int c = 0; c < kSize; ++c) block(r, c) = Entry(row + r, col + c);
    return block;
  }
  double Entry(int row, int col) const;

  Eigen::MatrixXd Solve(const Eigen::MatrixXd& right) const { return factor_.solve(right); }

 private:
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor_;
  bool is_valid_ = false;
  // Lower triangle in the factor's order: below the diagonal by columns, rows ascending.
  std::vector<int> start_, row_;
  std::vector<double> below_, diagonal_;
  std::vector<int> place_of_;  // index of an unknown in the factor's order
};

}  // namespace arthro::authoring
