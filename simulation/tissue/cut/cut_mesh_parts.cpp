// Parts of an element's solid, and contact between parts of neighbouring elements.
#include <algorithm>
#include <array>
#include <cstddef>

#include "simulation/core/at.h"
#include "simulation/tissue/cut/cut_mesh.h"
#include "simulation/tissue/fem/tet_shape.h"

namespace arthro::simulation {
glm::dvec3 MeshCutter::PlaceOf(int e, int point) const {
  const auto nodes = NodesOf(e);
  const auto& value = shape_[level_[At(e)]][At(point)];
  glm::dvec3 x(0.0);
  for (std::size_t i = 0; i < nodes.size(); ++i)
    x += value[i] * whole_.rest_positions[At(nodes[i])];
  return x;
}

// Computes all lattice points of an element; along a row of points the map is a parabola.
void MeshCutter::PlacesIn(int e, std::span<glm::dvec3> places) const {
  const TetLattice& lattice = Lattice(e);
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

// Finds what is left of element e and its parts.
void MeshCutter::UpdateElement(const SolidField& field, int e) {
  Element& element = elements_[At(e)];
  const TetLattice& lattice = Lattice(e);
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
  // Forms parts of solid neighbours that are also connected in the field's grid.
  element.parts.clear();
  element.label.assign(count, kNoPart);
  auto& front = front_;
  for (std::size_t p = 0; p < count; ++p) {
    if (values_[p] > 0.0 || element.label[p] != kNoPart || element.parts.size() == kNoPart)
      continue;
    const auto label = static_cast<std::uint8_t>(element.parts.size());
    element.parts.emplace_back().seed = static_cast<int>(p);
    element.label[p] = label;
    front.assign(1, static_cast<std::int16_t>(p));
    while (!front.empty()) {
      const auto q = static_cast<std::size_t>(front.back());
      front.pop_back();
      for (auto i = lattice.neighbour_begin[q]; i < lattice.neighbour_begin[q + 1]; ++i) {
        const auto other = At(lattice.neighbour[At(i)]);
        if (values_[other] > 0.0 || element.label[other] != kNoPart) continue;
        if (!field.AreJoined(grid_node_[q], grid_node_[other])) continue;
        element.label[other] = label;
        front.push_back(lattice.neighbour[At(i)]);
      }
    }
  }
  // The solid corners of a lattice part are all neighbours, hence of one part except at a hinge.
  const bool has_one_point = whole_.order == 1;
  const std::uint8_t* labels = element.label.data();
  for (const TetLattice::Cell& cell : lattice.cell) {
    const std::uint8_t first = labels[cell.corner[0]];
    bool is_even = true;
    for (const std::int16_t corner : cell.corner) is_even &= labels[corner] == first;
    if (is_even) {
      if (first == kNoPart) continue;
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
      std::uint8_t label = kNoPart;
      for (std::size_t c = 0; c < 4; ++c) {
        value[c] = values_[At(corner[c])];
        label = std::min(label, labels[corner[c]]);
      }
      if (label == kNoPart) continue;
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

// Finds the parts of the two elements that touch through their common face: on at least one
// triangle of the coarser lattice all three points are solid in both.
void MeshCutter::Touch(const Face& face, std::vector<std::array<int, 2>>& pairs) const {
  pairs.clear();
  const Element &a = elements_[At(face.first)], &b = elements_[At(face.second)];
  if (a.parts.empty() || b.parts.empty()) return;
  if (a.label.empty() && b.label.empty()) {
    pairs.push_back({0, 0});
    return;
  }
  const TetLattice &la = Lattice(face.first), &lb = Lattice(face.second);
  const int n = std::min(la.n, lb.n);
  // Corners of the face in node order, in each element's own numbering.
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
          is_solid = in_a[c] != kNoPart && in_b[c] != kNoPart;
        }
        if (is_solid)
          for (std::size_t c = 0; c < 3; ++c) keep(in_a[c], in_b[c]);
      }
}

}  // namespace arthro::simulation
