#include "simulation/tissue/fem/fem_model.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "simulation/core/error.h"
#include "simulation/tissue/fem/element_kernel.h"
#include "simulation/tissue/fem/tet_shape.h"

namespace arthro::simulation {
namespace {

// Fraction of the mass that a node keeps when all its elements are empty, so that division by the
// mass stays possible.
constexpr double kLeastMassShare = 1e-12;
// Volume divided by the cube of the longest edge; below this limit an element is flat up to
// rounding.
constexpr double kNoVolume = 1e-15;

void CheckMaterial(const Material& m) {
  const auto refuse = [](const char* what, double value, const char* rule) {
    throw Error(Code::kBadArgument,
                fmt::format("tissue material: {} is {}, but must be {}", what, value, rule));
  };
  if (!(std::isfinite(m.young_modulus) && m.young_modulus > 0))
    refuse("Young's modulus", m.young_modulus, "a finite number of pascals above 0");
  if (!(m.poisson_ratio > -1 && m.poisson_ratio < 0.5))
    refuse("Poisson's ratio", m.poisson_ratio, "above -1 and below 0.5");
  if (!(std::isfinite(m.density) && m.density > 0))
    refuse("density", m.density, "a finite number of kg/m3 above 0");
  if (!(std::isfinite(m.fibre_stiffness) && m.fibre_stiffness >= 0))
    refuse("fibre stiffness", m.fibre_stiffness, "a finite number of pascals, 0 or more");
}

bool HasFibres(const Material& m) {
  return m.fibre_axis != FibreAxis::kNone && m.fibre_stiffness > 0;
}

void CheckShares(std::span<const double> share, std::size_t count) {
  if (share.size() != count)
    throw Error(Code::kBadArgument,
                fmt::format("there are {} shares for {} quadrature points; give one each",
                            share.size(), count));
  for (std::size_t i = 0; i < count; ++i)
    if (!(share[i] >= 0 && share[i] <= 1))
      throw Error(Code::kBadArgument,
                  fmt::format("the share of quadrature point {} is {}, but must be from 0 to 1", i,
                              share[i]));
}

void CheckMesh(const TetMesh& mesh) {
  const int n = mesh.NodesPerElement(), count = static_cast<int>(mesh.rest_positions.size());
  if (mesh.order != 1 && mesh.order != 2)
    throw Error(Code::kBadMesh,
                fmt::format("elements of order {}; only 1 and 2 are known", mesh.order));
  if (mesh.elements.empty() || mesh.elements.size() % n != 0)
    throw Error(Code::kBadMesh,
                fmt::format("{} node numbers do not make elements of {} nodes; make the mesh again",
                            mesh.elements.size(), n));
  for (std::size_t i = 0; i < mesh.elements.size(); ++i)
    if (mesh.elements[i] < 0 || mesh.elements[i] >= count)
      throw Error(Code::kBadMesh,
                  fmt::format("element {} names node {}, but there are only {} nodes", i / n,
                              mesh.elements[i], count));
}

// ∂N_a/∂x at a quadrature point, its rest position, and the determinant of the Jacobian.
struct RestPoint {
  std::array<glm::dvec3, 10> gradient;
  glm::dvec3 x{0.0};
  double det = 0;
};
RestPoint RestPointOf(const TetMesh& mesh, const int* node, const TetShape& shape) {
  RestPoint point;
  glm::dmat3 jacobian(0.0);  // column l: ∂x/∂L_l
  for (int a = 0; a < mesh.NodesPerElement(); ++a) {
    const glm::dvec3& at = mesh.rest_positions[node[a]];
    point.x += shape.value[a] * at;
    for (int l = 0; l < 3; ++l) jacobian[l] += shape.slope[a][l] * at;
  }
  point.det = glm::dot(glm::cross(jacobian[0], jacobian[1]), jacobian[2]);
  // Rows of the inverse.
  const glm::dvec3 r0 = glm::cross(jacobian[1], jacobian[2]) / point.det,
                   r1 = glm::cross(jacobian[2], jacobian[0]) / point.det,
                   r2 = glm::cross(jacobian[0], jacobian[1]) / point.det;
  for (int a = 0; a < mesh.NodesPerElement(); ++a)
    point.gradient[a] = shape.slope[a].x * r0 + shape.slope[a].y * r1 + shape.slope[a].z * r2;
  return point;
}

double LongestEdge(const TetMesh& mesh, const int* node) {
  double longest = 0;
  for (int a = 0; a < 4; ++a)
    for (int b = a + 1; b < 4; ++b)
      longest = std::max(longest,
                         glm::distance(mesh.rest_positions[node[a]], mesh.rest_positions[node[b]]));
  return longest;
}

glm::dvec3 Circumferential(const glm::dvec3& x) {
  const double radius = std::hypot(x.x, x.y);
  return radius > 0 ? glm::dvec3(-x.y, x.x, 0) / radius : glm::dvec3(0, 1, 0);
}

// Fraction of the element's mass, from the scaled diagonal of the consistent matrix [Hinton, Rock &
// Zienkiewicz 1976]. The four-point rule is too low for N², so its sums are scaled to the exact
// ones of a straight element. The unscaled values still tell which node a point is nearest to.
double LumpShare(int order, const TetShape& shape, int a) {
  if (order == 1) return 0.25;
  constexpr double kCorner = 1.0 / 70, kMiddle = 8.0 / 105;  // ∫N²dV / V
  if (a < 4) return kCorner;
  double sum = 0;
  for (const TetShape& point : QuadraturePoints(2))
    sum += point.weight * point.value[a] * point.value[a];
  return kMiddle * shape.value[a] * shape.value[a] / sum;
}

}  // namespace

FemModel::FemModel(const TetMesh& mesh, const Material& material, std::span<const double> share)
    : mesh_(mesh), material_(material) {
  CheckMaterial(material_);
  CheckMesh(mesh_);
  const int n = mesh_.NodesPerElement(), count = mesh_.ElementCount();
  const auto& quadrature = QuadraturePoints(mesh_.order);
  const int points = static_cast<int>(quadrature.size());
  auto pattern = std::make_shared<BlockPattern>(MakePattern(mesh_.elements, n, node_count()));

  ElementBatches& b = batches_;
  b.nodes = n;
  b.points = points;
  b.elements = count;
  b.batches = (count + kLanes - 1) / kLanes;
  const std::size_t batches = b.batches;
  b.node.resize(batches * n);
  b.block.resize(batches * b.pairs());
  b.gradient.resize(batches * points * n * 3);
  b.weight.assign(batches * points, Lanes{});
  if (HasFibres(material_)) b.fibre.resize(batches * points * 3);
  whole_volume_.resize(static_cast<std::size_t>(count) * points);

  for (int slot = 0; slot < b.batches * kLanes; ++slot) {
    const int element = std::min(slot, count - 1), batch = slot / kLanes, lane = slot % kLanes;
    const int* node = &mesh_.elements[static_cast<std::size_t>(element) * n];
    std::array<int, 10> order;
    for (int a = 0; a < n; ++a) order[a] = a;
    std::sort(order.begin(), order.begin() + n, [&](int i, int j) { return node[i] < node[j]; });
    for (int a = 0; a < n; ++a) b.node[batch * n + a][lane] = node[order[a]];
    for (int a = 0, pair = batch * b.pairs(); a < n; ++a)
      for (int c = a; c < n; ++c)
        b.block[pair++][lane] = pattern->Find(node[order[a]], node[order[c]]);
    const double edge = LongestEdge(mesh_, node);
    for (int q = 0; q < points; ++q) {
      const RestPoint rest = RestPointOf(mesh_, node, quadrature[q]);
      if (!(rest.det > kNoVolume * edge * edge * edge))
        throw Error(Code::kBadMesh,
                    fmt::format("element {} has no volume at its quadrature point {} (Jacobian {} "
                                "m3); make the mesh again",
                                element, q, rest.det));
      const std::size_t at = static_cast<std::size_t>(batch) * points + q;
      for (int a = 0; a < n; ++a)
        for (int k = 0; k < 3; ++k)
          b.gradient[(at * n + a) * 3 + k].v[lane] = rest.gradient[order[a]][k];
      const glm::dvec3 along = Circumferential(rest.x);
      if (!b.fibre.empty())
        for (int k = 0; k < 3; ++k) b.fibre[at * 3 + k].v[lane] = along[k];
      whole_volume_[static_cast<std::size_t>(element) * points + q] =
          quadrature[q].weight * rest.det / 6.0;
    }
  }

  mirror_.resize(pattern->column.size());
  for (int row = 0; row < node_count(); ++row)
    for (int e = pattern->row_begin[row]; e < pattern->row_begin[row + 1]; ++e)
      mirror_[e] = pattern->Find(pattern->column[e], row);
  pattern_ = std::move(pattern);
  SetShares(share.empty() ? std::vector<double>(whole_volume_.size(), 1.0)
                          : std::vector<double>(share.begin(), share.end()));
}

void FemModel::SetShares(std::span<const double> share) {
  CheckShares(share, whole_volume_.size());
  share_.assign(share.begin(), share.end());
  const int n = mesh_.NodesPerElement(), points = points_per_element();
  const auto& quadrature = QuadraturePoints(mesh_.order);
  mass_.assign(node_count(), 0.0);
  volume_ = 0;
  std::vector<double> whole(node_count(), 0.0);
  for (int element = 0; element < mesh_.ElementCount(); ++element) {
    const int* node = &mesh_.elements[static_cast<std::size_t>(element) * n];
    std::array<double, 10> part{};
    double sum = 0, all = 0, kept = 0;
    for (int q = 0; q < points; ++q) {
      const std::size_t at = static_cast<std::size_t>(element) * points + q;
      const double volume = whole_volume_[at] * share_[at];
      batches_.weight[static_cast<std::size_t>(element / kLanes) * points + q].v[element % kLanes] =
          volume;
      all += whole_volume_[at];
      kept += volume;
      for (int a = 0; a < n; ++a) {
        const double lump = volume * LumpShare(mesh_.order, quadrature[q], a);
        part[a] += lump;
        sum += lump;
      }
    }
    volume_ += kept;
    for (int a = 0; a < n; ++a) {
      if (sum > 0) mass_[node[a]] += material_.density * kept * part[a] / sum;
      whole[node[a]] += material_.density * all / n;
    }
  }
  for (int i = 0; i < node_count(); ++i)
    mass_[i] = std::max(mass_[i],
                        std::max(kLeastMassShare * whole[i], std::numeric_limits<double>::min()));
}

Assembly FemModel::Assemble(std::span<const glm::dvec3> x, Law law, Tangent tangent,
                            std::span<glm::dvec3> force, BlockMatrix* stiffness,
                            const ElementKernel* kernel) const noexcept {
  if (kernel == nullptr) kernel = &BestKernel();
  if (stiffness == nullptr) tangent = Tangent::kNone;
  std::fill(force.begin(), force.end(), glm::dvec3(0.0));
  if (tangent != Tangent::kNone)
    for (int row = 0; row < node_count(); ++row)  // only the upper triangle, which the kernel fills
      std::fill(stiffness->block.begin() + pattern_->diagonal[row],
                stiffness->block.begin() + pattern_->row_begin[row + 1], std::array<double, 9>{});
  const Lame lame = LameOf(material_);
  const Assembly result = kernel->assemble(
      {&batches_,
       {lame.mu, lame.lambda, material_.fibre_stiffness, material_.fibres_bear_compression},
       law,
       tangent,
       x.data(),
       force.data(),
       tangent == Tangent::kNone ? nullptr : stiffness->block.data()});
  if (tangent != Tangent::kNone) kernel->mirror(*pattern_, mirror_.data(), stiffness->block.data());
  return result;
}

void FemModel::NodeRotations(std::span<const glm::dvec3> x, std::span<glm::dmat3> rotation,
                             const ElementKernel* kernel) const noexcept {
  if (kernel == nullptr) kernel = &BestKernel();
  std::fill(rotation.begin(), rotation.end(), glm::dmat3(0.0));
  kernel->add_gradients(batches_, x.data(), rotation.data());
  kernel->rotations(rotation);
}

std::vector<double> FemModel::NodeShares() const {
  std::vector<double> left(mass_.size(), 0.0), whole(mass_.size(), 0.0);
  const std::size_t points = points_per_element(), nodes = mesh_.NodesPerElement();
  for (std::size_t at = 0; at < whole_volume_.size(); ++at)
    for (std::size_t a = 0; a < nodes; ++a) {
      const int node = mesh_.elements[at / points * nodes + a];
      left[node] += whole_volume_[at] * share_[at];
      whole[node] += whole_volume_[at];
    }
  for (std::size_t i = 0; i < left.size(); ++i) left[i] = whole[i] > 0 ? left[i] / whole[i] : 0.0;
  return left;
}

void FemModel::AddBodyForce(const glm::dvec3& per_volume, std::span<glm::dvec3> force) const {
  const int n = mesh_.NodesPerElement(), points = points_per_element();
  const auto& quadrature = QuadraturePoints(mesh_.order);
  for (std::size_t at = 0; at < whole_volume_.size(); ++at) {
    const int* node = &mesh_.elements[at / points * n];
    for (int a = 0; a < n; ++a)
      force[node[a]] +=
          whole_volume_[at] * share_[at] * quadrature[at % points].value[a] * per_volume;
  }
}

}  // namespace arthro::simulation
