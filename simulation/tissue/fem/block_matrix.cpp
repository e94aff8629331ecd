#include "simulation/tissue/fem/block_matrix.h"

#include <algorithm>

#include "simulation/tissue/fem/element_kernel.h"

namespace arthro::simulation {

int BlockPattern::Find(int row, int i) const {
  const auto begin = column.begin() + row_begin[row], end = column.begin() + row_begin[row + 1];
  const auto found = std::lower_bound(begin, end, i);
  return found != end && *found == i ? static_cast<int>(found - column.begin()) : -1;
}

BlockPattern MakePattern(std::span<const int> elements, int nodes_per_element, int node_count) {
  // Lists the elements of each node, then collects and sorts their nodes, row by row.
  const int n = nodes_per_element;
  std::vector<int> begin(node_count + 1, 0);
  for (const int node : elements) ++begin[node + 1];
  for (int i = 0; i < node_count; ++i) begin[i + 1] += begin[i];
  std::vector<int> element(elements.size()), next(begin.begin(), begin.end() - 1);
  for (std::size_t k = 0; k < elements.size(); ++k)
    element[next[elements[k]]++] = static_cast<int>(k) / n;

  BlockPattern pattern;
  pattern.row_begin.push_back(0);
  std::vector<int> row, seen_in(node_count, -1);
  for (int i = 0; i < node_count; ++i) {
    row.assign(1, i);  // the diagonal also exists without an element: it holds the mass
    seen_in[i] = i;
    for (int k = begin[i]; k < begin[i + 1]; ++k)
      for (const int node : elements.subspan(static_cast<std::size_t>(element[k]) * n, n))
        if (seen_in[node] != i) {
          seen_in[node] = i;
          row.push_back(node);
        }
    std::sort(row.begin(), row.end());
    const auto self = std::lower_bound(row.begin(), row.end(), i) - row.begin();
    pattern.diagonal.push_back(static_cast<int>(pattern.column.size() + self));
    pattern.column.insert(pattern.column.end(), row.begin(), row.end());
    pattern.row_begin.push_back(static_cast<int>(pattern.column.size()));
  }
  return pattern;
}

void Multiply(const BlockMatrix& a, std::span<const glm::dvec3> x, std::span<glm::dvec3> y,
              const ElementKernel* kernel) noexcept {
  if (kernel == nullptr) kernel = &BestKernel();
  const BlockPattern& p = *a.pattern;
  kernel->multiply(
      {p.node_count(), p.row_begin.data(), p.column.data(), a.block.data(), x.data(), y.data()});
}

}  // namespace arthro::simulation
