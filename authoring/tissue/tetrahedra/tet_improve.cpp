#include "authoring/tissue/tetrahedra/tet_improve.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include "authoring/tissue/tetrahedra/tet_quality.h"
#include "simulation/scene/mesh/surface_finder.h"

namespace arthro::authoring {
namespace {

using Tet = std::array<int, 4>;
constexpr std::array<std::array<int, 2>, 6> kEdges = {
    {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};
// Faces opposite to each corner, facing outwards.
constexpr std::array<std::array<int, 3>, 4> kFaces = {{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};
constexpr double kInverted = -1.0;

double SmallestDihedral(const std::array<glm::dvec3, 4>& x) {
  if (!(glm::dot(glm::cross(x[1] - x[0], x[2] - x[0]), x[3] - x[0]) > 0.0)) return kInverted;
  std::array<glm::dvec3, 4> normal;
  for (int f = 0; f < 4; ++f) {
    const auto& [a, b, c] = kFaces[static_cast<std::size_t>(f)];
    const glm::dvec3 across = glm::cross(x[b] - x[a], x[c] - x[a]);
    const double length = glm::length(across);
    if (!(length > 0.0)) return kInverted;
    normal[f] = across / length;
  }
  double largest_cosine = -1.0;
  for (const auto& [i, j] : kEdges)
    largest_cosine = std::max(largest_cosine, -glm::dot(normal[i], normal[j]));
  return std::acos(std::min(largest_cosine, 1.0));
}

// Elements around an edge from a to b: the ring of the other nodes, counter-clockwise about it.
// Open for an edge of the boundary, from one boundary face to the other.
struct Ring {
  std::vector<int> nodes, tets;
  bool is_closed = false;
};

class Improver {
 public:
  Improver(const TetMesh& mesh, const SurfaceMesh& fine, double goal)
      : finder_(fine), goal_(goal), x_(mesh.rest_positions) {
    const int nodes_per_element = mesh.order == 2 ? 10 : 4;
    of_node_.resize(x_.size());
    for (int e = 0; e < mesh.ElementCount(); ++e) {
      Tet tet;
      for (int k = 0; k < 4; ++k)
        tet[k] = mesh.elements[static_cast<std::size_t>(e) * nodes_per_element + k];
      Add(tet);
    }
    is_boundary_.assign(x_.size(), 0);
    for (std::size_t t = 0; t < tets_.size(); ++t)
      for (const auto& face : kFaces) {
        const int a = tets_[t][face[0]], b = tets_[t][face[1]], c = tets_[t][face[2]];
        if (Neighbour(static_cast<int>(t), a, b, c) >= 0) continue;
        for (const int v : {a, b, c}) is_boundary_[v] = 1;
        for (const auto& [u, v] : {std::pair{a, b}, std::pair{b, c}, std::pair{c, a}})
          tolerance_ = std::max(tolerance_, Deviation(u, v));
      }
  }

  TetImprovement Run(const Progress& progress) {
    TetImprovement report;
    report.before = Smallest();
    constexpr int kMostPasses = 40;
    for (int pass = 0; pass < kMostPasses; ++pass) {
      progress.Step("improving the elements", static_cast<double>(pass) / kMostPasses);
      std::vector<std::pair<double, int>> bad;
      for (int t = 0; t < static_cast<int>(tets_.size()); ++t)
        if (is_alive_[t] && quality_[t] < goal_) bad.emplace_back(quality_[t], t);
      std::sort(bad.begin(), bad.end());
      bool has_changed = false;
      for (const auto& [quality, t] : bad)
        if (is_alive_[t] && quality_[t] < goal_ && Improve(t, report)) has_changed = true;
      if (!has_changed) break;
    }
    report.after = Smallest();
    return report;
  }

  // Elements of order 2 have their new middles halfway along the edges.
  void Write(TetMesh& mesh) const {
    TetMesh better;
    better.order = mesh.order;
    std::vector<int> number(x_.size(), -1);
    for (std::size_t t = 0; t < tets_.size(); ++t)
      if (is_alive_[t])
        for (const int v : tets_[t]) number[v] = 0;
    for (std::size_t v = 0; v < x_.size(); ++v)
      if (number[v] == 0) {
        number[v] = static_cast<int>(better.rest_positions.size());
        better.rest_positions.push_back(x_[v]);
      }
    // The order of the middles is that of TetMesh.
    constexpr std::array<std::array<int, 2>, 6> kMiddles = {
        {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}};
    std::map<std::pair<int, int>, int> middles;
    for (std::size_t t = 0; t < tets_.size(); ++t) {
      if (!is_alive_[t]) continue;
      Tet tet;
      for (int k = 0; k < 4; ++k) tet[k] = number[tets_[t][k]];
      better.elements.insert(better.elements.end(), tet.begin(), tet.end());
      if (mesh.order != 2) continue;
      for (const auto& [i, j] : kMiddles) {
        const auto [entry, is_new] = middles.emplace(
            std::minmax(tet[i], tet[j]), static_cast<int>(better.rest_positions.size()));
        if (is_new)
          better.rest_positions.push_back(
              0.5 * (better.rest_positions[tet[i]] + better.rest_positions[tet[j]]));
        better.elements.push_back(entry->second);
      }
    }
    better.sets["surface"] = SurfaceNodes(better);
    mesh = std::move(better);
  }

 private:
  double QualityOf(const Tet& tet) const {
    return SmallestDihedral({x_[tet[0]], x_[tet[1]], x_[tet[2]], x_[tet[3]]});
  }
  double Smallest() const {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t t = 0; t < tets_.size(); ++t)
      if (is_alive_[t]) least = std::min(least, quality_[t]);
    return least;
  }
  double SmallestOf(const std::vector<int>& tets) const {
    double least = std::numeric_limits<double>::infinity();
    for (const int t : tets) least = std::min(least, quality_[t]);
    return least;
  }
  // Distance of an edge's middle from the fine surface.
  double Deviation(int a, int b) const {
    const glm::dvec3 middle = 0.5 * (x_[a] + x_[b]);
    return glm::distance(middle, finder_.Nearest(middle));
  }

  void Add(const Tet& tet) {
    const int t = static_cast<int>(tets_.size());
    tets_.push_back(tet);
    is_alive_.push_back(1);
    quality_.push_back(QualityOf(tet));
    for (const int v : tet) of_node_[v].push_back(t);
  }
  void Remove(int t) {
    is_alive_[t] = 0;
    for (const int v : tets_[t]) std::erase(of_node_[v], t);
  }
  void Replace(const std::vector<int>& old, const std::vector<Tet>& fresh) {
    for (const int t : old) Remove(t);
    for (const Tet& tet : fresh) Add(tet);
  }
  bool Has(int t, int v) const { return std::ranges::find(tets_[t], v) != tets_[t].end(); }
  // The other element at a face; -1 at the boundary.
  int Neighbour(int t, int a, int b, int c) const {
    for (const int other : of_node_[a])
      if (other != t && Has(other, b) && Has(other, c)) return other;
    return -1;
  }
  bool IsBoundaryFace(int a, int b, int c) const {
    int count = 0;
    for (const int t : of_node_[a]) count += Has(t, b) && Has(t, c) ? 1 : 0;
    return count == 1;
  }

  std::optional<Ring> RingOf(int a, int b) const {
    Ring ring;
    std::map<int, std::pair<int, int>> after;  // node -> next node, element
    std::map<int, int> before;
    for (const int t : of_node_[a]) {
      if (!Has(t, b)) continue;
      const auto [c, d] = OppositeEdge(tets_[t], a, b);
      if (!after.emplace(c, std::pair{d, t}).second || !before.emplace(d, c).second) return {};
    }
    if (after.empty()) return {};
    int start = after.begin()->first;
    for (const auto& [c, next] : after)
      if (!before.contains(c)) start = c;
    ring.nodes.push_back(start);
    for (int at = start; after.contains(at);) {
      const auto [next, t] = after.at(at);
      ring.tets.push_back(t);
      if (next == start) {
        ring.is_closed = true;
        break;
      }
      ring.nodes.push_back(next);
      at = next;
    }
    if (ring.tets.size() != after.size()) return {};  // two fans meet at the edge
    return ring;
  }

  // The other two nodes (c, d) of an element, so that (a, b, c, d) is positive.
  static std::pair<int, int> OppositeEdge(const Tet& tet, int a, int b) {
    std::array<int, 4> order{};
    int rest = 2;
    for (int k = 0; k < 4; ++k) {
      if (tet[k] == a)
        order[0] = k;
      else if (tet[k] == b)
        order[1] = k;
      else
        order[static_cast<std::size_t>(rest++)] = k;
    }
    int swaps = 0;
    for (int i = 0; i < 4; ++i)
      for (int j = i + 1; j < 4; ++j) swaps += order[i] > order[j] ? 1 : 0;
    const int c = tet[order[2]], d = tet[order[3]];
    return swaps % 2 == 0 ? std::pair{c, d} : std::pair{d, c};
  }

  bool Improve(int t, TetImprovement& report) {
    const Tet tet = tets_[t];
    for (const auto& [i, j] : kEdges)
      if (RemoveEdge(tet[i], tet[j])) return ++report.edges_removed, true;
    for (const auto& [i, j, k] : kFaces)
      if (FlipFace(t, tet[i], tet[j], tet[k])) return ++report.faces_flipped, true;
    bool has_moved = false;
    for (const int v : tet)
      if (Move(v)) has_moved = true, ++report.nodes_moved;
    if (has_moved) return true;
    for (const auto& [i, j] : kEdges)
      if (Collapse(tet[i], tet[j]) || Collapse(tet[j], tet[i]))
        return ++report.edges_collapsed, true;
    return false;
  }

  bool RemoveEdge(int a, int b) {
    constexpr std::size_t kMostNodes = 8;
    const auto ring = RingOf(a, b);
    if (!ring || ring->nodes.size() > kMostNodes) return false;
    const std::vector<int>& nodes = ring->nodes;
    const auto n = nodes.size();
    if (ring->is_closed ? n < 3 : n < 2) return false;
    if (!ring->is_closed) {
      // The edge of the boundary becomes the one between the ring's ends.
      const int first = nodes.front(), last = nodes.back();
      for (const int t : of_node_[first])
        if (Has(t, last) && !(Has(t, a) && Has(t, b))) return false;
      if (Deviation(first, last) > std::max(Deviation(a, b), tolerance_)) return false;
      // No node of the boundary may be left without a boundary face.
      if (n == 2 && (of_node_[a].size() < 2 || of_node_[b].size() < 2)) return false;
    }
    const double old = SmallestOf(ring->tets);
    // best[i][j]: smallest angle of the best triangulation of nodes i to j.
    std::vector<std::vector<double>> best(
        n, std::vector<double>(n, std::numeric_limits<double>::infinity()));
    std::vector<std::vector<std::size_t>> apex(n, std::vector<std::size_t>(n, 0));
    for (std::size_t span = 2; span < n; ++span)
      for (std::size_t i = 0; i + span < n; ++i) {
        const std::size_t j = i + span;
        best[i][j] = kInverted;
        for (std::size_t k = i + 1; k < j; ++k) {
          const double own = std::min(QualityOf({nodes[i], nodes[k], nodes[j], b}),
                                      QualityOf({nodes[i], nodes[j], nodes[k], a}));
          const double whole = std::min({own, best[i][k], best[k][j]});
          if (whole > best[i][j]) best[i][j] = whole, apex[i][j] = k;
        }
      }
    if (n > 2 && !(best[0][n - 1] > old + kGain)) return false;
    std::vector<Tet> fresh;
    std::vector<std::pair<std::size_t, std::size_t>> open{{0, n - 1}};
    while (!open.empty()) {
      const auto [i, j] = open.back();
      open.pop_back();
      if (j < i + 2) continue;
      const std::size_t k = apex[i][j];
      fresh.push_back({nodes[i], nodes[k], nodes[j], b});
      fresh.push_back({nodes[i], nodes[j], nodes[k], a});
      open.emplace_back(i, k);
      open.emplace_back(k, j);
    }
    if (ring->is_closed && HasEdge(fresh, ring->tets)) return false;
    Replace(ring->tets, fresh);
    return true;
  }

  // Whether an edge of the new elements already belongs to others: it would be there twice.
  bool HasEdge(const std::vector<Tet>& fresh, const std::vector<int>& old) const {
    const auto is_old = [&](int u, int v) {
      return std::ranges::any_of(old, [&](int t) { return Has(t, u) && Has(t, v); });
    };
    for (const Tet& tet : fresh)
      for (const auto& [i, j] : kEdges) {
        if (is_old(tet[i], tet[j])) continue;
        for (const int t : of_node_[tet[i]])
          if (Has(t, tet[j])) return true;
      }
    return false;
  }

  bool FlipFace(int t, int a, int b, int c) {
    const int other = Neighbour(t, a, b, c);
    if (other < 0) return false;
    const auto apex = [&](int element) {
      for (const int v : tets_[element])
        if (v != a && v != b && v != c) return v;
      return -1;
    };
    const int p = apex(t), q = apex(other);
    for (const int element : of_node_[p])
      if (Has(element, q)) return false;
    // Face (a, b, c) looks away from p: (p, q, a, b) and its turns are positive.
    const std::vector<Tet> fresh = {{p, q, a, b}, {p, q, b, c}, {p, q, c, a}};
    const double old = std::min(quality_[t], quality_[other]);
    for (const Tet& tet : fresh)
      if (!(QualityOf(tet) > old + kGain)) return false;
    Replace({t, other}, fresh);
    return true;
  }

  bool Move(int v) {
    constexpr int kHalvings = 7;
    double step = std::numeric_limits<double>::infinity();
    std::vector<int> around;  // nodes at the other end of boundary edges
    for (const int t : of_node_[v])
      for (const int u : tets_[t])
        if (u != v) {
          step = std::min(step, glm::distance(x_[u], x_[v]));
          if (is_boundary_[v] && is_boundary_[u]) around.push_back(u);
        }
    std::ranges::sort(around);
    around.erase(std::unique(around.begin(), around.end()), around.end());
    if (is_boundary_[v]) std::erase_if(around, [&](int u) { return !IsBoundaryEdge(u, v); });
    step *= 0.5;
    double best = SmallestOf(of_node_[v]);
    bool has_moved = false;
    for (int halving = 0; halving < kHalvings; ++halving) {
      const glm::dvec3 from = x_[v];
      glm::dvec3 place = from;
      for (int code = 0; code < 27; ++code) {
        if (code == 13) continue;  // no direction
        const glm::dvec3 to(code % 3 - 1, code / 3 % 3 - 1, code / 9 - 1);
        glm::dvec3 tried = from + step * glm::normalize(to);
        if (is_boundary_[v]) tried = finder_.Nearest(tried);
        const double worst = WorstWith(v, tried, best);
        if (!(worst > best + kGain) || !StaysNear(v, tried, around)) continue;
        best = worst;
        place = tried;
      }
      if (place == from) {
        step *= 0.5;
        continue;
      }
      x_[v] = place;
      has_moved = true;
    }
    if (has_moved)
      for (const int t : of_node_[v]) quality_[t] = QualityOf(tets_[t]);
    return has_moved;
  }
  // Smallest angle around a node at another place; stops where it is not above `floor`.
  double WorstWith(int v, const glm::dvec3& place, double floor) const {
    double worst = std::numeric_limits<double>::infinity();
    for (const int t : of_node_[v]) {
      std::array<glm::dvec3, 4> x;
      for (int k = 0; k < 4; ++k) x[k] = tets_[t][k] == v ? place : x_[tets_[t][k]];
      worst = std::min(worst, SmallestDihedral(x));
      if (worst <= floor) break;
    }
    return worst;
  }
  bool StaysNear(int v, const glm::dvec3& place, const std::vector<int>& around) const {
    for (const int u : around) {
      const glm::dvec3 middle = 0.5 * (place + x_[u]);
      if (glm::distance(middle, finder_.Nearest(middle)) > std::max(tolerance_, Deviation(u, v)))
        return false;
    }
    return true;
  }
  bool IsBoundaryEdge(int a, int b) const {
    const auto ring = RingOf(a, b);
    return ring && !ring->is_closed;
  }

  // Moves node u onto v.
  bool Collapse(int u, int v) {
    const auto ring = RingOf(u, v);
    if (!ring) return false;
    if (is_boundary_[u] && (!is_boundary_[v] || ring->is_closed)) return false;
    // Nodes that both have as neighbours are those of the ring, and so are edges of both links: the
    // collapse would otherwise pinch the mesh.
    std::vector<int> near_u, near_v;
    for (const auto& [node, near] : {std::pair{u, &near_u}, std::pair{v, &near_v}}) {
      for (const int t : of_node_[node])
        for (const int w : tets_[t])
          if (w != u && w != v) near->push_back(w);
      std::ranges::sort(*near);
      near->erase(std::unique(near->begin(), near->end()), near->end());
    }
    std::vector<int> common, nodes = ring->nodes;
    std::ranges::set_intersection(near_u, near_v, std::back_inserter(common));
    std::ranges::sort(nodes);
    if (common != nodes) return false;
    for (const int t : of_node_[u]) {
      if (Has(t, v)) continue;
      for (const auto& [i, j, k] : kFaces) {
        const int a = tets_[t][i], b = tets_[t][j], c = tets_[t][k];
        if (a == u || b == u || c == u) continue;  // the face of u's link
        for (const int s : of_node_[v])
          if (Has(s, a) && Has(s, b) && Has(s, c)) return false;
      }
    }
    double old = std::numeric_limits<double>::infinity(), worst = old;
    std::vector<Tet> fresh;
    for (const int t : of_node_[u]) {
      old = std::min(old, quality_[t]);
      if (Has(t, v)) continue;
      Tet tet = tets_[t];
      std::ranges::replace(tet, u, v);
      worst = std::min(worst, QualityOf(tet));
      fresh.push_back(tet);
    }
    if (fresh.empty() || !(worst > old + kGain)) return false;
    if (is_boundary_[u])
      for (const int w : near_u)
        if (is_boundary_[w] && IsBoundaryEdge(u, w) && Deviation(v, w) > tolerance_) return false;
    Replace(std::vector<int>(of_node_[u]), fresh);
    return true;
  }

  // A change must gain this much, so that rounding does not let changes go round in circles.
  static constexpr double kGain = 1e-4;  // rad

  SurfaceFinder finder_;
  double goal_, tolerance_ = 0;
  std::vector<glm::dvec3> x_;
  std::vector<Tet> tets_;
  std::vector<char> is_alive_;
  std::vector<double> quality_;  // rad, smallest dihedral angle; -1: inverted
  std::vector<std::vector<int>> of_node_;
  std::vector<char> is_boundary_;
};

}  // namespace

TetImprovement ImproveTets(TetMesh& mesh, const SurfaceMesh& fine, double goal,
                           const Progress& progress) {
  Improver improver(mesh, fine, goal);
  const TetImprovement report = improver.Run(progress);
  improver.Write(mesh);
  return report;
}

}  // namespace arthro::authoring
