#include "authoring/panorama/graph/links/pair_graph.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <queue>
#include <utility>

#include <Eigen/Eigenvalues>

#include "simulation/core/at.h"

namespace arthro::authoring {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr double kFloor = 0.05;  // px; keeps overconfident pairs from hiding the length of a chain

struct Edge {
  int to, pair;
};

std::vector<std::vector<Edge>> EdgesOf(int frames, const std::vector<PairEstimate>& pairs) {
  std::vector<std::vector<Edge>> edges(At(frames));
  for (int i = 0; i < static_cast<int>(pairs.size()); ++i) {
    const PairEstimate& pair = pairs[At(i)];
    edges[At(pair.a)].push_back({pair.b, i});
    edges[At(pair.b)].push_back({pair.a, i});
  }
  return edges;
}

struct Shortest {
  std::vector<double> variance;
  std::vector<int> pair_to_parent;
  std::vector<int> order;  // order of arrival
};

Shortest ShortestFrom(int frames, const std::vector<PairEstimate>& pairs, int root) {
  const std::vector<std::vector<Edge>> edges = EdgesOf(frames, pairs);
  const std::vector<double> cost = EdgeVariances(pairs);
  Shortest shortest{std::vector<double>(At(frames), kNever), std::vector<int>(At(frames), -1), {}};
  using Entry = std::pair<double, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  shortest.variance[At(root)] = 0;
  queue.push({0.0, root});
  std::vector<bool> is_done(At(frames), false);
  while (!queue.empty()) {
    const int here = queue.top().second;
    queue.pop();
    if (is_done[At(here)]) continue;
    is_done[At(here)] = true;
    shortest.order.push_back(here);
    for (const Edge& edge : edges[At(here)]) {
      const double there = shortest.variance[At(here)] + cost[At(edge.pair)];
      if (there >= shortest.variance[At(edge.to)]) continue;
      shortest.variance[At(edge.to)] = there;
      shortest.pair_to_parent[At(edge.to)] = edge.pair;
      queue.push({there, edge.to});
    }
  }
  return shortest;
}

}  // namespace

double PairDeviation(const PairEstimate& pair, double floor_px) {
  using Row8 = Eigen::Matrix<double, 8, 8, Eigen::RowMajor>;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 8, 8>> eigen(
      Eigen::Map<const Row8>(pair.information.val), Eigen::EigenvaluesOnly);
  const double least = eigen.eigenvalues()[0];
  if (!(least > 0)) return kNever;
  return std::max(floor_px, 1 / std::sqrt(least));
}

std::vector<int> PiecesOf(int frames, const std::vector<PairEstimate>& pairs) {
  std::vector<int> root(At(frames));
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&](int i) {
    while (root[At(i)] != i) i = root[At(i)] = root[At(root[At(i)])];
    return i;
  };
  for (const PairEstimate& pair : pairs) {
    const int a = find(pair.a), b = find(pair.b);
    root[At(std::max(a, b))] = std::min(a, b);
  }
  std::vector<int> size(At(frames), 0), first;
  for (int i = 0; i < frames; ++i)
    if (size[At(find(i))]++ == 0) first.push_back(find(i));
  std::stable_sort(first.begin(), first.end(),
                   [&](int a, int b) { return size[At(a)] > size[At(b)]; });
  std::vector<int> rank(At(frames), 0), piece(At(frames));
  for (int i = 0; i < static_cast<int>(first.size()); ++i) rank[At(first[At(i)])] = i;
  for (int i = 0; i < frames; ++i) piece[At(i)] = rank[At(find(i))];
  return piece;
}

int CentralFrame(int frames, const std::vector<PairEstimate>& pairs, int member) {
  // Two sweeps find the ends of the longest path; its middle is central enough, in linear time.
  const int end = ShortestFrom(frames, pairs, member).order.back();
  const Shortest from_end = ShortestFrom(frames, pairs, end);
  const int other = from_end.order.back();
  int here = other;
  const double half = from_end.variance[At(other)] / 2;
  while (from_end.pair_to_parent[At(here)] >= 0 && from_end.variance[At(here)] > half) {
    const PairEstimate& pair = pairs[At(from_end.pair_to_parent[At(here)])];
    here = pair.a == here ? pair.b : pair.a;
  }
  return here;
}

Tree LeastVarianceTree(int frames, const std::vector<PairEstimate>& pairs, int root) {
  const Shortest shortest = ShortestFrom(frames, pairs, root);
  Tree tree{std::vector<cv::Matx33d>(At(frames), cv::Matx33d::eye()), shortest.variance,
            shortest.pair_to_parent};
  for (const int frame : shortest.order) {
    const int via = shortest.pair_to_parent[At(frame)];
    if (via < 0) continue;
    const PairEstimate& pair = pairs[At(via)];
    const int parent = pair.a == frame ? pair.b : pair.a;
    const cv::Matx33d parent_from_frame = pair.a == frame ? pair.b_from_a : pair.b_from_a.inv();
    cv::Matx33d m = tree.root_from_frame[At(parent)] * parent_from_frame;
    tree.root_from_frame[At(frame)] = m * (1.0 / m(2, 2));
  }
  return tree;
}

std::vector<double> EdgeVariances(const std::vector<PairEstimate>& pairs) {
  std::vector<double> variances;
  for (const PairEstimate& pair : pairs) {
    const double deviation = PairDeviation(pair, kFloor);
    variances.push_back(std::min(deviation * deviation, 1e12));
  }
  return variances;
}

VarianceMap::VarianceMap(int frames, const std::vector<PairEstimate>& pairs) : edges_(At(frames)) {
  const std::vector<double> variances = EdgeVariances(pairs);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    edges_[At(pairs[i].a)].push_back({pairs[i].b, variances[i]});
    edges_[At(pairs[i].b)].push_back({pairs[i].a, variances[i]});
  }
}

std::vector<double> VarianceMap::From(int frame) const {
  std::vector<double> variance(edges_.size(), kNever);
  using Entry = std::pair<double, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  variance[At(frame)] = 0;
  queue.push({0.0, frame});
  while (!queue.empty()) {
    const auto [so_far, here] = queue.top();
    queue.pop();
    if (so_far > variance[At(here)]) continue;
    for (const Edge& edge : edges_[At(here)]) {
      const double there = so_far + edge.variance;
      if (there >= variance[At(edge.to)]) continue;
      variance[At(edge.to)] = there;
      queue.push({there, edge.to});
    }
  }
  return variance;
}

std::vector<bool> BridgesOf(int frames, const std::vector<PairEstimate>& pairs) {
  // Tarjan's lowest reachable number, without recursion: clips are long chains.
  const std::vector<std::vector<Edge>> edges = EdgesOf(frames, pairs);
  std::vector<bool> is_bridge(pairs.size(), false);
  std::vector<int> number(At(frames), -1), low(At(frames), 0);
  std::vector<std::size_t> next(At(frames), 0);
  int count = 0;
  struct Visit {
    int frame, via;
  };
  for (int start = 0; start < frames; ++start) {
    if (number[At(start)] >= 0) continue;
    std::vector<Visit> stack{{start, -1}};
    number[At(start)] = low[At(start)] = count++;
    while (!stack.empty()) {
      const Visit here = stack.back();
      if (next[At(here.frame)] < edges[At(here.frame)].size()) {
        const Edge edge = edges[At(here.frame)][next[At(here.frame)]++];
        if (edge.pair == here.via) continue;
        if (number[At(edge.to)] >= 0) {
          low[At(here.frame)] = std::min(low[At(here.frame)], number[At(edge.to)]);
        } else {
          number[At(edge.to)] = low[At(edge.to)] = count++;
          stack.push_back({edge.to, edge.pair});
        }
        continue;
      }
      stack.pop_back();
      if (stack.empty()) continue;
      const int parent = stack.back().frame;
      low[At(parent)] = std::min(low[At(parent)], low[At(here.frame)]);
      if (low[At(here.frame)] > number[At(parent)]) is_bridge[At(here.via)] = true;
    }
  }
  return is_bridge;
}

}  // namespace arthro::authoring
