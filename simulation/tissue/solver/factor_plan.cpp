#include <algorithm>
#include <cholmod.h>
#include <vector>

#include "simulation/core/error.h"
#include "simulation/tissue/solver/panel_kernels.h"
#include "simulation/tissue/solver/sparse_factor.h"

namespace arthro::simulation {
namespace {

// CHOLMOD's own state, its objects given back whatever happens.
struct Session {
  cholmod_common common;
  Session() {
    cholmod_start(&common);
    common.print = 0;
    common.supernodal = CHOLMOD_SUPERNODAL;
    common.nmethods = 1;
    common.method[0].ordering = CHOLMOD_GIVEN;
    common.postorder = true;
  }
  ~Session() { cholmod_finish(&common); }
};

struct Matrix {
  Session& session;
  cholmod_sparse* value;
  ~Matrix() { cholmod_free_sparse(&value, &session.common); }
};

struct Symbolic {
  Session& session;
  cholmod_factor* value;
  ~Symbolic() { cholmod_free_factor(&value, &session.common); }
};

[[noreturn]] void GiveUp() {
  throw Error(Code::kBadMesh,
              "the mesh is too large to be factored in this computer's memory; use fewer elements");
}

// Lower triangle of the pattern, one row a node; nodes that are held altogether meet nobody.
Matrix NodeGraph(Session& session, const BlockPattern& pattern, const FixedAxes& fixed) {
  const auto n = pattern.node_count();
  Matrix graph{session, cholmod_allocate_sparse(n, n, pattern.column.size(), true, true, -1,
                                                CHOLMOD_PATTERN, &session.common)};
  if (!graph.value) GiveUp();
  auto* begin = static_cast<int*>(graph.value->p);
  auto* row = static_cast<int*>(graph.value->i);
  int count = 0;
  for (int j = 0; j < n; ++j) {
    begin[j] = count;
    for (int k = pattern.row_begin[j]; k < pattern.row_begin[j + 1]; ++k)
      if (const int i = pattern.column[k]; i == j || (i > j && fixed[i] != 7 && fixed[j] != 7))
        row[count++] = i;
  }
  begin[n] = count;
  return graph;
}

}  // namespace

FactorPlan::FactorPlan(std::shared_ptr<const BlockPattern> pattern, FixedAxes fixed)
    : pattern_(std::move(pattern)), fixed_(std::move(fixed)) {
  const int nodes = pattern_->node_count();
  if (fixed_.empty()) fixed_.assign(nodes, 0);
  // Free axes in the mesh's order.
  std::vector<int> index(nodes * 3, -1), axis;
  for (int i = 0; i < nodes; ++i)
    for (int a = 0; a < 3; ++a)
      if (!(fixed_[i] >> a & 1)) {
        index[3 * i + a] = static_cast<int>(axis.size());
        axis.push_back(3 * i + a);
      }
  size_ = static_cast<int>(axis.size());
  if (size_ == 0) return;

  Session session;
  const Matrix graph = NodeGraph(session, *pattern_, fixed_);
  // The scalar pattern, lower triangle.
  std::size_t entries = 0;
  for (int j : axis) entries += 3 * (pattern_->row_begin[j / 3 + 1] - pattern_->row_begin[j / 3]);
  const auto n = size_;
  const Matrix scalar{session, cholmod_allocate_sparse(n, n, entries, true, true, -1,
                                                       CHOLMOD_PATTERN, &session.common)};
  if (!scalar.value) GiveUp();
  auto* begin = static_cast<int*>(scalar.value->p);
  auto* row = static_cast<int*>(scalar.value->i);
  std::vector<std::int32_t> from;
  int count = 0;
  for (int j = 0; j < n; ++j) {
    begin[j] = count;
    const int node = axis[j] / 3, along = axis[j] % 3;
    for (int k = pattern_->row_begin[node]; k < pattern_->row_begin[node + 1]; ++k)
      for (int a = 0; a < 3; ++a) {
        const int i = index[3 * pattern_->column[static_cast<std::size_t>(k)] + a];
        if (i < static_cast<int>(j)) continue;
        row[count++] = i;
        from.push_back(k * 9 + along * 3 +
                       a);  // entry (along, a) of block (node, column): symmetric
      }
  }
  begin[n] = count;

  // Nodes are ordered, not axes: a third of the work, and a node's axes stay together. Nested
  // dissection gives the smaller factor on volumes, minimum degree on thin sheets: both are tried.
  double best = 0;
  std::vector<int> best_order;
  for (const bool dissects : {true, false}) {
    std::vector<int> order(nodes);
    const int done =
        dissects ? cholmod_metis(graph.value, nullptr, 0, true, order.data(), &session.common)
                 : cholmod_amd(graph.value, nullptr, 0, order.data(), &session.common);
    if (!done) continue;
    std::vector<int> scalars;
    for (int node : order)
      for (int a = 0; a < 3; ++a)
        if (const int i = index[3 * node + a]; i >= 0) scalars.push_back(i);
    const Symbolic symbolic{
        session, cholmod_analyze_p(scalar.value, scalars.data(), nullptr, 0, &session.common)};
    if (!symbolic.value) continue;
    if (best_order.empty() || session.common.fl < best) {
      best = session.common.fl;
      best_order = scalars;
    }
  }
  if (best_order.empty()) GiveUp();
  const Symbolic symbolic{
      session, cholmod_analyze_p(scalar.value, best_order.data(), nullptr, 0, &session.common)};
  if (!symbolic.value || !symbolic.value->is_super) GiveUp();
  flops_ = best;

  // Supernodes, with rows padded to strips.
  const cholmod_factor& l = *symbolic.value;
  const auto* permutation = static_cast<const int*>(l.Perm);
  const auto* first = static_cast<const int*>(l.super);
  const auto* rows_begin = static_cast<const int*>(l.pi);
  const auto* rows = static_cast<const int*>(l.s);
  std::vector<int> permuted(n);
  axis_.resize(n);
  owner_.resize(n);
  for (int i = 0; i < n; ++i) {
    permuted[permutation[i]] = static_cast<int>(i);
    axis_[i] = axis[permutation[i]];
  }
  row_.assign(rows, rows + rows_begin[l.nsuper]);
  for (std::size_t s = 0; s < l.nsuper; ++s) {
    Supernode node{first[s], first[s + 1] - first[s], rows_begin[s + 1] - rows_begin[s],
                   0,        rows_begin[s],           panel_size_};
    node.stride = StripsOf(node.rows);
    panel_size_ += static_cast<std::int64_t>(node.stride) * node.columns;
    widest_ = std::max(widest_, node.columns);
    tallest_ = std::max(tallest_, node.rows);
    for (int c = 0; c < node.columns; ++c) owner_[node.first + c] = static_cast<int>(s);
    supernode_.push_back(node);
  }

  // Where each entry of the matrix goes.
  entry_.reserve(from.size());
  for (int j = 0; j < n; ++j)
    for (int k = begin[j]; k < begin[j + 1]; ++k) {
      const int a = permuted[j], b = permuted[row[k]];
      const int column = std::min(a, b), below = std::max(a, b);
      const Supernode& s = supernode_[owner_[static_cast<std::size_t>(column)]];
      const auto list = row_.begin() + s.row;
      const auto place = std::lower_bound(list, list + s.rows, below) - list;
      entry_.push_back(
          {s.value + static_cast<std::int64_t>(column - s.first) * s.stride + place, from[k]});
    }
}

}  // namespace arthro::simulation
