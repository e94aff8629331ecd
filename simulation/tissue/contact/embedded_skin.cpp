#include "simulation/tissue/contact/embedded_skin.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "simulation/core/error.h"
#include "simulation/scene/mesh/vertex_normals.h"
#include "simulation/tissue/contact/closest_points.h"
#include "simulation/tissue/fem/tet_shape.h"

namespace arthro::simulation {

namespace {

constexpr double kInside = 1e-7;    // relative to the mesh's size: rounding and Newton's remainder
constexpr double kArrived = 1e-12;  // change of a barycentric coordinate that ends Newton's method
constexpr int kMaxNewton = 12;      // quadratic from a straight element; curved ones take 4 to 6

constexpr std::array<std::array<int, 2>, 6> kEdges{
    {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}};

struct Linearised {
  glm::dvec3 at{0.0};                // position of the element at l
  std::array<glm::dvec3, 4> corner;  // tangent tetrahedron there
};

Linearised LineariseAt(int order, const std::array<glm::dvec3, 10>& x,
                       const glm::dvec4& l) noexcept {
  const TetShape shape = ShapeAt(order, l);
  const std::size_t count = order == 2 ? 10 : 4;
  Linearised result;
  std::array<glm::dvec3, 3> slope{};
  for (std::size_t n = 0; n < count; ++n) {
    result.at += shape.value[n] * x[n];
    for (std::size_t k = 0; k < 3; ++k) slope[k] += shape.slope[n][static_cast<int>(k)] * x[n];
  }
  result.corner[0] = result.at - l.y * slope[0] - l.z * slope[1] - l.w * slope[2];
  for (std::size_t k = 0; k < 3; ++k) result.corner[k + 1] = result.corner[0] + slope[k];
  return result;
}

glm::dmat3 Jacobian(const Linearised& linear) noexcept {
  const auto& corner = linear.corner;
  return {corner[1] - corner[0], corner[2] - corner[0], corner[3] - corner[0]};
}

}  // namespace

ElementFinder::ElementFinder(const TetMesh& mesh)
    : order_(mesh.order),
      nodes_per_element_(mesh.NodesPerElement()),
      elements_(mesh.elements),
      rest_(mesh.rest_positions),
      x_(mesh.rest_positions) {
  std::vector<Box3> boxes(static_cast<std::size_t>(mesh.ElementCount()));
  for (std::size_t i = 0; i < boxes.size(); ++i) boxes[i] = BoxOf(static_cast<int>(i), rest_);
  rest_tree_ = BoxTree(boxes);
  tree_ = rest_tree_;
  if (rest_tree_.empty()) return;
  const glm::dvec3 size = rest_tree_.box().high - rest_tree_.box().low;
  inside2_ = kInside * kInside * glm::dot(size, size);
}

std::span<const int> ElementFinder::NodesOf(int element) const noexcept {
  const auto count = static_cast<std::size_t>(nodes_per_element_);
  return std::span(elements_).subspan(static_cast<std::size_t>(element) * count, count);
}

std::array<glm::dvec3, 10> ElementFinder::PlacesOf(int element,
                                                   std::span<const glm::dvec3> x) const noexcept {
  std::array<glm::dvec3, 10> places{};
  std::size_t n = 0;
  for (const int node : NodesOf(element)) places[n++] = x[static_cast<std::size_t>(node)];
  return places;
}

// Returns the box of an element. A quadratic element lies within the hull of its Bézier points: the
// corners, and 2m − (a + b)/2 for each edge.
Box3 ElementFinder::BoxOf(int element, std::span<const glm::dvec3> x) const noexcept {
  const std::array<glm::dvec3, 10> place = PlacesOf(element, x);
  Box3 box{place[0], place[0]};
  const auto add = [&box](const glm::dvec3& p) noexcept {
    box = {glm::min(box.low, p), glm::max(box.high, p)};
  };
  for (std::size_t i = 1; i < 4; ++i) add(place[i]);
  if (order_ == 2)
    for (std::size_t e = 0; e < 6; ++e)
      add(2.0 * place[4 + e] - 0.5 * (place[static_cast<std::size_t>(kEdges[e][0])] +
                                      place[static_cast<std::size_t>(kEdges[e][1])]));
  return box;
}

// Newton's method on the tangent tetrahedron of the element at each iterate. The nearest point of
// that tetrahedron is exact, so the iterates stay within the element's bounds.
ElementFinder::Local ElementFinder::Nearest(int element, std::span<const glm::dvec3> x,
                                            const glm::dvec3& place) const noexcept {
  const std::array<glm::dvec3, 10> places = PlacesOf(element, x);
  Local best;
  best.distance2 = std::numeric_limits<double>::max();
  glm::dvec4 l = ClosestInTetrahedron({places[0], places[1], places[2], places[3]}, place);
  for (int i = 0; i < kMaxNewton; ++i) {
    const Linearised linear = LineariseAt(order_, places, l);
    const glm::dvec3 way = place - linear.at;
    const double distance2 = glm::dot(way, way);
    if (distance2 < best.distance2) best = {l, distance2};
    if (order_ == 1) break;
    const glm::dvec4 next = ClosestInTetrahedron(linear.corner, place);
    const glm::dvec4 change = glm::abs(next - l);
    l = next;
    if (!(std::max({change.x, change.y, change.z, change.w}) > kArrived)) break;
  }
  return best;
}

EmbeddedPoint ElementFinder::PointAt(int element, const Local& local,
                                     const glm::dvec3& rest) const noexcept {
  const TetShape shape = ShapeAt(order_, local.l);
  EmbeddedPoint point{element, shape.value};
  // Extrapolates the rest of the path linearly from the nearest point.
  const Linearised linear = LineariseAt(order_, PlacesOf(element, rest_), local.l);
  const glm::dvec3 way = rest - linear.at;
  const glm::dmat3 jacobian = Jacobian(linear);
  const double det = glm::determinant(jacobian);
  if (glm::dot(way, way) == 0.0 || !(std::abs(det) > 0.0)) return point;
  const glm::dvec3 change = glm::inverse(jacobian) * way;
  for (std::size_t n = 0; n < static_cast<std::size_t>(nodes_per_element_); ++n)
    point.weight[n] += glm::dot(shape.slope[n], change);
  return point;
}

int ElementFinder::CommonNodes(int element, std::span<const int> beside) const noexcept {
  int common = 0;
  for (const int node : NodesOf(element))
    for (const int other : beside)
      common += static_cast<int>(std::ranges::count(NodesOf(other), node));
  return common;
}

EmbeddedPoint ElementFinder::Find(const glm::dvec3& rest) const noexcept {
  return FindBeside(rest, {});
}

EmbeddedPoint ElementFinder::FindBeside(const glm::dvec3& rest,
                                        std::span<const int> beside) const noexcept {
  double limit2 = std::numeric_limits<double>::max();
  int element = -1, common = -1;
  Local nearest;
  rest_tree_.ForNear(rest, limit2, [&](int i) noexcept {
    const Local local = Nearest(i, rest_, rest);
    // All elements that contain the point are equal; outside, nearer is better.
    const double distance2 = local.distance2 <= inside2_ ? 0.0 : local.distance2;
    if (distance2 > limit2) return;
    const int shared = CommonNodes(i, beside);
    const bool is_better =
        distance2 < limit2 || shared > common || (shared == common && i < element);
    if (!is_better) return;
    element = i;
    common = shared;
    nearest = local;
    limit2 = distance2;
  });
  if (element < 0) return {};
  return PointAt(element, nearest, rest);
}

EmbeddedPoint ElementFinder::FindAmong(const glm::dvec3& rest,
                                       std::span<const int> elements) const noexcept {
  double least2 = std::numeric_limits<double>::max();
  int element = -1;
  Local nearest;
  for (const int i : elements) {
    if (i == element) continue;
    const Local local = Nearest(i, rest_, rest);
    if (!(local.distance2 < least2)) continue;
    element = i;
    nearest = local;
    least2 = local.distance2;
    if (least2 <= inside2_) break;
  }
  return element < 0 ? EmbeddedPoint{} : PointAt(element, nearest, rest);
}

void ElementFinder::Refit(std::span<const glm::dvec3> x) noexcept {
  std::copy_n(x.begin(), std::min(x.size(), x_.size()), x_.begin());
  tree_.Refit([this](int i) noexcept { return BoxOf(i, x_); });
}

bool ElementFinder::FindDeformed(const glm::dvec3& place, int& element,
                                 Local& local) const noexcept {
  element = -1;
  double limit2 = 0.0;  // only boxes that contain the place
  tree_.ForNear(place, limit2, [&](int i) noexcept {
    if (Distance2(BoxOf(i, x_), place) > 0.0) return;
    local = Nearest(i, x_, place);
    if (!(local.distance2 <= inside2_)) return;
    element = i;
    limit2 = -1.0;
  });
  return element >= 0;
}

bool ElementFinder::FindDeformed(const glm::dvec3& place, EmbeddedPoint& point,
                                 glm::dvec3& rest) const noexcept {
  int element = -1;
  Local local;
  if (!FindDeformed(place, element, local)) return false;
  point = {element, ShapeAt(order_, local.l).value};
  rest = PlaceOf(point, NodesOf(element), rest_);
  return true;
}

bool ElementFinder::FindDeformed(const glm::dvec3& place, EmbeddedPoint& point, glm::dvec3& rest,
                                 glm::dmat3& gradient) const noexcept {
  int element = -1;
  Local local;
  if (!FindDeformed(place, element, local)) return false;
  point = {element, ShapeAt(order_, local.l).value};
  rest = PlaceOf(point, NodesOf(element), rest_);
  const glm::dmat3 before = Jacobian(LineariseAt(order_, PlacesOf(element, rest_), local.l));
  const glm::dmat3 now = Jacobian(LineariseAt(order_, PlacesOf(element, x_), local.l));
  gradient =
      std::abs(glm::determinant(before)) > 0.0 ? now * glm::inverse(before) : glm::dmat3(1.0);
  return true;
}

glm::dvec3 ElementFinder::PlaceNow(const EmbeddedPoint& point) const noexcept {
  return PlaceOf(point, NodesOf(point.element), x_);
}

glm::dvec3 PlaceOf(const EmbeddedPoint& point, std::span<const int> nodes,
                   std::span<const glm::dvec3> x) noexcept {
  glm::dvec3 place(0.0);
  for (std::size_t n = 0; n < nodes.size(); ++n)
    place += point.weight[n] * x[static_cast<std::size_t>(nodes[n])];
  return place;
}

EmbeddedSkin EmbedSkin(SurfaceMesh surface, const TetMesh& mesh, const ElementFinder& finder) {
  if (mesh.ElementCount() == 0)
    throw Error(Code::kBadMesh,
                "a tetrahedral mesh without elements cannot carry a skin; make the mesh again with "
                "`arthroscene tetrahedralize`");
  EmbeddedSkin skin;
  skin.point.reserve(surface.vertices.size());
  for (const glm::dvec3& vertex : surface.vertices) skin.point.push_back(finder.Find(vertex));
  skin.rest = std::move(surface);
  return skin;
}

namespace {

// A compile-time count lets the compiler unroll the sum over nodes.
template <std::size_t kNodes>
void Place(const EmbeddedSkin& skin, const TetMesh& mesh, std::span<const glm::dvec3> x,
           std::span<glm::dvec3> positions) noexcept {
  for (std::size_t v = 0; v < skin.point.size(); ++v) {
    const EmbeddedPoint& point = skin.point[v];
    const int* node = &mesh.elements[static_cast<std::size_t>(point.element) * kNodes];
    glm::dvec3 place(0.0);
    for (std::size_t n = 0; n < kNodes; ++n)
      place += point.weight[n] * x[static_cast<std::size_t>(node[n])];
    positions[v] = place;
  }
}

}  // namespace

void DeformSkin(const EmbeddedSkin& skin, const TetMesh& mesh, std::span<const glm::dvec3> x,
                std::span<glm::dvec3> positions, std::span<glm::dvec3> normals) noexcept {
  if (mesh.order == 2) {
    Place<10>(skin, mesh, x, positions);
  } else {
    Place<4>(skin, mesh, x, positions);
  }
  ComputeVertexNormals(positions, skin.rest.triangles, normals);
}

}  // namespace arthro::simulation
