#include "simulation/tissue/field/carved_skin.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "simulation/scene/mesh/vertex_normals.h"
#include "simulation/tissue/field/grid_cell.h"

namespace arthro::simulation {
namespace {

// Lengths in spacings of the field.
constexpr double kOverhang = 0.05;    // surface beyond a cut
constexpr double kThrough = 0.1;      // face of a cut beyond the surface
constexpr double kLongestEdge = 1.1;  // edge of a triangle that a cut meets
constexpr double kExact = 1.0;        // distance within which that of the surface is exact

// Cosine between the normals of a vertex and its triangles from which the surface is smooth there.
constexpr double kSmooth = 0.9;
constexpr int kRefinements = 2;  // steps towards the place where an edge meets a cut
constexpr int kMostDivisions = 24;
constexpr int kBeside = 2;  // nodes

// Removed volume of a field, node by node. Empty nodes within kBeside nodes of removed ones count
// as removed unless tissue is left beside them: no tool reached them where debris washed away.
class RemovedVolume {
 public:
  explicit RemovedVolume(const SolidField& field)
      : grid_(field.grid()), value_(field.cut_values().begin(), field.cut_values().end()) {
    if (value_.empty()) return;
    FindNodes();
    SumNodes();
    TakeSpaceBeside(field.values());
  }
  bool empty() const { return value_.empty(); }
  std::span<const float> values() const { return value_; }
  // Returns a distance-like value: positive in the removed volume.
  double At(const glm::dvec3& x) const {
    const CellPlace place = Locate(grid_, x);
    return Interpolate(CornersAt(value_, grid_, place.index), place.part);
  }
  // Returns whether a node in the box, or at its cells' corners, was removed.
  bool Meets(const glm::dvec3& low, const glm::dvec3& high) const {
    if (glm::any(glm::lessThan(high, box_.low)) || glm::any(glm::lessThan(box_.high, low)))
      return false;
    std::array<int, 3> first, last;  // nodes from the first removed one on; the last is left out
    for (int a = 0; a < 3; ++a) {
      const auto i = static_cast<std::size_t>(a);
      const double end = grid_.count[i] - 1;
      const auto node = [&](double x) {
        return std::clamp((x - grid_.origin[a]) / grid_.spacing, 0.0, end);
      };
      const auto from_first = [&](int n) { return std::clamp(n - first_[i], 0, size_[i]); };
      first[i] = from_first(static_cast<int>(std::floor(node(low[a]))));
      last[i] = from_first(static_cast<int>(std::ceil(node(high[a]))) + 1);
    }
    int sum = 0;
    for (int corner = 0; corner < 8; ++corner) {
      const auto at = [&](std::size_t a) { return (corner >> a & 1) != 0 ? last[a] : first[a]; };
      const int sign = (corner == 7 || corner == 1 || corner == 2 || corner == 4) ? 1 : -1;
      sum += sign * sum_[SumIndex(at(0), at(1), at(2))];
    }
    return sum > 0;
  }

 private:
  void TakeSpaceBeside(std::span<const float> now) {
    const auto nx = static_cast<std::size_t>(grid_.count[0]),
               layer = nx * static_cast<std::size_t>(grid_.count[1]);
    // Offsets of the 26 neighbours, as unsigned differences.
    std::vector<std::size_t> around;
    for (const std::size_t c : {std::size_t{0} - layer, std::size_t{0}, layer})
      for (const std::size_t b : {std::size_t{0} - nx, std::size_t{0}, nx})
        for (const std::size_t a : {std::size_t{0} - 1, std::size_t{0}, std::size_t{1}})
          if (a + b + c != 0) around.push_back(a + b + c);
    const auto is_removed = [](float value) { return value > 0; };
    const auto first =
        static_cast<std::size_t>(std::ranges::find_if(value_, is_removed) - value_.begin());
    std::vector<std::size_t> front, next;
    for (std::size_t node = first; node < value_.size(); ++node)
      if (is_removed(value_[node])) front.push_back(node);
    for (int step = 0; step < kBeside; ++step, front = std::move(next), next.clear())
      for (const std::size_t node : front)
        for (const std::size_t way : around) {
          const std::size_t other = node + way;
          if (other >= value_.size() || is_removed(value_[other]) || now[other] < 0) continue;
          const bool is_kept = std::ranges::any_of(around, [&](std::size_t on) {
            return other + on < now.size() && now[other + on] < 0;
          });
          if (is_kept) continue;
          value_[other] = static_cast<float>(0.5 * grid_.spacing);
          next.push_back(other);
        }
  }
  std::size_t SumIndex(int i, int j, int k) const {
    const auto nx = static_cast<std::size_t>(size_[0]) + 1,
               ny = static_cast<std::size_t>(size_[1]) + 1;
    return (static_cast<std::size_t>(k) * ny + static_cast<std::size_t>(j)) * nx +
           static_cast<std::size_t>(i);
  }
  // Finds the box of the removed nodes.
  void FindNodes() {
    const auto& n = grid_.count;
    std::array<int, 3> last{-1, -1, -1};
    first_ = n;
    for (int k = 0; k < n[2]; ++k)
      for (int j = 0; j < n[1]; ++j) {
        const float* row = &value_[grid_.Index(0, j, k)];
        int low = 0, high = n[0] - 1;
        while (low < n[0] && !(row[low] > 0)) ++low;
        if (low == n[0]) continue;
        while (!(row[high] > 0)) --high;
        first_ = {std::min(first_[0], low), std::min(first_[1], j), std::min(first_[2], k)};
        last = {std::max(last[0], high), std::max(last[1], j), std::max(last[2], k)};
      }
    size_ = {std::max(0, last[0] - first_[0] + 1), std::max(0, last[1] - first_[1] + 1),
             std::max(0, last[2] - first_[2] + 1)};
    if (size_[0] == 0) return;
    box_ = {grid_.Place(first_[0], first_[1], first_[2]) - grid_.spacing,
            grid_.Place(last[0], last[1], last[2]) + grid_.spacing};
  }
  // Sums over the boxes from the first removed node, so that a box is tested at its eight corners.
  void SumNodes() {
    sum_.assign(static_cast<std::size_t>(size_[0] + 1) * static_cast<std::size_t>(size_[1] + 1) *
                    static_cast<std::size_t>(size_[2] + 1),
                0);
    for (int k = 0; k < size_[2]; ++k)
      for (int j = 0; j < size_[1]; ++j) {
        int row = 0;
        for (int i = 0; i < size_[0]; ++i) {
          row += value_[grid_.Index(first_[0] + i, first_[1] + j, first_[2] + k)] > 0;
          sum_[SumIndex(i + 1, j + 1, k + 1)] = row + sum_[SumIndex(i + 1, j, k + 1)] +
                                                sum_[SumIndex(i + 1, j + 1, k)] -
                                                sum_[SumIndex(i + 1, j, k)];
        }
      }
  }

  const FieldGrid& grid_;
  std::vector<float> value_;
  std::array<int, 3> first_{}, size_{};  // box of the removed nodes
  std::vector<int> sum_;
  Box3 box_ = kEmptyBox;  // holds every removed node and the cells around it
};

using Edge = std::pair<int, int>;
Edge Between(int a, int b) { return {std::min(a, b), std::max(a, b)}; }
struct EdgeHash {
  std::size_t operator()(const Edge& edge) const {
    return (static_cast<std::uint64_t>(edge.first) << 32 |
            static_cast<std::uint64_t>(edge.second)) *
               0x9e3779b97f4a7c15u >>
           16;
  }
};

// Triangles that are divided and clipped, with the vertices that this adds.
struct Draft {
  std::vector<glm::dvec3> place;
  std::vector<glm::dvec3> normal;  // zero: not smooth there
  std::vector<double> value;       // positive: removed
  std::vector<std::array<int, 3>> triangles;
  std::unordered_map<Edge, int, EdgeHash> middle, crossing;

  const glm::dvec3& At(int v) const { return place[static_cast<std::size_t>(v)]; }
  int Add(const glm::dvec3& x, const glm::dvec3& n) {
    place.push_back(x);
    normal.push_back(n);
    return static_cast<int>(place.size()) - 1;
  }

  int MiddleOf(int a, int b) {
    const auto [found, is_new] = middle.try_emplace(Between(a, b), -1);
    if (!is_new) return found->second;
    const glm::dvec3 &na = normal[static_cast<std::size_t>(a)],
                     &nb = normal[static_cast<std::size_t>(b)];
    const glm::dvec3 way = At(b) - At(a);
    const glm::dvec3 middle_of_chord = 0.5 * (At(a) + At(b));
    if (na == glm::dvec3(0.0) || nb == glm::dvec3(0.0))
      return found->second = Add(middle_of_chord, glm::dvec3(0.0));
    // Middle of the cubic between two points with normals [Vlachos et al. 2001].
    const glm::dvec3 bulge = 0.125 * (glm::dot(way, nb) * nb - glm::dot(way, na) * na);
    return found->second = Add(middle_of_chord + bulge, glm::normalize(na + nb));
  }

  // Divides a triangle until no edge with a removed node around it is longer than `longest`. The
  // rule depends on the edge only, so that neighbours agree.
  void Divide(const std::array<int, 3>& t, const RemovedVolume& removed, double longest,
              double spacing, int depth) {
    int widest = -1;
    double most = longest;
    for (std::size_t i = 0; i < 3; ++i) {
      const glm::dvec3 &a = At(t[i]), &b = At(t[(i + 1) % 3]);
      const double length = glm::distance(a, b);
      if (!(length > most)) continue;
      // A point of a triangle is within 0.87 of its longest edge from that edge's middle.
      const glm::dvec3 reach(0.87 * length + spacing), centre = 0.5 * (a + b);
      if (!removed.Meets(centre - reach, centre + reach)) continue;
      most = length;
      widest = static_cast<int>(i);
    }
    if (widest < 0 || depth >= kMostDivisions) {
      triangles.push_back(t);
      return;
    }
    const auto i = static_cast<std::size_t>(widest);
    const int a = t[i], b = t[(i + 1) % 3], c = t[(i + 2) % 3], m = MiddleOf(a, b);
    Divide({a, m, c}, removed, longest, spacing, depth + 1);
    Divide({m, b, c}, removed, longest, spacing, depth + 1);
  }

  // Keeps the part of each triangle in which the value is negative.
  template <class ValueAt>
  std::vector<std::array<int, 3>> Clipped(const ValueAt& value_at) {
    std::vector<std::array<int, 3>> kept;
    for (const auto& t : triangles) {
      std::array<int, 4> corner;
      std::size_t count = 0;
      for (std::size_t i = 0; i < 3; ++i) {
        const int a = t[i], b = t[(i + 1) % 3];
        const bool is_a_in = value[static_cast<std::size_t>(a)] < 0,
                   is_b_in = value[static_cast<std::size_t>(b)] < 0;
        if (is_a_in) corner[count++] = a;
        if (is_a_in != is_b_in) corner[count++] = CrossingOf(Between(a, b), value_at);
      }
      if (count >= 3) kept.push_back({corner[0], corner[1], corner[2]});
      if (count == 4) kept.push_back({corner[0], corner[2], corner[3]});
    }
    return kept;
  }

  template <class ValueAt>
  int CrossingOf(const Edge& edge, const ValueAt& value_at) {
    const auto [found, is_new] = crossing.try_emplace(edge, -1);
    if (!is_new) return found->second;
    auto in = static_cast<std::size_t>(edge.first), out = static_cast<std::size_t>(edge.second);
    if (!(value[in] < 0)) std::swap(in, out);
    // Regula falsi between the last places on both sides.
    glm::dvec3 low = place[in], high = place[out], x = low;
    double below = value[in], above = value[out];
    for (int i = 0; i <= kRefinements; ++i) {
      x = glm::mix(low, high, below / (below - above));
      const double here = value_at(x);
      if (here < 0)
        low = x, below = here;
      else
        high = x, above = here;
      if (!(below < 0 && above > below)) break;
    }
    return found->second = Add(x, normal[in]);
  }
};

}  // namespace

SkinCarver::SkinCarver(SurfaceMesh whole, SolidField field)
    : whole_(std::move(whole)),
      field_of_whole_(std::move(field)),
      normals_(whole_.vertices.size()),
      finder_(whole_) {
  ComputeVertexNormals(whole_.vertices, whole_.triangles, normals_);
  smooth_normals_ = normals_;
  for (std::size_t t = 0; t < whole_.triangles.size(); ++t) {
    const auto [a, b, c] = CornersOf(whole_, t);
    const glm::dvec3 twice_area = glm::cross(b - a, c - a);
    for (const int corner : whole_.triangles[t]) {
      const auto v = static_cast<std::size_t>(corner);
      if (!(glm::dot(twice_area, normals_[v]) > kSmooth * glm::length(twice_area)))
        smooth_normals_[v] = glm::dvec3(0.0);
    }
  }
}

double SkinCarver::DistanceFromWhole(const glm::dvec3& x) const {
  // The error of the field is below a third of a spacing, also at a thin edge.
  const double spacing = field_of_whole_.spacing(), about = field_of_whole_.Distance(x);
  if (std::abs(about) > kExact * spacing) return about;
  const SurfacePoint near = finder_.Find(x, 2.0 * kExact * spacing);
  if (near.triangle < 0) return about;
  const auto& [a, b, c] = whole_.triangles[static_cast<std::size_t>(near.triangle)];
  const glm::dvec3 out = near.at.x * normals_[static_cast<std::size_t>(a)] +
                         near.at.y * normals_[static_cast<std::size_t>(b)] +
                         near.at.z * normals_[static_cast<std::size_t>(c)];
  const double distance = glm::distance(x, near.place);
  return glm::dot(x - near.place, out) < 0 ? -distance : distance;
}

CarvedSkin SkinCarver::Carve(const SolidField& field) {
  CarvedSkin skin;
  const RemovedVolume removed(field);
  const double spacing = field.spacing();
  const int whole_count = static_cast<int>(whole_.vertices.size());
  if (removed.empty()) {
    skin.surface = whole_;
    skin.is_fresh.assign(whole_.vertices.size(), 0);
    for (int v = 0; v < whole_count; ++v) skin.whole_vertex.push_back(v);
    return skin;
  }

  // Divides and clips the whole surface.
  Draft outside;
  outside.place = whole_.vertices;
  outside.normal = smooth_normals_;
  for (const auto& t : whole_.triangles)
    outside.Divide(t, removed, kLongestEdge * spacing, spacing, 0);
  const auto on_surface = [&](const glm::dvec3& x) { return removed.At(x) - kOverhang * spacing; };
  for (const glm::dvec3& x : outside.place) outside.value.push_back(on_surface(x));
  outside.triangles = outside.Clipped(on_surface);

  // Clips the faces of the cuts by the whole surface.
  Draft inside;
  faces_.Update(field, removed.values());
  const SurfaceMesh& faces = faces_.surface();
  inside.place = faces.vertices;
  inside.normal.assign(faces.vertices.size(), glm::dvec3(0.0));
  inside.triangles = faces.triangles;
  const auto on_face = [&](const glm::dvec3& x) {
    return DistanceFromWhole(x) - kThrough * spacing;
  };
  const std::vector<double> known = std::exchange(outside_, {});
  for (std::size_t v = 0; v < faces.vertices.size(); ++v) {
    const int before = faces_.previous()[v];
    outside_.push_back(before >= 0 ? known[static_cast<std::size_t>(before)]
                                   : DistanceFromWhole(faces.vertices[v]));
    inside.value.push_back(outside_.back() - kThrough * spacing);
  }
  inside.triangles = inside.Clipped(on_face);

  // Numbers the vertices that are left: those of the whole surface first, in its order.
  for (const Draft* draft : {&outside, &inside}) {
    const bool is_face = draft == &inside;
    std::vector<int> index(draft->place.size(), -1);
    for (const auto& t : draft->triangles)
      for (const int v : t) index[static_cast<std::size_t>(v)] = 0;
    for (std::size_t v = 0; v < index.size(); ++v) {
      if (index[v] < 0) continue;
      index[v] = static_cast<int>(skin.surface.vertices.size());
      skin.surface.vertices.push_back(draft->place[v]);
      skin.is_fresh.push_back(is_face ? 1 : 0);
      skin.whole_vertex.push_back(!is_face && v < whole_.vertices.size() ? static_cast<int>(v)
                                                                         : -1);
    }
    const auto at = [&](int v) { return index[static_cast<std::size_t>(v)]; };
    for (const auto& [a, b, c] : draft->triangles)
      skin.surface.triangles.push_back({at(a), at(b), at(c)});
  }
  return skin;
}

}  // namespace arthro::simulation
