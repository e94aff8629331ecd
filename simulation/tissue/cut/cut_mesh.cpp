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

#include "simulation/core/at.h"
#include "simulation/core/error.h"
#include "simulation/tissue/fem/tet_shape.h"

namespace arthro::simulation {
namespace {

constexpr std::array<int, 4> kLevels{2, 4, 8, 16};
constexpr std::array<std::array<std::size_t, 2>, 6> kEdges{
    {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}};

bool Meet(const Box3& a, const Box3& b) {
  for (int i = 0; i < 3; ++i)
    if (!(a.low[i] <= b.high[i] && b.low[i] <= a.high[i])) return false;
  return true;
}

std::vector<TetLattice> AllLattices() {
  std::vector<TetLattice> lattices;
  lattices.reserve(std::size(kLevels));
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
  const auto& quadrature = QuadraturePoints(order);
  for (int e = 0; e < count; ++e) {
    const auto nodes = NodesOf(e);
    const auto x = [&](std::size_t i) { return whole_.rest_positions[At(nodes[i])]; };
    Box3 box{x(0), x(0)};
    for (std::size_t i = 1; i < nodes.size(); ++i) {
      box.low = glm::min(box.low, x(i));
      box.high = glm::max(box.high, x(i));
    }
    // A curved face may bulge beyond its nodes.
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

const CutMesh& MeshCutter::Update(const SolidField& field, const Box3& changed) {
  elements_tested_ = 0;
  for (int e = 0; e < static_cast<int>(elements_.size()); ++e) {
    if (changed.empty() || !Meet(box_[At(e)], changed)) continue;
    ++elements_tested_;
    before_of_[At(e)] = static_cast<int>(before_.size());
    before_.push_back(elements_[At(e)]);
    UpdateElement(field, e);
  }
  return Assemble(field);
}

const CutMesh& MeshCutter::Rebuild(const SolidField& field) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  return Update(field, {glm::dvec3(-kFar), glm::dvec3(kFar)});
}

// Returns the remaining part of element e nearest to a place in it, measured in lattice steps.
int MeshCutter::PartNear(int e, const glm::dvec4& barycentric) const {
  const Element& element = elements_[At(e)];
  if (element.label.empty()) return element.parts.empty() || element.parts[0].copy < 0 ? -1 : 0;
  // A single remaining part is the nearest from anywhere; a place inside a remaining part belongs
  // to that part.
  int left = -1, count = 0;
  for (std::size_t p = 0; p < element.parts.size(); ++p)
    if (element.parts[p].copy >= 0) left = static_cast<int>(p), ++count;
  if (count <= 1) return left;
  const TetLattice& lattice = Lattice(e);
  const int nearest = lattice.Nearest(barycentric);
  if (const std::uint8_t label = element.label[At(nearest)];
      label != kNoPart && element.parts[label].copy >= 0)
    return label;
  std::vector<unsigned char> is_seen(lattice.point.size(), 0);
  std::vector<int> front{nearest};
  is_seen[At(front[0])] = 1;
  for (std::size_t next = 0; next < front.size(); ++next) {
    const auto p = At(front[next]);
    const std::uint8_t label = element.label[p];
    if (label != kNoPart && element.parts[label].copy >= 0) return label;
    for (auto i = lattice.neighbour_begin[p]; i < lattice.neighbour_begin[p + 1]; ++i)
      if (const int q = lattice.neighbour[At(i)]; is_seen[At(q)] == 0) {
        is_seen[At(q)] = 1;
        front.push_back(q);
      }
  }
  return -1;
}

ElementCopy MeshCutter::FindCopy(int element, const glm::dvec3& rest) const {
  if (element < 0 || element >= static_cast<int>(elements_.size())) return {};
  return FindCopy(element, rest, PointIn(whole_, element, rest));
}

ElementCopy MeshCutter::FindCopy(int element, const glm::dvec3& rest,
                                 const ElementPoint& own) const {
  ElementCopy found;
  int best = element, part = PartNear(element, own.barycentric);
  if (part < 0) {
    // Searches ring by ring around the element for the nearest solid point.
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
        for (int p = 0; p < static_cast<int>(Lattice(e).point.size()); ++p) {
          const int label = candidate.label.empty() ? 0 : candidate.label[At(p)];
          if (label == kNoPart || candidate.parts.empty() || candidate.parts[At(label)].copy < 0)
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
  found.weight = best == element ? own.weight : PointIn(whole_, best, rest).weight;
  return found;
}

CutMesh CutByField(const TetMesh& whole, const SolidField& field, const CutOptions& options) {
  MeshCutter cutter(whole, field.spacing(), options);
  return cutter.Rebuild(field);
}

}  // namespace arthro::simulation
