#include "simulation/tissue/field/pieces.h"

#include <algorithm>
#include <array>

#include <glm/geometric.hpp>

namespace arthro::simulation {

namespace {

// Consecutive solid nodes in a row of the grid.
struct Run {
  std::size_t begin, end;  // nodes
  int root;                // a run of the same piece: this one or an earlier one
};

int FindRoot(std::vector<Run>& runs, int i) {
  const auto run = [&](int r) -> Run& { return runs[static_cast<std::size_t>(r)]; };
  while (run(i).root != i) i = run(i).root = run(run(i).root).root;
  return i;
}

// Joins adjacent runs of two neighbouring rows; `step` is the index difference between the rows.
void JoinRows(std::vector<Run>& runs, int a, int a_end, int b, int b_end, std::size_t step) {
  while (a < a_end && b < b_end) {
    const Run &in_a = runs[static_cast<std::size_t>(a)], &in_b = runs[static_cast<std::size_t>(b)];
    if (in_a.begin < in_b.end + step && in_b.begin + step < in_a.end) {
      const int root_a = FindRoot(runs, a), root_b = FindRoot(runs, b);
      runs[static_cast<std::size_t>(std::max(root_a, root_b))].root = std::min(root_a, root_b);
    }
    in_a.end < in_b.end + step ? ++a : ++b;
  }
}

// Adds to the volume of each piece from `first` to `last` its part of the cells around the nodes of
// an extent.
void AddVolumes(const SolidField& field, const FieldPieces& pieces,
                const FieldPieces::Extent& within, int first, int last, double* volume) {
  const FieldGrid& grid = field.grid();
  std::array<std::size_t, 8> offset;
  for (int c = 0; c < 8; ++c)
    offset[static_cast<std::size_t>(c)] = grid.Index(c & 1, c >> 1 & 1, c >> 2);
  const auto low = [&](std::size_t a) { return std::max(0, within.low[a] - 1); };
  const auto high = [&](std::size_t a) { return std::min(grid.count[a] - 2, within.high[a]); };
  for (int k = low(2); k <= high(2); ++k)
    for (int j = low(1); j <= high(1); ++j)
      for (int i = low(0); i <= high(0); ++i) {
        std::array<std::int32_t, 8> corner;
        int solid = 0;
        bool is_one = true, is_asked = false;
        const std::size_t node = grid.Index(i, j, k);
        for (std::size_t c = 0; c < 8; ++c) {
          corner[c] = pieces.piece[node + offset[c]];
          solid += corner[c] >= 0;
          is_one = is_one && corner[c] == corner[0];
          is_asked = is_asked || (corner[c] >= first && corner[c] <= last);
        }
        if (!is_asked) continue;
        const double of_cell = field.CellVolume(i, j, k);
        if (is_one) {
          volume[corner[0] - first] += of_cell;
          continue;
        }
        for (std::size_t c = 0; c < 8; ++c) {
          if (corner[c] < first || corner[c] > last) continue;
          // Handles all corners of this piece at once.
          const int piece = corner[c];
          int mine = 0;
          for (std::size_t d = c; d < 8; ++d)
            if (corner[d] == piece) ++mine, corner[d] = -1;
          volume[piece - first] += of_cell * mine / solid;
        }
      }
}

}  // namespace

FieldPieces PiecesWithoutVolumes(const SolidField& field) {
  FieldPieces pieces;
  const FieldGrid& grid = field.grid();
  const auto values = field.values();
  const auto [nx, ny, nz] = grid.count;
  // Collects the runs row by row; the runs of a row begin at of_row[row].
  std::vector<Run> runs;
  std::vector<int> of_row;
  of_row.reserve(static_cast<std::size_t>(ny) * static_cast<std::size_t>(nz) + 1);
  for (int k = 0; k < nz; ++k)
    for (int j = 0; j < ny; ++j) {
      const int row = static_cast<int>(of_row.size()), first = static_cast<int>(runs.size());
      of_row.push_back(first);
      const std::size_t begin = grid.Index(0, j, k), end = begin + static_cast<std::size_t>(nx);
      for (std::size_t node = begin; node < end; ++node) {
        if (!(values[node] < 0)) continue;
        const std::size_t from = node;
        while (node < end && values[node] < 0) ++node;
        runs.push_back({from, node, static_cast<int>(runs.size())});
      }
      const auto join = [&](int other, std::size_t step) {
        const auto o = static_cast<std::size_t>(other);
        JoinRows(runs, first, static_cast<int>(runs.size()), of_row[o], of_row[o + 1], step);
      };
      if (j > 0) join(row - 1, grid.Index(0, 1, 0));
      if (k > 0) join(row - ny, grid.Index(0, 0, 1));
    }
  // The root of a run precedes it.
  pieces.piece.assign(values.size(), -1);
  std::vector<int> number(runs.size(), -1);
  of_row.push_back(static_cast<int>(runs.size()));
  for (int row = 0; row < ny * nz; ++row)
    for (int r = of_row[static_cast<std::size_t>(row)];
         r < of_row[static_cast<std::size_t>(row) + 1]; ++r) {
      const auto root = static_cast<std::size_t>(FindRoot(runs, r));
      if (number[root] < 0) {
        number[root] = pieces.count();
        pieces.extent.push_back({grid.count, {-1, -1, -1}});
      }
      const Run& run = runs[static_cast<std::size_t>(r)];
      std::fill(pieces.piece.begin() + static_cast<std::ptrdiff_t>(run.begin),
                pieces.piece.begin() + static_cast<std::ptrdiff_t>(run.end), number[root]);
      const std::size_t row_begin = static_cast<std::size_t>(row) * static_cast<std::size_t>(nx);
      const std::array<int, 3> low{static_cast<int>(run.begin - row_begin), row % ny, row / ny},
          high{static_cast<int>(run.end - row_begin) - 1, row % ny, row / ny};
      FieldPieces::Extent& extent = pieces.extent[static_cast<std::size_t>(number[root])];
      for (std::size_t a = 0; a < 3; ++a) {
        extent.low[a] = std::min(extent.low[a], low[a]);
        extent.high[a] = std::max(extent.high[a], high[a]);
      }
    }
  return pieces;
}

FieldPieces PiecesOf(const SolidField& field) {
  FieldPieces pieces = PiecesWithoutVolumes(field);
  pieces.volume.assign(pieces.extent.size(), 0.0);
  AddVolumes(field, pieces, {{0, 0, 0}, field.grid().count}, 0, pieces.count() - 1,
             pieces.volume.data());
  return pieces;
}

double VolumeOfPiece(const SolidField& field, const FieldPieces& pieces, int piece) {
  double volume = 0.0;
  AddVolumes(field, pieces, pieces.extent[static_cast<std::size_t>(piece)], piece, piece, &volume);
  return volume;
}

std::vector<unsigned char> HeldPieces(const SolidField& field, const FieldPieces& pieces,
                                      std::span<const Ball> anchors) {
  std::vector<unsigned char> is_held(pieces.extent.size(), 0);
  const FieldGrid& grid = field.grid();
  for (const Ball& ball : anchors) {
    const auto node = [&](std::size_t a, double x) {
      const double last = grid.count[a] - 1;
      const auto axis = static_cast<glm::length_t>(a);
      // This order of min and max turns NaN into 0.
      return static_cast<int>(std::min(
          std::max(0.0, (x + ball.centre[axis] - grid.origin[axis]) / grid.spacing), last));
    };
    for (int k = node(2, -ball.radius); k <= std::min(grid.count[2] - 1, node(2, ball.radius) + 1);
         ++k)
      for (int j = node(1, -ball.radius);
           j <= std::min(grid.count[1] - 1, node(1, ball.radius) + 1); ++j)
        for (int i = node(0, -ball.radius);
             i <= std::min(grid.count[0] - 1, node(0, ball.radius) + 1); ++i) {
          const std::int32_t piece = pieces.piece[grid.Index(i, j, k)];
          if (piece < 0 || is_held[static_cast<std::size_t>(piece)] != 0) continue;
          if (glm::length(grid.Place(i, j, k) - ball.centre) <= ball.radius)
            is_held[static_cast<std::size_t>(piece)] = 1;
        }
  }
  return is_held;
}

CrumbReport RemovePieces(SolidField& field, const FieldPieces& pieces,
                         std::span<const unsigned char> is_removed) {
  CrumbReport report;
  if (std::ranges::none_of(is_removed, [](unsigned char flag) { return flag != 0; })) return report;
  std::vector<std::size_t> nodes;
  for (std::size_t node = 0; node < pieces.piece.size(); ++node)
    if (const std::int32_t piece = pieces.piece[node];
        piece >= 0 && is_removed[static_cast<std::size_t>(piece)] != 0)
      nodes.push_back(node);
  for (const unsigned char flag : is_removed) report.crumbs += flag != 0;
  report.edit = field.RemoveNodes(nodes);
  return report;
}

CrumbReport RemoveCrumbs(SolidField& field, double volume) {
  const FieldPieces pieces = PiecesOf(field);
  std::vector<unsigned char> is_crumb;
  for (const double v : pieces.volume) is_crumb.push_back(v < volume);
  return RemovePieces(field, pieces, is_crumb);
}

}  // namespace arthro::simulation
