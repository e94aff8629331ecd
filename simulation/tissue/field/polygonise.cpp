#include "simulation/tissue/field/polygonise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "simulation/tissue/field/cell_patches.h"

namespace arthro::simulation {
namespace {

constexpr int kBrick = SolidField::kBrick;

struct PatchTable {
  std::array<CellPatches, 256> patches;
  std::array<std::uint8_t, 256> touching;
};

constexpr PatchTable MakeTable() {
  PatchTable table{};
  for (int c = 0; c < 256; ++c) {
    table.patches[static_cast<std::size_t>(c)] = FindPatches(c, 0);
    table.touching[static_cast<std::size_t>(c)] = static_cast<std::uint8_t>(SelfTouchingFaces(c));
  }
  return table;
}
constexpr PatchTable kTable = MakeTable();

using Cell = std::array<int, 3>;

// Computes a patch's vertex in units of the cell: the mean of its crossings, moved along the
// gradient onto the zero of the trilinear interpolation.
glm::dvec3 ComputeVertex(const std::array<double, 8>& value, const CellPatches& patches,
                         int patch) {
  glm::dvec3 sum(0.0);
  int crossings = 0;
  for (int e = 0; e < 12; ++e) {
    if (patches.of_edge[static_cast<std::size_t>(e)] != patch) continue;
    const int low = LowCornerOfEdge(e), axis = e / 4;
    const double a = value[static_cast<std::size_t>(low)],
                 b = value[static_cast<std::size_t>(low | 1 << axis)];
    glm::dvec3 x(low & 1, low >> 1 & 1, low >> 2 & 1);
    x[axis] = a / (a - b);
    sum += x;
    ++crossings;
  }
  glm::dvec3 x = sum / static_cast<double>(crossings);
  constexpr int kPulls = 4;
  for (int pull = 0; pull < kPulls; ++pull) {
    double f = 0.0;
    glm::dvec3 slope(0.0);
    for (int c = 0; c < 8; ++c) {
      glm::dvec3 weight, sign;
      for (int a = 0; a < 3; ++a) {
        weight[a] = (c >> a & 1) ? x[a] : 1.0 - x[a];
        sign[a] = (c >> a & 1) ? 1.0 : -1.0;
      }
      const double v = value[static_cast<std::size_t>(c)];
      f += v * weight.x * weight.y * weight.z;
      slope += v * sign * glm::dvec3(weight.y * weight.z, weight.x * weight.z, weight.x * weight.y);
    }
    const double slope2 = glm::dot(slope, slope);
    if (!(slope2 > 0.0)) break;
    x = glm::clamp(x - f / slope2 * slope, glm::dvec3(0.0), glm::dvec3(1.0));
  }
  return x;
}

std::size_t BrickAt(const std::array<int, 3>& bricks, const Cell& b) {
  const int at = (b[2] * bricks[1] + b[1]) * bricks[0] + b[0];
  return static_cast<std::size_t>(at);
}

// Calls test(first, count) for the rows of the nodes at the cells of a brick, until one returns
// false. Returns whether all were true.
template <class Test>
bool EachRow(const FieldGrid& grid, const Cell& b, const Test& test) {
  const auto end = [&](std::size_t a) { return std::min((b[a] + 1) * kBrick, grid.count[a] - 1); };
  const int first = b[0] * kBrick, count = end(0) - first + 1;
  for (int k = b[2] * kBrick; k <= end(2); ++k)
    for (int j = b[1] * kBrick; j <= end(1); ++j)
      if (!test(grid.Index(first, j, k), static_cast<std::size_t>(count))) return false;
  return true;
}

}  // namespace

// Read access to the cells of a field.
class FieldSkin::Cells {
 public:
  Cells(const SolidField& field, std::span<const float> values)
      : grid_(field.grid()), value_(values), bricks_(field.bricks()) {}

  bool Has(const Cell& c) const {
    for (std::size_t a = 0; a < 3; ++a)
      if (c[a] < 0 || c[a] >= grid_.count[a] - 1) return false;
    return true;
  }
  float Value(const Cell& node) const { return value_[grid_.Index(node[0], node[1], node[2])]; }
  int Configuration(const Cell& c) const {
    int configuration = 0;
    for (int n = 0; n < 8; ++n)
      configuration |= (Value({c[0] + (n & 1), c[1] + (n >> 1 & 1), c[2] + (n >> 2)}) < 0) << n;
    return configuration;
  }
  // Returns the patches of a cell; a face is joined only if the neighbour agrees.
  CellPatches Patches(const Cell& c, int configuration) const {
    const int touching = kTable.touching[static_cast<std::size_t>(configuration)];
    if (touching == 0) return kTable.patches[static_cast<std::size_t>(configuration)];
    int joined = 0;
    for (int face = 0; face < 6; ++face) {
      if ((touching >> face & 1) == 0) continue;
      Cell other = c;
      other[static_cast<std::size_t>(face / 2)] += (face & 1) != 0 ? 1 : -1;
      if (Has(other) &&
          (kTable.touching[static_cast<std::size_t>(Configuration(other))] >> (face ^ 1) & 1) != 0)
        joined |= 1 << face;
    }
    return FindPatches(configuration, joined);
  }
  int OwningBrick(const Cell& c) const {
    return (c[2] / kBrick * bricks_[1] + c[1] / kBrick) * bricks_[0] + c[0] / kBrick;
  }
  static std::size_t InBrick(const Cell& c) {
    const int index = (c[2] % kBrick * kBrick + c[1] % kBrick) * kBrick + c[0] % kBrick;
    return static_cast<std::size_t>(index);
  }
  // Calls visit(cell) for the cells of brick (i, j, k).
  template <class Visit>
  void ForEach(const Cell& brick, const Visit& visit) const {
    Cell end;
    for (std::size_t a = 0; a < 3; ++a)
      end[a] = std::min((brick[a] + 1) * kBrick, grid_.count[a] - 1);
    for (int k = brick[2] * kBrick; k < end[2]; ++k)
      for (int j = brick[1] * kBrick; j < end[1]; ++j)
        for (int i = brick[0] * kBrick; i < end[0]; ++i) visit(Cell{i, j, k});
  }

  // Computes the vertices of a brick and returns the number of cells visited.
  long MakeVertices(const Cell& at, Brick& brick) const {
    long looked = 0;
    brick.vertices.clear();
    brick.first_vertex.clear();
    brick.touching_faces = 0;
    ForEach(at, [&](const Cell& c) {
      ++looked;
      const int configuration = Configuration(c);
      if (configuration == 0 || configuration == 255) return;
      if (brick.first_vertex.empty()) brick.first_vertex.assign(kBrick * kBrick * kBrick, -1);
      brick.first_vertex[InBrick(c)] = static_cast<std::int16_t>(brick.vertices.size());
      std::array<double, 8> value;
      for (int n = 0; n < 8; ++n)
        value[static_cast<std::size_t>(n)] =
            static_cast<double>(Value({c[0] + (n & 1), c[1] + (n >> 1 & 1), c[2] + (n >> 2)}));
      const CellPatches patches = Patches(c, configuration);
      for (int patch = 0; patch < patches.count; ++patch)
        brick.vertices.push_back(grid_.Place(c[0], c[1], c[2]) +
                                 grid_.spacing * ComputeVertex(value, patches, patch));
      const int touching = kTable.touching[static_cast<std::size_t>(configuration)];
      for (int face = 0; touching != 0 && face < 6; ++face)
        if ((touching >> face & 1) != 0 &&
            c[static_cast<std::size_t>(face / 2)] % kBrick == ((face & 1) != 0 ? kBrick - 1 : 0))
          brick.touching_faces |= 1 << face;
    });
    return looked;
  }

  // Builds the quads of a brick; an edge belongs to the brick of the cell whose lowest node is its
  // lower end.
  void MakeQuads(const std::vector<Brick>& bricks, const Cell& at, Brick& brick) const {
    brick.quads.clear();
    ForEach(at, [&](const Cell& node) {
      const bool is_solid = Value(node) < 0;
      for (std::size_t a = 0; a < 3; ++a) {
        Cell end = node;
        ++end[a];
        if ((Value(end) < 0) == is_solid) continue;
        // Lists the four cells around the edge, counter-clockwise seen from its upper end.
        const std::size_t u = (a + 1) % 3, v = (a + 2) % 3;
        std::array<Corner, 4> quad;
        bool is_inside = true;  // false: the surface leaves the grid here
        for (std::size_t q = 0; q < 4; ++q) {
          const int below_u = q == 0 || q == 3, below_v = q == 0 || q == 1;
          Cell cell = node;
          cell[u] -= below_u;
          cell[v] -= below_v;
          is_inside = is_inside && Has(cell);
          if (!is_inside) break;
          const CellPatches patches = Patches(cell, Configuration(cell));
          const int edge = static_cast<int>(4 * a) + below_u + 2 * below_v;
          const int owner = OwningBrick(cell);
          quad[is_solid ? q : 3 - q] = {
              owner, bricks[static_cast<std::size_t>(owner)].first_vertex[InBrick(cell)] +
                         patches.of_edge[static_cast<std::size_t>(edge)]};
        }
        if (is_inside) brick.quads.push_back(quad);
      }
    });
  }

 private:
  const FieldGrid& grid_;
  std::span<const float> value_;
  std::array<int, 3> bricks_;
};

bool FieldSkin::HasGridOf(const SolidField& field) const {
  const FieldGrid& grid = field.grid();
  return !bricks_.empty() && grid.origin == grid_.origin && grid.spacing == grid_.spacing &&
         grid.count == grid_.count;
}

SkinUpdate FieldSkin::Update(const SolidField& field) {
  const bool is_new = !HasGridOf(field) || field.version() < version_;
  const auto versions = field.brick_versions();
  const std::array<int, 3> bricks = field.bricks();
  const SkinUpdate update = UpdateBricks(field, field.values(), is_new, [&](const Cell& b) {
    return versions[BrickAt(bricks, b)] > version_;
  });
  version_ = field.version();
  return update;
}

SkinUpdate FieldSkin::Update(const SolidField& field, std::span<const float> values) {
  const bool is_new = !HasGridOf(field) || values_.size() != values.size();
  const SkinUpdate update = UpdateBricks(field, values, is_new, [&](const Cell& b) {
    return !EachRow(field.grid(), b, [&](std::size_t first, std::size_t count) {
      return std::equal(&values[first], &values[first] + count, &values_[first]);
    });
  });
  values_.assign(values.begin(), values.end());
  return update;
}

template <class HasChanged>
SkinUpdate FieldSkin::UpdateBricks(const SolidField& field, std::span<const float> values,
                                   bool is_new, const HasChanged& changed) {
  SkinUpdate update;
  const FieldGrid& grid = field.grid();
  const std::array<int, 3> brick_count = field.bricks();
  if (is_new) {
    bricks_.assign(static_cast<std::size_t>(brick_count[0]) *
                       static_cast<std::size_t>(brick_count[1]) *
                       static_cast<std::size_t>(brick_count[2]),
                   {});
    grid_ = grid;
  }
  const auto index = [&](const Cell& b) { return BrickAt(brick_count, b); };
  const auto for_each_brick = [&](auto&& visit) {
    for (int k = 0; k < brick_count[2]; ++k)
      for (int j = 0; j < brick_count[1]; ++j)
        for (int i = 0; i < brick_count[0]; ++i) visit(Cell{i, j, k});
  };
  // A new skin needs no brick whose nodes are all on one side.
  const auto is_flat = [&](const Cell& b) {
    const bool side = values[grid.Index(b[0] * kBrick, b[1] * kBrick, b[2] * kBrick)] < 0;
    return EachRow(grid, b, [&](std::size_t first, std::size_t count) {
      for (std::size_t i = first; i < first + count; ++i)
        if ((values[i] < 0) != side) return false;
      return true;
    });
  };
  std::vector<unsigned char> is_other(bricks_.size(), 0);
  for_each_brick([&](const Cell& b) { is_other[index(b)] = is_new ? !is_flat(b) : changed(b); });
  const auto has_changed = [&](const Cell& b) { return is_other[index(b)] != 0; };

  // Bricks to redo: those that changed, and neighbours that may have agreed to join a face with
  // them.
  std::vector<Cell> redo, relink;
  std::vector<unsigned char> is_redone(bricks_.size(), 0);
  for_each_brick([&](const Cell& b) {
    bool redo_it = has_changed(b);
    for (int face = 0; face < 6 && !redo_it; ++face) {
      if ((bricks_[index(b)].touching_faces >> face & 1) == 0) continue;
      Cell other = b;
      const auto a = static_cast<std::size_t>(face / 2);
      other[a] += (face & 1) != 0 ? 1 : -1;
      redo_it = other[a] >= 0 && other[a] < brick_count[a] && has_changed(other);
    }
    if (!redo_it) return;
    redo.push_back(b);
    is_redone[index(b)] = 1;
  });
  // Triangles of a brick also use vertices of the bricks that follow it by one cell.
  for_each_brick([&](const Cell& b) {
    for (int n = 0; n < 8; ++n) {
      const Cell other = {b[0] - (n & 1), b[1] - (n >> 1 & 1), b[2] - (n >> 2)};
      if (other[0] < 0 || other[1] < 0 || other[2] < 0 || is_redone[index(other)] == 0) continue;
      relink.push_back(b);
      update.bricks_relinked += is_redone[index(b)] == 0;
      break;
    }
  });
  update.bricks_redone = static_cast<int>(redo.size());
  if (redo.empty() && !is_new) {
    for (std::size_t i = 0; i < previous_.size(); ++i) previous_[i] = static_cast<int>(i);
    for (const Brick& brick : bricks_) update.bricks_with_skin += !brick.vertices.empty();
    return update;
  }

  const Cells cells(field, values);
  std::vector<Brick> old(redo.size());
  for (std::size_t r = 0; r < redo.size(); ++r) {
    Brick& brick = bricks_[index(redo[r])];
    std::swap(old[r].vertices, brick.vertices);
    std::swap(old[r].first_vertex, brick.first_vertex);
    update.cells_redone += cells.MakeVertices(redo[r], brick);
  }
  for (const Cell& b : relink) cells.MakeQuads(bricks_, b, bricks_[index(b)]);

  // Concatenates the parts of all bricks in brick order.
  surface_.vertices.clear();
  surface_.triangles.clear();
  previous_.clear();
  std::size_t r = 0;
  for (std::size_t b = 0; b < bricks_.size(); ++b) {
    Brick& brick = bricks_[b];
    const int old_first = brick.first, first = static_cast<int>(surface_.vertices.size());
    brick.first = first;
    surface_.vertices.insert(surface_.vertices.end(), brick.vertices.begin(), brick.vertices.end());
    update.bricks_with_skin += !brick.vertices.empty();
    if (is_redone[b] == 0) {
      for (std::size_t v = 0; v < brick.vertices.size(); ++v)
        previous_.push_back(old_first + static_cast<int>(v));
      continue;
    }
    // In a redone brick, vertices of unchanged cells keep their index too.
    previous_.resize(surface_.vertices.size(), -1);
    const Brick& was = old[r++];
    if (brick.first_vertex.empty() || was.first_vertex.empty()) continue;
    for (std::size_t c = 0; c < brick.first_vertex.size(); ++c)
      if (brick.first_vertex[c] >= 0 && was.first_vertex[c] >= 0) {
        const auto now_at = static_cast<std::size_t>(brick.first_vertex[c]),
                   was_at = static_cast<std::size_t>(was.first_vertex[c]);
        if (brick.vertices[now_at] == was.vertices[was_at])
          previous_[static_cast<std::size_t>(first) + now_at] = old_first + was.first_vertex[c];
      }
  }
  for (const Brick& brick : bricks_)
    for (const auto& quad : brick.quads) {
      std::array<int, 4> v;
      for (std::size_t q = 0; q < 4; ++q)
        v[q] = bricks_[static_cast<std::size_t>(quad[q].brick)].first + quad[q].vertex;
      const auto length2 = [&](std::size_t p, std::size_t q) {
        const glm::dvec3 way = surface_.vertices[static_cast<std::size_t>(v[q])] -
                               surface_.vertices[static_cast<std::size_t>(v[p])];
        return glm::dot(way, way);
      };
      // Splits the quad along the shorter diagonal. The two cells at its ends share this grid edge
      // only, so no other triangle has that diagonal.
      if (length2(0, 2) <= length2(1, 3)) {
        surface_.triangles.push_back({v[0], v[1], v[2]});
        surface_.triangles.push_back({v[0], v[2], v[3]});
      } else {
        surface_.triangles.push_back({v[0], v[1], v[3]});
        surface_.triangles.push_back({v[1], v[2], v[3]});
      }
    }
  return update;
}

}  // namespace arthro::simulation
