#include "simulation/tissue/cut/cut_mesh.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "simulation/core/error.h"
#include "simulation/tissue/cut/element_point.h"
#include "simulation/tissue/fem/tet_shape.h"

namespace arthro::simulation {
namespace {

constexpr std::uint8_t kNone = 255;
constexpr std::array<int, 4> kLevels{2, 4, 8, 16};
constexpr std::array<std::array<std::size_t, 2>, 6> kEdges{
    {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}};

std::size_t At(int i) { return static_cast<std::size_t>(i); }

bool Meet(const Box3& a, const Box3& b) {
  for (int i = 0; i < 3; ++i)
    if (!(a.low[i] <= b.high[i] && b.low[i] <= a.high[i])) return false;
  return true;
}

// Sets of numbers that are joined; the lowest of a set stands for it.
class Sets {
 public:
  explicit Sets(std::size_t count) : root_(count) { std::iota(root_.begin(), root_.end(), 0); }
  int Find(int i) {
    while (root_[At(i)] != i) i = root_[At(i)] = root_[At(root_[At(i)])];
    return i;
  }
  void Join(int i, int j) {
    const int a = Find(i), b = Find(j);
    root_[At(std::max(a, b))] = std::min(a, b);
  }

 private:
  std::vector<int> root_;
};

std::vector<TetLattice> AllLattices() {
  std::vector<TetLattice> lattices;
  for (const int n : kLevels) lattices.push_back(MakeTetLattice(n));
  return lattices;
}

}  // namespace

MeshCutter::MeshCutter(TetMesh whole, double spacing, const CutOptions& options)
    : whole_(std::move(whole)),
      options_(options),
      lattices_(std::make_shared<const std::vector<TetLattice>>(AllLattices())) {
  const int count = whole_.ElementCount(), order = whole_.order;
  if (count == 0)
    throw Error(Code::kBadMesh, "a mesh without elements cannot be cut; give it some");
  for (const TetLattice& lattice : *lattices_) {
    auto& shapes = shape_.emplace_back();
    for (std::size_t p = 0; p < lattice.point.size(); ++p)
      shapes.push_back(ShapeAt(order, lattice.BarycentricOf(static_cast<int>(p))).value);
  }
  const auto& quadrature = QuadratureOf(order);
  for (int e = 0; e < count; ++e) {
    const auto nodes = NodesOf(e);
    const auto x = [&](std::size_t i) { return whole_.rest_positions[At(nodes[i])]; };
    Box3 box{x(0), x(0)};
    for (std::size_t i = 1; i < nodes.size(); ++i) {
      box.low = glm::min(box.low, x(i));
      box.high = glm::max(box.high, x(i));
    }
    // A curved side may bulge past its nodes.
    const glm::dvec3 slack = order == 2 ? 0.125 * (box.high - box.low) : glm::dvec3(0.0);
    box_.push_back({box.low - slack, box.high + slack});
    double longest = 0.0;
    for (std::size_t i = 0; i < kEdges.size(); ++i) {
      const glm::dvec3 a = x(kEdges[i][0]), b = x(kEdges[i][1]);
      longest = std::max(longest, order == 2 ? glm::length(x(4 + i) - a) + glm::length(b - x(4 + i))
                                             : glm::length(b - a));
    }
    std::uint8_t level = 0;
    while (level + 1u < kLevels.size() && longest > kLevels[level] * spacing) ++level;
    level_.push_back(level);
    for (const TetShape& point : quadrature) {
      glm::dmat3 jacobian(0.0);
      for (std::size_t i = 0; i < nodes.size(); ++i)
        for (int c = 0; c < 3; ++c) jacobian[c] += x(i) * point.slope[i][c];
      volume_.push_back(point.weight * glm::determinant(jacobian) / 6.0);
    }
  }
  elements_.resize(At(count));
  before_of_.assign(At(count), -1);
  BuildFaces();
  touching_.resize(faces_.size());
  for (int e = 0; e < count; ++e) {
    Part part;
    part.share.fill(1.0);
    elements_[At(e)].parts = {part};
  }
  Assemble({});
  for (std::size_t i = 0; i < result_.previous_node.size(); ++i)
    result_.previous_node[i] = result_.parent_node[i];
}

std::span<const int> MeshCutter::NodesOf(int e) const {
  const auto n = At(whole_.NodesPerElement());
  return std::span(whole_.elements).subspan(At(e) * n, n);
}

glm::dvec3 MeshCutter::PlaceOf(int e, int point) const {
  const auto nodes = NodesOf(e);
  const auto& value = shape_[level_[At(e)]][At(point)];
  glm::dvec3 x(0.0);
  for (std::size_t i = 0; i < nodes.size(); ++i)
    x += value[i] * whole_.rest_positions[At(nodes[i])];
  return x;
}

// All lattice points of an element: along a row of them the map is a parabola.
void MeshCutter::PlacesIn(int e, std::span<glm::dvec3> places) const {
  const TetLattice& lattice = LatticeOf(e);
  const int n = lattice.n;
  std::size_t p = 0;
  for (int k = 0; k <= n; ++k)
    for (int j = 0; j + k <= n; ++j) {
      const int length = n - j - k;  // points are numbered along rows
      if (length < 3) {
        for (int i = 0; i <= length; ++i, ++p) places[p] = PlaceOf(e, static_cast<int>(p));
        continue;
      }
      const auto first = static_cast<int>(p);
      const glm::dvec3 a = PlaceOf(e, first), c = PlaceOf(e, first + length);
      const int middle = length / 2;
      const glm::dvec3 b = PlaceOf(e, first + middle);
      // Newton's form through the points 0, middle and length.
      const glm::dvec3 slope = (b - a) / static_cast<double>(middle);
      const glm::dvec3 bend =
          ((c - b) / static_cast<double>(length - middle) - slope) / static_cast<double>(length);
      for (int i = 0; i <= length; ++i, ++p)
        places[p] = a + static_cast<double>(i) * (slope + static_cast<double>(i - middle) * bend);
    }
}

void MeshCutter::BuildFaces() {
  struct Half {
    std::array<int, 3> corners;  // rising
    int element, face;
  };
  beside_.assign(elements_.size(), {-1, -1, -1, -1});
  std::vector<Half> halves;
  for (int e = 0; e < whole_.ElementCount(); ++e)
    for (int f = 0; f < 4; ++f) {
      const auto nodes = NodesOf(e);
      std::array<int, 3> corners;
      for (std::size_t i = 0; i < 3; ++i) corners[i] = nodes[At(kTetFaces[At(f)][i])];
      std::sort(corners.begin(), corners.end());
      halves.push_back({corners, e, f});
    }
  std::stable_sort(halves.begin(), halves.end(),
                   [](const Half& a, const Half& b) { return a.corners < b.corners; });
  for (std::size_t i = 0; i + 1 < halves.size(); ++i)
    if (halves[i].corners == halves[i + 1].corners) {
      const Half &a = halves[i], &b = halves[i + 1];
      faces_.push_back({a.element, b.element, a.face, b.face});
      beside_[At(a.element)][At(a.face)] = b.element;
      beside_[At(b.element)][At(b.face)] = a.element;
      ++i;
    }
}

// What is still there of element e, and in which parts.
void MeshCutter::LookAt(const SolidField& field, int e) {
  Element& element = elements_[At(e)];
  const TetLattice& lattice = LatticeOf(e);
  const std::size_t count = lattice.point.size();
  bool is_whole = !field.MayBeCut(box_[At(e)]);
  if (!is_whole) {
    places_.resize(count);
    values_.resize(count);
    PlacesIn(e, places_);
    grid_node_.resize(count);
    field.CutDistances(places_, values_, grid_node_);
    is_whole = std::none_of(values_.begin(), values_.end(), [](double v) { return v > 0.0; });
  }
  if (is_whole) {
    Part part;
    part.share.fill(1.0);
    element.label.clear();
    element.parts = {part};
    return;
  }
  // Parts: solid points that are neighbours and hang together in the field's grid, too.
  element.parts.clear();
  element.label.assign(count, kNone);
  auto& front = front_;
  for (std::size_t p = 0; p < count; ++p) {
    if (values_[p] > 0.0 || element.label[p] != kNone || element.parts.size() == kNone) continue;
    const auto label = static_cast<std::uint8_t>(element.parts.size());
    element.parts.emplace_back().seed = static_cast<int>(p);
    element.label[p] = label;
    front.assign(1, static_cast<std::int16_t>(p));
    while (!front.empty()) {
      const auto q = static_cast<std::size_t>(front.back());
      front.pop_back();
      for (auto i = lattice.neighbour_begin[q]; i < lattice.neighbour_begin[q + 1]; ++i) {
        const auto other = At(lattice.neighbour[At(i)]);
        if (values_[other] > 0.0 || element.label[other] != kNone) continue;
        if (!field.AreJoined(grid_node_[q], grid_node_[other])) continue;
        element.label[other] = label;
        front.push_back(lattice.neighbour[At(i)]);
      }
    }
  }
  // A lattice part's solid corners are all neighbours: but at a hinge they are of one part.
  const bool has_one_point = whole_.order == 1;
  const std::uint8_t* labels = element.label.data();
  for (const TetLattice::Cell& cell : lattice.cell) {
    const std::uint8_t first = labels[cell.corner[0]];
    bool is_even = true;
    for (const std::int16_t corner : cell.corner) is_even &= labels[corner] == first;
    if (is_even) {
      if (first == kNone) continue;
      Part& part = element.parts[first];
      if (has_one_point)
        part.share[0] += cell.last - cell.first;
      else
        for (std::size_t q = 0; q < 4; ++q) part.share[q] += cell.region[q];
      continue;
    }
    for (std::int32_t t = cell.first; t < cell.last; ++t) {
      const auto& corner = lattice.part[At(t)];
      std::array<double, 4> value;
      std::uint8_t label = kNone;
      for (std::size_t c = 0; c < 4; ++c) {
        value[c] = values_[At(corner[c])];
        label = std::min(label, labels[corner[c]]);
      }
      if (label == kNone) continue;
      const double solid = NegativePart(value);
      Part& part = element.parts[label];
      if (has_one_point)
        part.share[0] += solid;
      else
        AddToRegions(lattice.region[At(t)], solid, part.share);
    }
  }
  for (Part& part : element.parts)
    for (std::size_t q = 0; q < 4; ++q) {
      part.share[q] /=
          has_one_point ? static_cast<double>(lattice.part.size()) : lattice.region_total[q];
      part.share[q] = std::min(part.share[q], 1.0);
    }
}

// Which parts of the two elements touch through their common face: on at least one of the coarser
// one's triangles all three points are solid in both.
void MeshCutter::Touch(const Face& face, std::vector<std::array<int, 2>>& pairs) const {
  pairs.clear();
  const Element &a = elements_[At(face.first)], &b = elements_[At(face.second)];
  if (a.parts.empty() || b.parts.empty()) return;
  if (a.label.empty() && b.label.empty()) {
    pairs.push_back({0, 0});
    return;
  }
  const TetLattice &la = LatticeOf(face.first), &lb = LatticeOf(face.second);
  const int n = std::min(la.n, lb.n);
  // Corners of the face in the order of their nodes, in each element's own counting.
  const auto corners = [&](int e, int f) {
    std::array<int, 3> local;
    for (std::size_t i = 0; i < 3; ++i) local[i] = kTetFaces[At(f)][i];
    const auto nodes = NodesOf(e);
    std::sort(local.begin(), local.end(),
              [&](int i, int j) { return nodes[At(i)] < nodes[At(j)]; });
    return local;
  };
  const std::array<int, 3> ca = corners(face.first, face.first_face),
                           cb = corners(face.second, face.second_face);
  const auto label = [&](const Element& element, const TetLattice& lattice,
                         const std::array<int, 3>& corner, const std::array<int, 3>& m) {
    if (element.label.empty()) return std::uint8_t{0};
    std::array<int, 4> l{};
    for (std::size_t i = 0; i < 3; ++i) l[At(corner[i])] = m[i] * (lattice.n / n);
    return element.label[At(lattice.PointAt(l[1], l[2], l[3]))];
  };
  std::array<int, 2> last{-1, -1};
  const auto keep = [&](int i, int j) {
    const std::array<int, 2> pair{i, j};
    if (i == last[0] && j == last[1]) return;
    last = pair;
    if (std::find(pairs.begin(), pairs.end(), pair) == pairs.end()) pairs.push_back(pair);
  };
  for (int i = 0; i < n; ++i)
    for (int j = 0; i + j < n; ++j)
      for (int down = 0; down < 2; ++down) {
        if (down == 1 && i + j + 2 > n) continue;
        std::array<std::array<int, 2>, 3> m;
        if (down == 0)
          m = {{{i, j}, {i + 1, j}, {i, j + 1}}};
        else
          m = {{{i + 1, j}, {i, j + 1}, {i + 1, j + 1}}};
        std::array<std::uint8_t, 3> in_a, in_b;
        bool is_solid = true;
        for (std::size_t c = 0; c < 3 && is_solid; ++c) {
          const std::array<int, 3> at{n - m[c][0] - m[c][1], m[c][0], m[c][1]};
          in_a[c] = label(a, la, ca, at);
          in_b[c] = label(b, lb, cb, at);
          is_solid = in_a[c] != kNone && in_b[c] != kNone;
        }
        if (is_solid)
          for (std::size_t c = 0; c < 3; ++c) keep(in_a[c], in_b[c]);
      }
}

const CutMesh& MeshCutter::Assemble(const SolidField& field) {
  const int points = whole_.order == 2 ? 4 : 1;
  const auto per_element = At(whole_.NodesPerElement());
  // Copies: parts with enough left in them.
  struct Copy {
    int element, part;
  };
  std::vector<Copy> copies;
  for (int e = 0; e < static_cast<int>(elements_.size()); ++e)
    for (std::size_t p = 0; p < elements_[At(e)].parts.size(); ++p) {
      Part& part = elements_[At(e)].parts[p];
      double whole = 0.0;
      part.volume = 0.0;
      for (int q = 0; q < points; ++q) {
        const double volume = volume_[At(e * points + q)];
        part.volume += part.share[At(q)] * volume;
        whole += volume;
      }
      part.copy = part.volume < options_.min_share * whole ? -1 : static_cast<int>(copies.size());
      if (part.copy >= 0) copies.push_back({e, static_cast<int>(p)});
    }
  // Pieces and nodes: joined where solid touches solid through a face.
  Sets pieces(copies.size()), nodes(copies.size() * per_element);
  const std::size_t face_nodes = whole_.order == 2 ? 6 : 3;
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    const Face& face = faces_[f];
    auto& pairs = touching_[f];
    if (!is_assembled_ || before_of_[At(face.first)] >= 0 || before_of_[At(face.second)] >= 0)
      Touch(face, pairs);
    for (const auto& [p, q] : pairs) {
      const int a = elements_[At(face.first)].parts[At(p)].copy,
                b = elements_[At(face.second)].parts[At(q)].copy;
      if (a < 0 || b < 0) continue;
      pieces.Join(a, b);
      const auto na = NodesOf(face.first), nb = NodesOf(face.second);
      for (std::size_t i = 0; i < face_nodes; ++i)
        for (std::size_t j = 0; j < face_nodes; ++j) {
          const int la = kTetFaces[At(face.first_face)][i], lb = kTetFaces[At(face.second_face)][j];
          if (na[At(la)] == nb[At(lb)])
            nodes.Join(a * static_cast<int>(per_element) + la,
                       b * static_cast<int>(per_element) + lb);
        }
    }
  }
  // Crumbs: pieces too small, or of which nothing lies in the true shape (flakes of the facets).
  std::vector<double> volume(copies.size(), 0.0);
  std::vector<unsigned char> is_real(copies.size(), 0), is_crumb(copies.size(), 0);
  const auto part_of = [&](int c) -> Part& {
    return elements_[At(copies[At(c)].element)].parts[At(copies[At(c)].part)];
  };
  for (int c = 0; c < static_cast<int>(copies.size()); ++c)
    volume[At(pieces.Find(c))] += part_of(c).volume;
  for (int c = 0; c < static_cast<int>(copies.size()); ++c) {
    const int root = pieces.Find(c);
    const Element& element = elements_[At(copies[At(c)].element)];
    if (is_real[At(root)] != 0) continue;
    if (element.label.empty()) {
      is_real[At(root)] = 1;  // an uncut element is not a flake
      continue;
    }
    for (std::size_t p = 0; p < element.label.size() && is_real[At(root)] == 0; ++p)
      if (element.label[p] == copies[At(c)].part)
        is_real[At(root)] =
            field.Distance(PlaceOf(copies[At(c)].element, static_cast<int>(p))) < 0.0;
  }
  CutMesh& cut = result_;
  const CutMesh old = std::exchange(result_, {});
  for (int c = 0; c < static_cast<int>(copies.size()); ++c) {
    if (pieces.Find(c) != c) continue;
    is_crumb[At(c)] = is_real[At(c)] == 0 || volume[At(c)] < options_.crumb_volume;
    cut.crumbs += is_crumb[At(c)];
    if (is_crumb[At(c)] != 0) cut.crumb_volume += volume[At(c)];
  }
  // Elements, in the whole mesh's order.
  std::vector<int> kept, piece_of(copies.size(), -1);
  for (int c = 0; c < static_cast<int>(copies.size()); ++c) {
    const int root = pieces.Find(c);
    Part& part = part_of(c);
    if (is_crumb[At(root)] != 0) {
      part.copy = -1;
      continue;
    }
    if (piece_of[At(root)] < 0) {
      piece_of[At(root)] = cut.piece_count();
      cut.piece_volume.push_back(0.0);
    }
    part.copy = static_cast<int>(kept.size());
    kept.push_back(c);
    cut.parent_element.push_back(copies[At(c)].element);
    cut.piece.push_back(piece_of[At(root)]);
    cut.piece_volume[At(piece_of[At(root)])] += part.volume;
    for (int q = 0; q < points; ++q) {
      cut.solid_share.push_back(part.share[At(q)]);
      cut.share.push_back(std::max(part.share[At(q)], options_.share_floor));
    }
  }
  for (int e = 0; e < static_cast<int>(elements_.size()); ++e)
    for (int q = 0; q < points; ++q) {
      double gone = 1.0;
      for (const Part& part : elements_[At(e)].parts)
        if (part.copy >= 0) gone -= part.share[At(q)];
      cut.removed_volume += gone * volume_[At(e * points + q)];
    }
  // Nodes, in the whole mesh's order; those of one place in the order of their first element.
  std::vector<int> copies_of_node(whole_.rest_positions.size() + 1, 0),
      number(copies.size() * per_element, -1);
  for (const int c : kept)
    for (std::size_t i = 0; i < per_element; ++i) {
      const int root = nodes.Find(c * static_cast<int>(per_element) + static_cast<int>(i));
      if (number[At(root)] >= 0) continue;
      const int parent = NodesOf(copies[At(c)].element)[i];
      number[At(root)] = copies_of_node[At(parent) + 1]++;
    }
  std::partial_sum(copies_of_node.begin(), copies_of_node.end(), copies_of_node.begin());
  const auto node_count = At(copies_of_node.back());
  cut.mesh.order = whole_.order;
  cut.mesh.rest_positions.resize(node_count);
  cut.parent_node.resize(node_count);
  cut.previous_node.assign(node_count, -1);
  cut.mesh.elements.reserve(kept.size() * per_element);
  for (const int c : kept) {
    const Element& now = elements_[At(copies[At(c)].element)];
    const int e = copies[At(c)].element, was_at = before_of_[At(e)];
    // The element of the old mesh that had this part in it.
    const Element& was = was_at >= 0 ? before_[At(was_at)] : now;
    const Part& part = part_of(c);
    int old_copy = -1;
    if (was.label.empty() && !was.parts.empty())
      old_copy = was.parts[0].previous_copy;
    else if (!was.label.empty() && was.label[At(part.seed)] != kNone)
      old_copy = was.parts[was.label[At(part.seed)]].previous_copy;
    for (std::size_t i = 0; i < per_element; ++i) {
      const int root = nodes.Find(c * static_cast<int>(per_element) + static_cast<int>(i));
      const int parent = NodesOf(e)[i];
      const auto node = At(copies_of_node[At(parent)] + number[At(root)]);
      cut.mesh.elements.push_back(static_cast<int>(node));
      cut.mesh.rest_positions[node] = whole_.rest_positions[At(parent)];
      cut.parent_node[node] = parent;
      if (cut.previous_node[node] < 0 && old_copy >= 0)
        cut.previous_node[node] = old.mesh.elements[At(old_copy) * per_element + i];
    }
  }
  // A node of tissue that was put back: where another one of that place was.
  for (std::size_t i = 0; i < node_count; ++i) {
    if (cut.previous_node[i] >= 0) continue;
    const auto same =
        std::lower_bound(old.parent_node.begin(), old.parent_node.end(), cut.parent_node[i]);
    if (same != old.parent_node.end() && *same == cut.parent_node[i])
      cut.previous_node[i] = static_cast<int>(same - old.parent_node.begin());
  }
  for (const auto& [name, flags] : whole_.sets) {
    auto& set = cut.mesh.sets[name];
    for (const int parent : cut.parent_node) set.push_back(flags[At(parent)]);
  }
  for (Element& element : elements_)
    for (Part& part : element.parts) part.previous_copy = part.copy;
  is_assembled_ = true;
  before_.clear();
  std::fill(before_of_.begin(), before_of_.end(), -1);
  return result_;
}

const CutMesh& MeshCutter::Update(const SolidField& field, const Box3& changed) {
  looked_at_ = 0;
  for (int e = 0; e < static_cast<int>(elements_.size()); ++e) {
    if (changed.empty() || !Meet(box_[At(e)], changed)) continue;
    ++looked_at_;
    before_of_[At(e)] = static_cast<int>(before_.size());
    before_.push_back(elements_[At(e)]);
    LookAt(field, e);
  }
  return Assemble(field);
}

const CutMesh& MeshCutter::Rebuild(const SolidField& field) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  return Update(field, {glm::dvec3(-kFar), glm::dvec3(kFar)});
}

// The part of element e that is left and nearest to a place in it, counted in lattice steps.
int MeshCutter::PartNear(int e, const glm::dvec4& barycentric) const {
  const Element& element = elements_[At(e)];
  if (element.label.empty()) return element.parts.empty() || element.parts[0].copy < 0 ? -1 : 0;
  const TetLattice& lattice = LatticeOf(e);
  std::vector<unsigned char> is_seen(lattice.point.size(), 0);
  std::vector<int> front{lattice.Nearest(barycentric)};
  is_seen[At(front[0])] = 1;
  for (std::size_t next = 0; next < front.size(); ++next) {
    const auto p = At(front[next]);
    const std::uint8_t label = element.label[p];
    if (label != kNone && element.parts[label].copy >= 0) return label;
    for (auto i = lattice.neighbour_begin[p]; i < lattice.neighbour_begin[p + 1]; ++i)
      if (const int q = lattice.neighbour[At(i)]; is_seen[At(q)] == 0) {
        is_seen[At(q)] = 1;
        front.push_back(q);
      }
  }
  return -1;
}

ElementCopy MeshCutter::FindCopy(int element, const glm::dvec3& rest) const {
  ElementCopy found;
  if (element < 0 || element >= static_cast<int>(elements_.size())) return found;
  int best = element, part = PartNear(element, PointIn(whole_, element, rest).barycentric);
  if (part < 0) {
    // Around it, ring by ring: the element with the nearest solid point.
    double nearest2 = std::numeric_limits<double>::max();
    std::vector<int> ring{element}, seen{element};
    for (int step = 0; step < 3 && part < 0 && !ring.empty(); ++step) {
      std::vector<int> next;
      for (const int e : ring)
        for (const int other : beside_[At(e)])
          if (other >= 0 && std::find(seen.begin(), seen.end(), other) == seen.end()) {
            seen.push_back(other);
            next.push_back(other);
          }
      for (const int e : next) {
        const Element& candidate = elements_[At(e)];
        for (int p = 0; p < static_cast<int>(LatticeOf(e).point.size()); ++p) {
          const int label = candidate.label.empty() ? 0 : candidate.label[At(p)];
          if (label == kNone || candidate.parts.empty() || candidate.parts[At(label)].copy < 0)
            continue;
          const glm::dvec3 way = PlaceOf(e, p) - rest;
          if (const double d2 = glm::dot(way, way); d2 < nearest2)
            nearest2 = d2, best = e, part = label;
        }
      }
      ring = std::move(next);
    }
  }
  if (part < 0) return found;
  found.element = elements_[At(best)].parts[At(part)].copy;
  found.weight = PointIn(whole_, best, rest).weight;
  return found;
}

CutMesh CutByField(const TetMesh& whole, const SolidField& field, const CutOptions& options) {
  MeshCutter cutter(whole, field.spacing(), options);
  return cutter.Rebuild(field);
}

}  // namespace arthro::simulation
