#include <algorithm>
#include <cholmod.h>
#include <numeric>
#include <utility>
#include <vector>

#include "simulation/core/error.h"
#include "simulation/tissue/factor/panel_kernels.h"
#include "simulation/tissue/factor/sparse_factor.h"

namespace arthro::simulation {
namespace {

constexpr double kWornOut = 1.5;  // flops per free axis, relative to a freshly computed order

// CHOLMOD state that frees its objects in every case.
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
  Symbolic(Session& of, cholmod_factor* made) : session(of), value(made) {}
  ~Symbolic() { cholmod_free_factor(&value, &session.common); }
  Symbolic(Symbolic&& other) noexcept
      : session(other.session), value(std::exchange(other.value, nullptr)) {}
  Symbolic& operator=(Symbolic&& other) noexcept {
    std::swap(value, other.value);  // both of one session
    return *this;
  }
};

[[noreturn]] void GiveUp() {
  throw Error(Code::kBadMesh,
              "the mesh is too large to be factored in this computer's memory; use fewer elements");
}

// Lower triangle of the pattern, one row per node; completely fixed nodes have no neighbours.
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
  Analyse({});
}

FactorPlan::FactorPlan(std::shared_ptr<const BlockPattern> pattern, FixedAxes fixed,
                       const FactorPlan& before, std::span<const int> parent)
    : pattern_(std::move(pattern)), fixed_(std::move(fixed)), sought_flops_(before.sought_flops_) {
  std::vector<int> order(parent.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, {}, [&](int node) { return before.rank_[parent[node]]; });
  Analyse(std::move(order));
}

void FactorPlan::Analyse(std::vector<int> order) {
  const int nodes = pattern_->node_count();
  if (fixed_.empty()) fixed_.assign(nodes, 0);
  // Lists the free axes in the mesh's order.
  std::vector<int> index(nodes * 3, -1), axis;
  for (int i = 0; i < nodes; ++i)
    for (int a = 0; a < 3; ++a)
      if (!(fixed_[i] >> a & 1)) {
        index[3 * i + a] = static_cast<int>(axis.size());
        axis.push_back(3 * i + a);
      }
  size_ = static_cast<int>(axis.size());
  rank_.assign(nodes, 0);
  if (size_ == 0) return;

  Session session;
  // Builds the scalar pattern, lower triangle.
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

  // Orders nodes, not axes: this takes a third of the work and keeps a node's axes together.
  const auto analysis_of = [&](const std::vector<int>& of_nodes) {
    std::vector<int> scalars;
    for (int node : of_nodes)
      for (int a = 0; a < 3; ++a)
        if (const int i = index[3 * node + a]; i >= 0) scalars.push_back(i);
    return Symbolic{session,
                    cholmod_analyze_p(scalar.value, scalars.data(), nullptr, 0, &session.common)};
  };
  Symbolic symbolic{session, nullptr};
  if (!order.empty()) {
    symbolic = analysis_of(order);
    flops_ = session.common.fl;
    // Computes a new order if the old one has become much more expensive.
    if (flops_ > kWornOut * sought_flops_ * size_) order.clear();
  }
  if (order.empty()) {
    // Tries both methods: nested dissection gives the smaller factor on volumes, minimum degree on
    // thin sheets.
    const Matrix graph = NodeGraph(session, *pattern_, fixed_);
    for (const bool dissects : {true, false}) {
      std::vector<int> sought(nodes);
      const int done =
          dissects ? cholmod_metis(graph.value, nullptr, 0, true, sought.data(), &session.common)
                   : cholmod_amd(graph.value, nullptr, 0, sought.data(), &session.common);
      if (!done) continue;
      Symbolic analysis = analysis_of(sought);
      if (!analysis.value || (!order.empty() && session.common.fl >= flops_)) continue;
      flops_ = session.common.fl;
      symbolic = std::move(analysis);
      order = std::move(sought);
    }
    sought_flops_ = flops_ / size_;
  }
  if (!symbolic.value || !symbolic.value->is_super) GiveUp();
  for (int i = 0; i < nodes; ++i) rank_[order[i]] = i;

  // Builds the supernodes, with rows padded to strips.
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
    node.stride = RoundUpToStrip(node.rows);
    panel_size_ += static_cast<std::int64_t>(node.stride) * node.columns;
    widest_ = std::max(widest_, node.columns);
    tallest_ = std::max(tallest_, node.rows);
    for (int c = 0; c < node.columns; ++c) owner_[node.first + c] = static_cast<int>(s);
    supernode_.push_back(node);
  }

  // Finds the destination of each entry of the matrix.
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

std::shared_ptr<const FactorPlan> UpdatePlan(const std::shared_ptr<const FactorPlan>& before,
                                             std::span<const int> parent,
                                             const std::shared_ptr<const BlockPattern>& pattern,
                                             const FixedAxes& fixed) {
  if (before->Fits(*pattern, fixed)) return before;
  return parent.empty() ? std::make_shared<const FactorPlan>(pattern, fixed)
                        : std::make_shared<const FactorPlan>(pattern, fixed, *before, parent);
}

}  // namespace arthro::simulation
