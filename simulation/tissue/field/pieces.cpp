#include "simulation/tissue/field/pieces.h"

#include <algorithm>
#include <array>

#include <glm/geometric.hpp>

namespace arthro::simulation {

FieldPieces PiecesOf(const SolidField& field) {
  FieldPieces pieces;
  const FieldGrid& grid = field.grid();
  const auto values = field.values();
  pieces.piece.assign(values.size(), -1);
  // Neighbours by their index alone: the outermost nodes are never solid.
  const auto row = static_cast<std::ptrdiff_t>(grid.count[0]);
  const std::array<std::ptrdiff_t, 6> steps{
      1, -1, row, -row, row * grid.count[1], -row * grid.count[1]};
  std::vector<std::size_t> front;
  for (std::size_t start = 0; start < values.size(); ++start) {
    if (!(values[start] < 0) || pieces.piece[start] >= 0) continue;
    const int piece = pieces.count();
    pieces.volume.push_back(0.0);
    pieces.piece[start] = piece;
    front.assign(1, start);
    while (!front.empty()) {
      const std::size_t node = front.back();
      front.pop_back();
      for (const std::ptrdiff_t step : steps) {
        const auto other = static_cast<std::size_t>(static_cast<std::ptrdiff_t>(node) + step);
        if (!(values[other] < 0) || pieces.piece[other] >= 0) continue;
        pieces.piece[other] = piece;
        front.push_back(other);
      }
    }
  }
  std::array<std::size_t, 8> offset;
  for (int c = 0; c < 8; ++c)
    offset[static_cast<std::size_t>(c)] = grid.Index(c & 1, c >> 1 & 1, c >> 2);
  for (int k = 0; k + 1 < grid.count[2]; ++k)
    for (int j = 0; j + 1 < grid.count[1]; ++j)
      for (int i = 0; i + 1 < grid.count[0]; ++i) {
        std::array<std::int32_t, 8> corner;
        int solid = 0;
        bool is_one = true;
        const std::size_t first = grid.Index(i, j, k);
        for (std::size_t c = 0; c < 8; ++c) {
          corner[c] = pieces.piece[first + offset[c]];
          solid += corner[c] >= 0;
          is_one = is_one && corner[c] == corner[0];
        }
        if (solid == 0) continue;
        const double volume = field.CellVolume(i, j, k);
        if (is_one) {
          pieces.volume[static_cast<std::size_t>(corner[0])] += volume;
          continue;
        }
        for (std::size_t c = 0; c < 8; ++c) {
          if (corner[c] < 0) continue;
          // All corners of this piece at once.
          const int piece = corner[c];
          int mine = 0;
          for (std::size_t d = c; d < 8; ++d)
            if (corner[d] == piece) ++mine, corner[d] = -1;
          pieces.volume[static_cast<std::size_t>(piece)] += volume * mine / solid;
        }
      }
  return pieces;
}

std::vector<unsigned char> HeldPieces(const SolidField& field, const FieldPieces& pieces,
                                      std::span<const Ball> anchors) {
  std::vector<unsigned char> is_held(pieces.volume.size(), 0);
  const FieldGrid& grid = field.grid();
  for (int k = 0; k < grid.count[2]; ++k)
    for (int j = 0; j < grid.count[1]; ++j)
      for (int i = 0; i < grid.count[0]; ++i) {
        const std::int32_t piece = pieces.piece[grid.Index(i, j, k)];
        if (piece < 0 || is_held[static_cast<std::size_t>(piece)] != 0) continue;
        for (const Ball& ball : anchors)
          if (glm::length(grid.Place(i, j, k) - ball.centre) <= ball.radius)
            is_held[static_cast<std::size_t>(piece)] = 1;
      }
  return is_held;
}

CrumbReport RemovePieces(SolidField& field, const FieldPieces& pieces,
                         std::span<const unsigned char> is_removed) {
  CrumbReport report;
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
