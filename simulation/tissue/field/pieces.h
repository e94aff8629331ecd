// What of a solid hangs together: solid nodes that are neighbours along grid edges, as the skin
// (polygonise.h) has it. Which pieces nothing holds, and which are too small to be kept. m, m³.
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
  std::vector<std::int32_t> piece;  // a node of the grid; −1: not solid
  struct Extent {
    std::array<int, 3> low, high;  // nodes, inclusive
  };
  std::vector<Extent> extent;  // of each piece
  // Of each piece. A cell that several have a corner in is shared by the number of corners, so the
  // sum is the field's volume. Empty where only the pieces were asked for.
  std::vector<double> volume;
  int count() const { return static_cast<int>(extent.size()); }
};

// Numbered in the order of their first nodes.
FieldPieces PiecesOf(const SolidField& field);
// The same without the volumes, and the volume of one: for who asks for few of them, at each cut.
FieldPieces PiecesWithoutVolumes(const SolidField& field);
double VolumeOfPiece(const SolidField& field, const FieldPieces& pieces, int piece);

// 1 a piece that has a node in any of the balls (the field's own frame), 0 one that is loose.
std::vector<unsigned char> HeldPieces(const SolidField& field, const FieldPieces& pieces,
                                      std::span<const Ball> anchors);

struct CrumbReport {
  int crumbs = 0;
  FieldEdit edit;
};

// Takes away the pieces whose flag is set.
CrumbReport RemovePieces(SolidField& field, const FieldPieces& pieces,
                         std::span<const unsigned char> is_removed);
// Takes away the pieces smaller than `volume`.
CrumbReport RemoveCrumbs(SolidField& field, double volume);

}  // namespace arthro::simulation
