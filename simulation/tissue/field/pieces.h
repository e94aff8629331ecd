// Connected pieces of a solid: solid nodes that are neighbours along grid edges, as in the skin
// (polygonise.h). Tells which pieces are not anchored and which are too small to keep. m, m³.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "simulation/scene/scene.h"
#include "simulation/tissue/field/solid_field.h"

namespace arthro::simulation {

struct FieldPieces {
  std::vector<std::int32_t> piece;  // piece of each grid node; −1: not solid
  struct Extent {
    std::array<int, 3> low, high;  // nodes, inclusive
  };
  std::vector<Extent> extent;  // one per piece
  // Volume of each piece. A cell with corners of several pieces is divided by the number of
  // corners, so that the sum is the field's volume. Empty if only the pieces were requested.
  std::vector<double> volume;
  int count() const { return static_cast<int>(extent.size()); }
};

// Finds the pieces, numbered in the order of their first nodes.
FieldPieces PiecesOf(const SolidField& field);
// The same without volumes, and the volume of one piece: cheaper when few volumes are needed, as
// after each cut.
FieldPieces PiecesWithoutVolumes(const SolidField& field);
double VolumeOfPiece(const SolidField& field, const FieldPieces& pieces, int piece);

// Returns 1 for a piece with a node in any of the balls (field's frame), 0 for a loose piece.
std::vector<unsigned char> HeldPieces(const SolidField& field, const FieldPieces& pieces,
                                      std::span<const Ball> anchors);

struct CrumbReport {
  int crumbs = 0;
  FieldEdit edit;
};

// Removes the pieces whose flag is set.
CrumbReport RemovePieces(SolidField& field, const FieldPieces& pieces,
                         std::span<const unsigned char> is_removed);
// Removes the pieces smaller than `volume`.
CrumbReport RemoveCrumbs(SolidField& field, double volume);

}  // namespace arthro::simulation
