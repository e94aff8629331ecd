#include "simulation/tissue/cut/tet_lattice.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <set>

namespace arthro::simulation {
namespace {

using Step = std::array<int, 3>;

}  // namespace

TetLattice MakeTetLattice(int n) {
  TetLattice lattice;
  lattice.n = n;
  const auto m = static_cast<std::size_t>(n) + 1;
  lattice.index_.assign(m * m * m, -1);
  for (int k = 0; k <= n; ++k)
    for (int j = 0; j + k <= n; ++j)
      for (int i = 0; i + j + k <= n; ++i) {
        lattice.index_[(static_cast<std::size_t>(k) * m + static_cast<std::size_t>(j)) * m +
                       static_cast<std::size_t>(i)] =
            static_cast<std::int16_t>(lattice.point.size());
        lattice.point.push_back({static_cast<std::uint8_t>(n - i - j - k),
                                 static_cast<std::uint8_t>(i), static_cast<std::uint8_t>(j),
                                 static_cast<std::uint8_t>(k)});
      }
  // Each point starts an upright tetrahedron, an octahedron (four parts around one diagonal) and an
  // inverted tetrahedron, as far as they lie inside.
  constexpr Step o{0, 0, 0}, x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1}, xy{1, 1, 0}, xz{1, 0, 1},
      yz{0, 1, 1}, xyz{1, 1, 1};
  constexpr std::array<std::array<Step, 4>, 6> kParts{{{o, x, y, z},
                                                       {x, yz, y, xy},
                                                       {x, yz, xy, xz},
                                                       {x, yz, xz, z},
                                                       {x, yz, z, y},
                                                       {xy, xz, yz, xyz}}};
  for (int k = 0; k < n; ++k)
    for (int j = 0; j + k < n; ++j)
      for (int i = 0; i + j + k < n; ++i) {
        const auto first = static_cast<std::int32_t>(lattice.part.size());
        for (const auto& steps : kParts) {
          std::array<std::int16_t, 4> part{};
          bool is_inside = true;
          for (std::size_t c = 0; c < 4 && is_inside; ++c) {
            const auto& s = steps[c];
            is_inside = i + j + k + s[0] + s[1] + s[2] <= n;
            if (is_inside)
              part[c] = static_cast<std::int16_t>(lattice.PointAt(i + s[0], j + s[1], k + s[2]));
          }
          if (is_inside) lattice.part.push_back(part);
        }
        lattice.cell.push_back({first, static_cast<std::int32_t>(lattice.part.size()), {}, {}});
      }
  // The region of a part is that of the largest coordinate of its centroid; ties are shared.
  for (const auto& part : lattice.part) {
    std::array<int, 4> sum{};
    for (const auto p : part)
      for (std::size_t c = 0; c < 4; ++c) sum[c] += lattice.point[static_cast<std::size_t>(p)][c];
    const int largest = *std::max_element(sum.begin(), sum.end());
    std::uint8_t region = 0;
    for (std::size_t c = 0; c < 4; ++c)
      if (sum[c] == largest) region = static_cast<std::uint8_t>(region | 1 << c);
    lattice.region.push_back(region);
    AddToRegions(region, 1.0, lattice.region_total);
  }
  for (auto& cell : lattice.cell) {
    std::set<std::int16_t> corners;
    for (auto p = static_cast<std::size_t>(cell.first); p < static_cast<std::size_t>(cell.last);
         ++p) {
      corners.insert(lattice.part[p].begin(), lattice.part[p].end());
      AddToRegions(lattice.region[p], 1.0, cell.region);
    }
    cell.corner.fill(*corners.begin());
    std::copy(corners.begin(), corners.end(), cell.corner.begin());
  }
  std::vector<std::vector<std::int16_t>> beside(lattice.point.size());
  for (const auto& part : lattice.part)
    for (const auto p : part)
      for (const auto q : part)
        if (p != q) beside[static_cast<std::size_t>(p)].push_back(q);
  lattice.neighbour_begin.push_back(0);
  for (auto& list : beside) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
    lattice.neighbour.insert(lattice.neighbour.end(), list.begin(), list.end());
    lattice.neighbour_begin.push_back(static_cast<std::int32_t>(lattice.neighbour.size()));
  }
  return lattice;
}

int TetLattice::Nearest(const glm::dvec4& barycentric) const {
  // Rounds down, then adds the remainder of n to the coordinates with the largest fractions.
  std::array<int, 4> whole;
  std::array<double, 4> rest;
  double sum = 0.0;
  std::array<double, 4> l;
  for (int c = 0; c < 4; ++c)
    sum += l[static_cast<std::size_t>(c)] = std::min(std::max(0.0, barycentric[c]), 1e6);
  int left = n;
  for (std::size_t c = 0; c < 4; ++c) {
    const double scaled = sum > 0.0 ? l[c] / sum * n : n / 4.0;
    whole[c] = static_cast<int>(scaled);
    rest[c] = scaled - whole[c];
    left -= whole[c];
  }
  for (; left > 0; --left) {
    const auto most =
        static_cast<std::size_t>(std::max_element(rest.begin(), rest.end()) - rest.begin());
    ++whole[most];
    rest[most] -= 1.0;
  }
  return PointAt(whole[1], whole[2], whole[3]);
}

double NegativePart(const std::array<double, 4>& value) noexcept {
  std::array<double, 4> in{}, out{};
  std::size_t ins = 0, outs = 0;
  for (const double v : value) {
    if (v <= 0.0)
      in[ins++] = v;
    else
      out[outs++] = v;
  }
  const auto reach = [](double a, double b) {
    return a / (a - b);
  };  // fraction of the edge from a to b
  switch (ins) {
    case 0:
      return 0.0;
    case 1:
      return reach(in[0], out[0]) * reach(in[0], out[1]) * reach(in[0], out[2]);
    case 3:
      return 1.0 - reach(out[0], in[0]) * reach(out[0], in[1]) * reach(out[0], in[2]);
    case 4:
      return 1.0;
    default:
      break;
  }
  // Volume of the wedge between the inner edge ab and its crossings with the four edges to c and d.
  const double ac = reach(in[0], out[0]), ad = reach(in[0], out[1]);
  const double bc = reach(in[1], out[0]), bd = reach(in[1], out[1]);
  return ac * ad + bc * bd * (1.0 - ac) + bd * ac * (1.0 - ad);
}

}  // namespace arthro::simulation
